"""pymoo: the multi-objective algorithms of pymoo on pathloom's operators, and the operators inside pymoo."""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the multi-objective planners."""
