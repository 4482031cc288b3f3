"""Baselines: the plain methods that the papers compare theirs with.

Most are described in a line or two, so that what a paper's authors ran cannot be
known; each planner says in ``fidelity`` and ``assumptions`` what was filled in.
"""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the baselines' operators and planners."""
    from pathloom_baselines.aco_ga import AcoGa, AntPaths, ShorterParts, Smartpath
    from pathloom_baselines.afsa import Afsa
    from pathloom_baselines.afsa_grid import AfsaGrid
    from pathloom_baselines.ants import Aco, InProportion, NoWorseThanMean, StepAndGoalDistance
    from pathloom_baselines.basic_ga import BasicGa
    from pathloom_baselines.bezier import BezierGa
    from pathloom_baselines.control import ByPopulation
    from pathloom_baselines.crossover import BestMeeting, SinglePoint
    from pathloom_baselines.gwo import Gwo
    from pathloom_baselines.migration import RingMigration
    from pathloom_baselines.multi_population import MpgaTextbook, Mpmga
    from pathloom_baselines.mutation import SingleGene, TwoPoint
    from pathloom_baselines.objectives import SmoothD2Legacy, SmoothnessPenalty
    from pathloom_baselines.planners import Bga, Bga50, GaIga, GaImaga, GaImga, GaLit37
    from pathloom_baselines.pso import Pso
    from pathloom_baselines.repair import DetourRemoval
    from pathloom_baselines.sampling import GreedyWalk, RandomPerRow, RandomWalk
    from pathloom_baselines.selection import KeepAll
    from pathloom_baselines.ssa import Ssa

    for component in (
        RandomWalk, RandomPerRow, GreedyWalk,
        SmoothnessPenalty, SmoothD2Legacy,
        KeepAll,
        SinglePoint, BestMeeting,
        SingleGene, TwoPoint,
        DetourRemoval,
        ByPopulation, RingMigration,
        InProportion, StepAndGoalDistance, NoWorseThanMean, AntPaths, ShorterParts,
        Aco, AcoGa, Smartpath,
        BasicGa, Bga, Bga50, GaImga, GaLit37, GaImaga, GaIga,
        Mpmga, MpgaTextbook,
        Pso, Gwo, Afsa, AfsaGrid, Ssa,
        BezierGa,
    ):  # fmt: skip
        add(component)
