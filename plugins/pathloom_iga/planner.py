"""Sections 3 and 4: the planner, with the paper's parameters."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import (
    Count,
    Crossover,
    Evolution,
    Fidelity,
    Fitness,
    Migration,
    Mutation,
    Repair,
    Sampling,
    Selection,
    Termination,
    Terms,
)
from pathloom.kernel.repair import InTurn
from pathloom.kernel.selection import Roulette
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.loops import LoopRemoval
from pathloom.paths.objectives import Length
from pathloom_iga.crossover import CommonNode
from pathloom_iga.deletion import TripletPointDeletion
from pathloom_iga.fitness import ReciprocalLengthPlusConstant
from pathloom_iga.migration import ReferencePopulation
from pathloom_iga.mutation import TwoPointMidpoint
from pathloom_iga.probability import SincAdaptive
from pathloom_iga.sampling import RowWise


@dataclass(frozen=True, kw_only=True)
class Iga(Evolution):
    """IGA, the improved genetic algorithm with a reference population."""

    name: ClassVar[str] = "iga"
    reference: ClassVar[str] = (
        "J. Liu, Y. Cai, Y. Cao (2024), A Robot Path-Planning Method Based on an Improved Genetic Algorithm, "
        "Transactions of FAMENA"
    )
    bibtex: ClassVar[str] = """\
@article{liu2024iga,
  author  = {Liu, Jixin and Cai, Yanbin and Cao, Yue},
  title   = {A Robot Path-Planning Method Based on an Improved Genetic Algorithm},
  journal = {Transactions of FAMENA},
  year    = {2024}
}
"""
    fidelity: ClassVar[Fidelity] = "faithful"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Eq. (1) is read with labels from 1, x the row and y the column: N = (x - 1) G + y.",
        "A midpoint in an obstacle (4) gives way to a random free neighbour; the paper has no rule.",
        "The cell of a row is drawn again where it cannot be joined to the one before, up to 20 times.",
        "Rows become columns where start and goal lie further apart in columns; the way may go in any direction.",
        "C of eq. (5), a large positive number, is 0.01: a large one leaves roulette selection without pressure.",
        "Selection is roulette, of which the paper speaks beside eq. (5), and there is no elitism.",
        "f_min in the text under eq. (6) means the mean, f_avg; where all are as fit, the probability is the highest.",
        "Pairs for crossover are drawn at random from the selected individuals; without a common gene they stay.",
        "The two genes of a mutation have at least one between them, and are drawn up to 10 times.",
        "In each generation loops go first (3.5), then points (3.6), once along the path.",
        "Points are deleted by the exact segment test under the problem's corner policy: eq. (11) as printed rejects "
        "nearly every free segment, and 13.8 on map 1 is out of reach with it.",
        "B's best and A's best are copied, 5 % of the population each, over the other's worst, "
        "in generations 3, 6, ..., 99 (3.7, 4.3).",
        "The answer is the fittest individual that either population ever had.",
    )

    population: Count = 300
    sampling: Sampling = RowWise(loops=True)
    objectives: Terms = Terms({"length": Length()})
    fitness: Fitness = ReciprocalLengthPlusConstant()
    selection: Selection = Roulette()
    crossover: Crossover | None = CommonNode(probability=SincAdaptive(low=0.5, high=0.8), loops=True)  # section 4.1
    mutation: Mutation | None = TwoPointMidpoint(probability=SincAdaptive(low=0.01, high=0.1), loops=True)
    repair: Repair | None = InTurn(steps=(LoopRemoval(), TripletPointDeletion()))
    migration: Migration | None = ReferencePopulation()
    termination: tuple[Termination, ...] = (MaxGenerations(limit=150),)
