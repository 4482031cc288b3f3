"""Bundle: a study in one file for another lab, and the check whether it can be repeated."""

from pathloom.study.bundle.packing import bundle as bundle
from pathloom.study.bundle.verifying import verify as verify
