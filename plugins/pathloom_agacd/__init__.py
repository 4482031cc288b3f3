"""AGACD: the adaptive genetic algorithm based on collision detection of Hao et al. (2021).

The paper tests segments by small steps rounded to cells; makes its first paths
by greedy walks whose target is the goal every other time; adds up reciprocals
of length, turning and obstacles passed, weighted by ratios of importance; lets
the probabilities of crossover and mutation follow fitness and generation; and
deletes superfluous points of the final best.

Reference: K. Hao, J. Zhao, B. Wang, Y. Liu, C. Wang, "The Application of an
Adaptive Genetic Algorithm Based on Collision Detection in Path Planning of
Mobile Robots", Computational Intelligence and Neuroscience 2021, article
5536574, doi:10.1155/2021/5536574.

Section by section: 3 ``collision``, 4.1 ``repair``, 4.3 ``sampling``, 4.4
``objectives``, ``weighting`` and ``fitness``, 4.6 ``crossover``, 4.7
``mutation``, both ``probability``, 4.8 ``deletion``, 4.5 and 5 ``planner``, 5.2.1
``taguchi``. What it reports is measured again in ``claims`` and ``experiment``.
What the paper leaves open stands at the statement it concerns and in the
planner's ``assumptions``.
"""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the paper's operators, its planners and its claims."""
    from pathloom_agacd.claims import (
        Equation25,
        Figure6,
        Figure12,
        Section1,
        Section3,
        Section43,
        Section46,
        Section48,
        Table7,
        Table8,
        Table11,
        Table12,
    )
    from pathloom_agacd.collision import LinearTrial
    from pathloom_agacd.crossover import SinglePoint
    from pathloom_agacd.deletion import SequentialPointDeletion
    from pathloom_agacd.experiment import Table5, Table6
    from pathloom_agacd.fitness import ShiftedReciprocals
    from pathloom_agacd.mutation import SingleGene
    from pathloom_agacd.objectives import NeighbourPenaltyOnce, TurnAngleSum
    from pathloom_agacd.planner import Agacd, Agacd50
    from pathloom_agacd.probability import ExponentialFall, ExponentialRise
    from pathloom_agacd.repair import DropColliding
    from pathloom_agacd.sampling import GoalBiasedGreedyWalk
    from pathloom_agacd.weighting import DelphiRatio

    for component in (
        LinearTrial,
        GoalBiasedGreedyWalk,
        TurnAngleSum,
        NeighbourPenaltyOnce,
        DelphiRatio,
        ShiftedReciprocals,
        ExponentialFall,
        ExponentialRise,
        SinglePoint,
        SingleGene,
        DropColliding,
        SequentialPointDeletion,
        Agacd,
        Agacd50,
        Section1,
        Section3,
        Section43,
        Equation25,
        Section46,
        Section48,
        Table5,
        Table6,
        Figure6,
        Table7,
        Table8,
        Figure12,
        Table11,
        Table12,
    ):
        add(component)
