"""pathloom_agacd."""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add nothing yet."""
