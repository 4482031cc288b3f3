"""loom: pathloom's own planner, put together of the parts that the ablations found best."""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the planner and the parts that only it brings."""
