"""Plain genetic algorithms, one for each paper that compares itself with one.

A paper gives a population and a few rates, at best. What it leaves open is
filled with what stands in `basic_ga`, and its own fitness where it names one.
"""

import math
from dataclasses import dataclass
from typing import ClassVar

from pathloom import (
    Count,
    Crossover,
    Evolution,
    Fidelity,
    Fitness,
    Mutation,
    Repair,
    Sampling,
    Selection,
    Termination,
    Terms,
)
from pathloom.kernel.evaluation import WeightedReciprocals
from pathloom.kernel.selection import Roulette
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.objectives import Length, ObstaclesBeside, TurnAngle
from pathloom_baselines.basic_ga import HOLLAND, BasicGa
from pathloom_baselines.crossover import SinglePoint
from pathloom_baselines.mutation import SingleGene, TwoPoint
from pathloom_baselines.repair import DetourRemoval
from pathloom_baselines.sampling import GreedyWalk, RandomPerRow, RandomWalk

AGACD = "K. Hao, J. Zhao, B. Wang, Y. Liu, C. Wang (2021), doi:10.1155/2021/5536574"
IMGA = "K. Li, Q. Hu, J. Liu (2021), doi:10.1155/2021/8836615"
IMAGA = "Z. Zhang, Z. Ke, J. Zhou, Q. Qian, X. Hu (2023), doi:10.19322/j.cnki.issn.1006-4710.2023.01.007"
IGA = "Liu et al. (2024), A Robot Path-Planning Method Based on an Improved Genetic Algorithm, Trans. FAMENA"


@dataclass(frozen=True, kw_only=True)
class GaImga(Evolution):
    """The plain genetic algorithm that IMGA is compared with."""

    name: ClassVar[str] = "ga-imga"
    reference: ClassVar[str] = f"{HOLLAND}; parameters: {IMGA}, section 5.2"
    bibtex: ClassVar[str] = BasicGa.bibtex
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "The paper gives the control parameters only: 100 individuals, 50 generations, PC 0.8, PM 0.2.",
        "Paths begin as random walks with the loops cut out.",
        "Fitness is the reciprocal of the length.",
        "Single-point crossover exchanges tails at a node that both parents visit.",
        "Mutation moves one node to a free neighbour if the path stays connected.",
        "There is no elitism and no deletion; the best individual ever seen is the answer.",
    )

    sampling: Sampling = RandomWalk()
    objectives: Terms = Terms({"length": Length()})
    selection: Selection = Roulette()
    crossover: Crossover | None = SinglePoint(rate=0.8)
    mutation: Mutation | None = SingleGene(rate=0.2)
    termination: tuple[Termination, ...] = (MaxGenerations(limit=50),)


@dataclass(frozen=True, kw_only=True)
class GaLit37(BasicGa):
    """The improved genetic algorithm of "literature [37]" that IMGA is compared with."""

    name: ClassVar[str] = "ga-lit37"
    reference: ClassVar[str] = f"unknown: [37] in {IMGA} is about another subject; parameters: section 5.2"
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
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Only this is said: an improved genetic algorithm that eliminates some redundant path segments and turns.",
        "The printed reference is about tracking objects and cannot be meant; nothing here comes from it.",
        "Control parameters are those that the paper gives for all: 100 individuals, 50 generations, 0.8 and 0.2.",
        "Initialisation is greedy: every other step goes to the neighbour nearest to the goal, the others at random.",
        "Redundant segments are loops and whatever lies between two nodes that are one step apart; all are cut out.",
        "The printed length, 29.7990 = 10 + 14 √2, speaks of single steps: there is no deletion of points.",
        "Fitness is the reciprocal of the length; the rest is that of basic-ga.",
    )

    population: Count = 100
    sampling: Sampling = GreedyWalk()
    objectives: Terms = Terms({"length": Length()})
    repair: Repair | None = DetourRemoval()


@dataclass(frozen=True, kw_only=True)
class Bga(BasicGa):
    """BGA, the basic genetic algorithm that AGACD is compared with, as set for maps of 20 × 20."""

    name: ClassVar[str] = "bga"
    reference: ClassVar[str] = f"{HOLLAND}; parameters: {AGACD}, tables 6 and 10"
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "The paper gives the population, the generations and two fixed probabilities; fitness is that of AGACD.",
        "Initialisation draws a cell of each row. The paper times it: 0.31 s on 20 × 20, 43 s on 50 × 50, 140 times as "
        "long. On random maps with 15 and 20 % of obstacles random walks take 15 and 3 times as long, this 11 and 128 "
        "times, for all the paths that it drops.",
        "A midpoint in an obstacle gives way to one of 4 neighbours; with 8, far fewer paths fail: 7 and 6 times.",
        "There is no elitism and no final deletion, both of which the paper counts as AGACD's own.",
        "The rest is that of basic-ga.",
    )

    population: Count = 60
    sampling: Sampling = RandomPerRow(reach=4)
    # the weights are those of the ratios 1.2 and 1.4: 0.4118, 0.3431, 0.2451
    objectives: Terms = Terms(
        {
            "length": (Length(), 1.68 / 4.08),
            "smoothness": (TurnAngle(), 1.4 / 4.08),
            "safety": (ObstaclesBeside(base=1.0, each=0.1), 1.0 / 4.08),
        }
    )
    fitness: Fitness = WeightedReciprocals(floors=(1.0, math.radians(1.0), 1.0))
    mutation: Mutation | None = TwoPoint(rate=0.3)
    termination: tuple[Termination, ...] = (MaxGenerations(limit=300),)


@dataclass(frozen=True, kw_only=True)
class Bga50(Bga):
    """BGA as set for maps of 50 × 50."""

    name: ClassVar[str] = "bga-50"

    crossover: Crossover | None = SinglePoint(rate=0.9)
    termination: tuple[Termination, ...] = (MaxGenerations(limit=500),)


@dataclass(frozen=True, kw_only=True)
class GaImaga(BasicGa):
    """The traditional genetic algorithm that IMAGA is compared with."""

    name: ClassVar[str] = "ga-imaga"
    reference: ClassVar[str] = f"{HOLLAND}; compared with in: {IMAGA}, section 3"
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "The paper gives no parameters; population and generations are those of IMGA, whose operators it takes over.",
        "Fitness is the reciprocal of the length: the paths reported are short, and full of turns.",
        "The rest is that of basic-ga.",
    )

    population: Count = 100
    objectives: Terms = Terms({"length": Length()})


@dataclass(frozen=True, kw_only=True)
class GaIga(BasicGa):
    """The traditional genetic algorithm that IGA is compared with."""

    name: ClassVar[str] = "ga-iga"
    reference: ClassVar[str] = f"{HOLLAND}; parameters: {IGA}, sections 4.1 and 4.3"
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "The paper gives the population, the generations and two fixed probabilities.",
        "Fitness is the reciprocal of the length, without the constant of IGA's eq. (5).",
        "Loops are cut out where they arise; the paper's deleting operator for them came with IGA.",
        "The rest is that of basic-ga.",
    )

    population: Count = 300
    objectives: Terms = Terms({"length": Length()})
    mutation: Mutation | None = TwoPoint(rate=0.05)
    termination: tuple[Termination, ...] = (MaxGenerations(limit=150),)
