"""IMGA: the improved multi-objective genetic algorithm of Li, Hu and Liu (2021).

The paper makes its first paths by inserting midpoints between start, one random
cell and goal; judges them by length, nodes beside obstacles and the direction of
turns in one weighted sum; selects by layers; crosses at a common node; moves
single nodes to a neighbour; and deletes superfluous nodes of the final best.

Reference: K. Li, Q. Hu, J. Liu, "Path Planning of Mobile Robot Based on Improved
Multiobjective Genetic Algorithm", Wireless Communications and Mobile Computing
2021, article 8836615, doi:10.1155/2021/8836615.

Section by section: 4.1 ``sampling``, 4.2 ``objectives``, 4.3.1 ``selection``,
4.3.2 ``crossover``, 4.3.3 ``mutation``, 4.5 ``deletion``, 4.4, 4.6 and 5.1
``planner``, 5 ``claims``. What the paper leaves open stands at the statement it concerns and
in the planner's ``assumptions``.
"""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the paper's operators and its planner."""
    from pathloom_imga.claims import Table1, Table2, Table3, Table4
    from pathloom_imga.crossover import CommonNode
    from pathloom_imga.deletion import SequentialPointDeletion
    from pathloom_imga.mutation import D8GeneMedian
    from pathloom_imga.objectives import QuadrantEnergy, UnsafeNode
    from pathloom_imga.planner import Imga
    from pathloom_imga.sampling import MedianInsertion
    from pathloom_imga.selection import ThreeLayer

    for component in (
        MedianInsertion,
        UnsafeNode,
        QuadrantEnergy,
        ThreeLayer,
        CommonNode,
        D8GeneMedian,
        SequentialPointDeletion,
        Imga,
        Table1,
        Table2,
        Table3,
        Table4,
    ):
        add(component)
