"""IMAGA: the improved multi-objective adaptive genetic algorithm of Zhang et al. (2023).

The paper draws its first paths through libraries of nodes, each node near the one
before; judges them by length, obstacles beside them and energy; adapts crossover
and mutation to the fitness of the least and the most fit only; repeats the
operators in a generation that does not improve; and deletes superfluous nodes of
the final best.

Reference: ZHANG Zheng, KE Zipeng, ZHOU Jiazheng, QIAN Qinjian, HU Xinyu, "Robot
path planning based on improved multi-objective adaptive genetic algorithm",
Journal of Xi'an University of Technology 39(1), 2023, 69-78 (in Chinese),
doi:10.19322/j.cnki.issn.1006-4710.2023.01.007.

Section by section: 2.1 ``sampling``, ``libraries`` and ``step_length``, 2.2
``objectives`` and ``weighting``, 2.3 ``selection``, 2.4 ``probability``,
``crossover`` and ``mutation``, 2.5 ``control``, 2.6 ``collision`` and
``deletion``, 2.7 and 3 ``planner``. ``claims`` measures again what sections 3 and 4
say, ``claims_of_parts`` what section 2 says. What the paper leaves open stands at
the statement it concerns and in the planner's ``assumptions``.
"""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the paper's operators and its planner."""
    from pathloom_imaga.claims import Controls, Figure12, Table1, Table2
    from pathloom_imaga.claims_of_parts import Equation16, Section21, Section22, Section24, Section25, Section26
    from pathloom_imaga.collision import RecursiveMidpoint
    from pathloom_imaga.control import AdaptiveEvolution
    from pathloom_imaga.crossover import PositionalSinglePoint
    from pathloom_imaga.deletion import MidpointPointDeletion
    from pathloom_imaga.mutation import D4GeneMedian
    from pathloom_imaga.objectives import D4ObstacleCount, EnergyPerLength, TurnCount
    from pathloom_imaga.planner import Imaga
    from pathloom_imaga.probability import BandedAdaptive
    from pathloom_imaga.sampling import RestrictedUniform
    from pathloom_imaga.selection import GreedyRoulette, ThreeStage
    from pathloom_imaga.step_length import FittedStep, PublishedStep
    from pathloom_imaga.weighting import ReferenceScaled

    for component in (
        RestrictedUniform,
        FittedStep,
        PublishedStep,
        D4ObstacleCount,
        TurnCount,
        EnergyPerLength,
        ReferenceScaled,
        GreedyRoulette,
        ThreeStage,
        BandedAdaptive,
        PositionalSinglePoint,
        D4GeneMedian,
        AdaptiveEvolution,
        RecursiveMidpoint,
        MidpointPointDeletion,
        Imaga,
        Table1,
        Table2,
        Figure12,
        Controls,
        Section21,
        Equation16,
        Section22,
        Section24,
        Section25,
        Section26,
    ):
        add(component)
