"""The genetic algorithm on grids that the field calls basic, standard or traditional."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import Count, Crossover, Evolution, Fidelity, Fitness, Mutation, Pairing, Sampling, Selection, Terms
from pathloom.kernel.evaluation import WeightedReciprocals
from pathloom.kernel.selection import ConsecutivePairs, Roulette
from pathloom.paths.objectives import Length
from pathloom_baselines.crossover import SinglePoint
from pathloom_baselines.mutation import TwoPoint
from pathloom_baselines.objectives import SmoothnessPenalty
from pathloom_baselines.sampling import RandomPerRow

HOLLAND = "J. H. Holland (1975), Adaptation in Natural and Artificial Systems, University of Michigan Press"


@dataclass(frozen=True, kw_only=True)
class BasicGa(Evolution):
    """The basic genetic algorithm on a grid, as much public code has it."""

    name: ClassVar[str] = "basic-ga"
    reference: ClassVar[str] = HOLLAND
    bibtex: ClassVar[str] = """\
@book{holland1975adaptation,
  author    = {Holland, John H.},
  title     = {Adaptation in Natural and Artificial Systems},
  publisher = {University of Michigan Press},
  year      = {1975}
}
"""
    fidelity: ClassVar[Fidelity] = "standard"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Holland describes the algorithm, not the paths: operators and parameters are those common in public code.",
        "Where start and goal lie further apart in columns than in rows, the first cells are drawn from columns.",
        "A midpoint in an obstacle gives way to a random one of 8 neighbours, never to an end of the gap.",
        "A gap takes at most 4 (height + width) insertions; loops are cut out.",
        "After 10000 failures in a row no more paths are drawn, and those found are repeated.",
        "Fitness is 1 / L + 7 / (S + 1): public code divides by the penalty S itself, which a straight path has not.",
        "Parents without a common interior cell stay, and so does a path whose mutation failed 20 times.",
        "There is no elitism; the best individual ever seen is the answer.",
    )

    population: Count = 200
    sampling: Sampling = RandomPerRow()
    objectives: Terms = Terms({"length": (Length(), 1.0), "smoothness": (SmoothnessPenalty(base=1.0), 7.0)})
    fitness: Fitness = WeightedReciprocals()
    selection: Selection = Roulette()
    pairing: Pairing = ConsecutivePairs()
    crossover: Crossover | None = SinglePoint(rate=0.8)
    mutation: Mutation | None = TwoPoint(rate=0.2)
