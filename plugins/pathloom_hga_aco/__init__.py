"""HGA-ACO and S-RRT: what Song et al. (2021) propose for local and global planning.

HGA-ACO is a genetic algorithm whose last generation lays the first pheromone of
an ant colony; the colony rewards the best path of each iteration and the best of
all, and keeps a table of dead ends.

Reference: Q. Song, S. Li, J. Yang, Q. Bai, J. Hu, X. Zhang, A. Zhang,
"Intelligent Optimization Algorithm-Based Path Planning for a Mobile Robot",
Computational Intelligence and Neuroscience 2021, article 8025730,
doi:10.1155/2021/8025730.

Section by section: 3 ``policies``, 5.1 and 5.3.1 ``objectives``, 5.3.2 ``crossover``,
``mutation`` and ``control``, 5.3 ``sampling``, 5.4 ``seeding``, 5.5.1
``heuristic`` and ``pheromone``, 5.5.2 ``deadlock``, 5.6 ``planner`` and
``claims``, 5.2 ``hybrid``. What the paper leaves open stands at the statement it
concerns and in the planners' ``assumptions``.
"""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the paper's operators and its planners."""
    from pathloom_hga_aco.claims import Table2, Table3
    from pathloom_hga_aco.control import FamilyCompetition
    from pathloom_hga_aco.crossover import SinglePointGeneAware
    from pathloom_hga_aco.deadlock import DeadAngleTable
    from pathloom_hga_aco.heuristic import EdgeLength
    from pathloom_hga_aco.hybrid import HgaAco
    from pathloom_hga_aco.mutation import TwoWayReverseSearch
    from pathloom_hga_aco.objectives import AngleTablePenalty, MeanTurnAngle
    from pathloom_hga_aco.pheromone import TwoBest
    from pathloom_hga_aco.planner import AcoHgaAco, GaHgaAco
    from pathloom_hga_aco.policies.gnb import Gnb
    from pathloom_hga_aco.policies.knn import Knn
    from pathloom_hga_aco.policies.mnb import Mnb
    from pathloom_hga_aco.policies.rf import Rf
    from pathloom_hga_aco.policies.svm import Svm
    from pathloom_hga_aco.rrt import Rrt
    from pathloom_hga_aco.s_rrt import SRrt
    from pathloom_hga_aco.sampling import GuidedWalk
    from pathloom_hga_aco.seeding import GaPheromoneSeed
    from pathloom_hga_aco.shortcut import GreedyParentShortcut

    for component in (
        GuidedWalk,
        AngleTablePenalty, MeanTurnAngle,
        SinglePointGeneAware, TwoWayReverseSearch, FamilyCompetition,
        EdgeLength, GaPheromoneSeed, TwoBest, DeadAngleTable,
        GaHgaAco, AcoHgaAco, HgaAco,
        Table2, Table3,
        GreedyParentShortcut, Rrt, SRrt,
        Mnb, Gnb, Svm, Knn, Rf,
    ):  # fmt: skip
        add(component)
