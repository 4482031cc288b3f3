"""``python -m pathloom.cli``."""

from pathloom.cli import main

main()
