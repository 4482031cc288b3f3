"""IGA: the improved genetic algorithm with a reference population of Liu, Cai and Cao (2024).

The paper makes its first paths by joining one random cell of each row with
inserted midpoints; judges them by their length; adapts the probabilities of
crossover and mutation along a sinc; crosses at a common gene; makes the stretch
between two genes anew; cuts loops and superfluous points out of every path in
every generation; and lets a second population exchange individuals with the
main one.

Reference: J. Liu, Y. Cai, Y. Cao, "A Robot Path-Planning Method Based on an
Improved Genetic Algorithm", Transactions of FAMENA 2024.

Section by section: 3.2 ``sampling``, 3.3 ``fitness``, 3.4.1 ``probability``,
3.4.2 ``crossover``, 3.4.3 ``mutation``, 3.5 the kernel's ``loop-removal``, 3.6
``deletion`` and ``collision``, 3.7 ``migration``, 4 ``planner``. ``claims`` measures
again what section 4 says, ``claims_of_parts`` what section 3 says. What the paper
leaves open stands at the statement it concerns and in the planner's
``assumptions``.
"""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the paper's operators and its planner."""
    from pathloom_iga.claims import Section37, Section41, Section42, SuccessRates, Table1, Table2
    from pathloom_iga.claims_of_parts import Equation11, Section31, Section32, Section33, Section34, Section35
    from pathloom_iga.collision import LineDistance, SegmentDistance
    from pathloom_iga.crossover import CommonNode
    from pathloom_iga.deletion import TripletPointDeletion
    from pathloom_iga.fitness import ReciprocalLengthPlusConstant
    from pathloom_iga.migration import ReferencePopulation
    from pathloom_iga.mutation import TwoPointMidpoint
    from pathloom_iga.planner import Iga
    from pathloom_iga.probability import SincAdaptive
    from pathloom_iga.sampling import RowWise

    for component in (
        RowWise,
        ReciprocalLengthPlusConstant,
        SincAdaptive,
        CommonNode,
        TwoPointMidpoint,
        TripletPointDeletion,
        LineDistance,
        SegmentDistance,
        ReferencePopulation,
        Iga,
        Section41,
        Section42,
        Section37,
        Table1,
        Table2,
        SuccessRates,
        Section31,
        Section32,
        Section33,
        Section34,
        Section35,
        Equation11,
    ):
        add(component)
