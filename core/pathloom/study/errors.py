"""What can go wrong with a study."""

from pathloom.errors import PathloomError


class StudyError(PathloomError):
    """A study's file cannot be read, written or taken up, or its workers cannot be had."""
