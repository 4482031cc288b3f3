"""``python -m pathloom``."""

from pathloom.cli import main

main()
