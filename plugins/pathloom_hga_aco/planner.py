"""Section 5.6: the paper's genetic algorithm and its ant colony, each on its own, with the paper's parameters."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import (
    Colony,
    Control,
    Count,
    Crossover,
    Deadlock,
    Evolution,
    Fidelity,
    Fitness,
    Mutation,
    NonNegative,
    PheromoneUpdate,
    Sampling,
    Selection,
    Termination,
    Terms,
)
from pathloom.kernel.evaluation import WeightedReciprocals
from pathloom.kernel.selection import Roulette
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.ants.ant_system import AntSystem, Die
from pathloom.paths.objectives import Length
from pathloom_hga_aco.control import FamilyCompetition
from pathloom_hga_aco.crossover import SinglePointGeneAware
from pathloom_hga_aco.mutation import TwoWayReverseSearch
from pathloom_hga_aco.objectives import AngleTablePenalty
from pathloom_hga_aco.sampling import GuidedWalk

SONG = (
    "Q. Song, S. Li, J. Yang, Q. Bai, J. Hu, X. Zhang, A. Zhang (2021), Intelligent Optimization Algorithm-Based Path "
    "Planning for a Mobile Robot, Computational Intelligence and Neuroscience, 8025730, doi:10.1155/2021/8025730"
)
BIBTEX = """\
@article{song2021hgaaco,
  author  = {Song, Qisong and Li, Shaobo and Yang, Jing and Bai, Qiang and Hu, Jianjun and Zhang, Xingxing
             and Zhang, Ansi},
  title   = {Intelligent Optimization Algorithm-Based Path Planning for a Mobile Robot},
  journal = {Computational Intelligence and Neuroscience},
  year    = {2021},
  pages   = {8025730},
  doi     = {10.1155/2021/8025730}
}
"""


GENETIC = (
    "The genetic algorithm's population is not given; it is that of the ants, M = 50.",
    "Its initialisation is not described; it is a random walk, drawn to the goal, that steps back from dead ends.",
    "The angle table (23) and its penalties (24) are printed the wrong way round: they would charge most for going "
    "straight on. A reversal costs as much as 45 degrees.",
    "The penalties of a straight path sum to 0, and f2 (25) divides by that: the sum counts as at least 1.",
    "Pairs for crossover are drawn at random from the selected individuals.",
    "Tails that begin apart are joined by median insertion; where that fails the parent stays.",
    "The best two different ones of two parents and two children go on.",
    "The mutation's search is not given; it is the walk of the initialisation, around the part that stays.",
    "The fitter mutant takes the individual's place, even if that was fitter. There is no elitism.",
)
"""What is assumed of the genetic algorithm, alone or as a part."""
ANTS = (
    "The distance in the heuristic (30) is that from the next cell to the goal. The length of the step, as printed, is "
    "to be had with heuristic = edge-length: it knows two values, and with beta = 7 ants shun diagonals.",
    "100 iterations follow the first march, as the generations of an evolution follow its first population.",
)
"""What is assumed of the ant colony, alone or as a part."""


@dataclass(frozen=True, kw_only=True)
class GaHgaAco(Evolution):
    """The genetic algorithm of HGA-ACO, which the paper also compares it with."""

    name: ClassVar[str] = "ga-hga-aco"
    reference: ClassVar[str] = f"{SONG}; section 5.3"
    bibtex: ClassVar[str] = BIBTEX
    fidelity: ClassVar[Fidelity] = "faithful"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Whether the GA of table 3 is this one or a plain one is not said; it is taken to be this one.",
        *GENETIC,
        "The best individual ever seen is the answer.",
    )

    population: Count = 50
    sampling: Sampling = GuidedWalk()
    objectives: Terms = Terms(
        {"length": (Length(), 1.0), "smoothness": (AngleTablePenalty(), 7.0)}
    )  # a and b of eq. (26)
    fitness: Fitness = WeightedReciprocals(floors=(1.0, 1.0))
    selection: Selection = Roulette()
    crossover: Crossover | None = SinglePointGeneAware(rate=0.8)  # Pc
    mutation: Mutation | None = TwoWayReverseSearch(rate=0.2)  # Pm
    control: Control = FamilyCompetition()
    termination: tuple[Termination, ...] = (MaxGenerations(limit=100),)  # N_max


@dataclass(frozen=True, kw_only=True)
class AcoHgaAco(Colony):
    """The ant colony that HGA-ACO is compared with."""

    name: ClassVar[str] = "aco-hga-aco"
    reference: ClassVar[str] = f"{SONG}; section 5.5, eqs. (29) to (31), and table 3"
    bibtex: ClassVar[str] = BIBTEX
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Of the ACO of table 3 only the parameters are known; it is Ant System, without seeding and dead-angle table.",
        *ANTS,
        "The first pheromone is 1 everywhere. An ant that finds no way on dies.",
    )

    ants: Count = 50  # M
    alpha: NonNegative = 1.0
    beta: NonNegative = 7.0
    pheromone: PheromoneUpdate = AntSystem(rho=0.3, q=1.0)
    deadlock: Deadlock = Die()
    termination: tuple[Termination, ...] = (MaxGenerations(limit=100),)  # N_c
