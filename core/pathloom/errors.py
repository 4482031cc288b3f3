"""What a caller can get wrong, one class for each place where it shows."""


class PathloomError(ValueError):
    """Base of all errors that a user can cause and mend.

    The message is one line: where, what was found, what is allowed, and, where
    one can guess it, what was meant.
    """


class MapError(PathloomError):
    """A map, an image or a scenario file cannot be read, or cannot be written."""


class ProblemError(PathloomError):
    """Start, goal, radius or corner policy do not fit the map."""


class ConfigError(PathloomError):
    """A config names something unknown, or a parameter is out of its range."""


class PluginError(PathloomError):
    """A plugin is broken, clashes with another, or registers something unusable."""


class PluginWarning(UserWarning):
    """A plugin works, but does what it should not, such as printing when it is imported."""
