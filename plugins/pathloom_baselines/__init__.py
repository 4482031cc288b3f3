"""Baselines: the plain methods that the papers compare theirs with.

Most are described in a line or two, so that what a paper's authors ran cannot be
known; each planner says in ``fidelity`` and ``assumptions`` what was filled in.
"""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the baselines' operators and planners."""
    from pathloom_baselines.crossover import SinglePoint
    from pathloom_baselines.mutation import SingleGene
    from pathloom_baselines.planners import GaImga
    from pathloom_baselines.sampling import RandomWalk

    for component in (RandomWalk, SinglePoint, SingleGene, GaImga):
        add(component)
