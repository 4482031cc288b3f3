"""Sections 4.4, 4.6 and 5.1: the planner, algorithm 1 with the paper's parameters."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import (
    Archive,
    Count,
    Crossover,
    Evolution,
    Fidelity,
    Mutation,
    Repair,
    Sampling,
    Selection,
    Termination,
    Terms,
)
from pathloom.kernel.archive import BestRefined
from pathloom.kernel.termination import MaxGenerations, Stagnation, WallTime
from pathloom.paths.objectives import Length
from pathloom_imga.crossover import CommonNode
from pathloom_imga.deletion import SequentialPointDeletion
from pathloom_imga.mutation import D8GeneMedian
from pathloom_imga.objectives import QuadrantEnergy, UnsafeNode
from pathloom_imga.sampling import MedianInsertion
from pathloom_imga.selection import ThreeLayer


@dataclass(frozen=True, kw_only=True)
class Imga(Evolution):
    """IMGA, the improved multi-objective genetic algorithm."""

    name: ClassVar[str] = "imga"
    reference: ClassVar[str] = (
        "K. Li, Q. Hu, J. Liu (2021), Path Planning of Mobile Robot Based on Improved Multiobjective Genetic "
        "Algorithm, Wireless Communications and Mobile Computing, 8836615, doi:10.1155/2021/8836615"
    )
    bibtex: ClassVar[str] = """\
@article{li2021imga,
  author  = {Li, Kairong and Hu, Qianqian and Liu, Jinpeng},
  title   = {Path Planning of Mobile Robot Based on Improved Multiobjective Genetic Algorithm},
  journal = {Wireless Communications and Mobile Computing},
  year    = {2021},
  pages   = {8836615},
  doi     = {10.1155/2021/8836615}
}
"""
    fidelity: ClassVar[Fidelity] = "faithful"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Termination (4.4) is read as: 50 generations, or 40 without a change of the best, or 5 minutes.",
        "The penalty of 5 (6) counts once for a node, not once for each obstacle beside it.",
        "Quadrants (7) belong to axes from start to goal; along an axis, towards is the first, away the third.",
        "Median insertion (4.1) is guarded against going in circles, and cuts loops out.",
        "Pairs for crossover are drawn at random from the selected individuals.",
        "There is no elitism; the best individual ever seen is archived, as algorithm 1 implies.",
        "The answer is the shortest path that deletion makes of any individual (algorithm 1: output shortest path). "
        "With the fittest instead (archive none) the printed lengths are out of reach: 29.6896 is no optimum of (4).",
        "Deletion (4.5) takes one pass with the exact segment test under the problem's corner policy.",
        "Between cells whose diagonal the corner policy forbids, a cell beside it is inserted.",
    )

    population: Count = 100
    sampling: Sampling = MedianInsertion()
    objectives: Terms = Terms(
        {"length": (Length(), 6.0), "safety": (UnsafeNode(), 1.0), "energy": (QuadrantEnergy(), 3.0)}
    )  # a, b, c of eq. (4), section 5.1
    selection: Selection = ThreeLayer()
    crossover: Crossover | None = CommonNode(rate=0.8)  # PC, section 5.1
    mutation: Mutation | None = D8GeneMedian(rate=0.2)  # PM, section 5.1
    refinement: Repair | None = SequentialPointDeletion()
    archive: Archive | None = BestRefined(objective=Length())
    termination: tuple[Termination, ...] = (
        MaxGenerations(limit=50),
        Stagnation(patience=40),
        WallTime(seconds=300.0),
    )
