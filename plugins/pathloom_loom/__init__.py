"""loom: pathloom's own planner, put together of the parts that the ablations found best."""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the planner and the parts that only it brings."""
    from pathloom_loom.band import BandSearch
    from pathloom_loom.planner import Loom
    from pathloom_loom.pool import GenePool
    from pathloom_loom.pulling import StringPulling

    for component in (StringPulling, GenePool, BandSearch, Loom):
        add(component)
