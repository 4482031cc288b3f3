"""Sections 4.1 and 5: the planner, with the parameters of tables 6 and 10."""

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
    Survival,
    Termination,
    Terms,
    Weighting,
)
from pathloom.kernel.evaluation import WeightedReciprocals
from pathloom.kernel.selection import Roulette
from pathloom.kernel.survival import KeepBest
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.objectives import Length
from pathloom_agacd.crossover import SinglePoint
from pathloom_agacd.deletion import SequentialPointDeletion
from pathloom_agacd.mutation import SingleGene
from pathloom_agacd.objectives import NeighbourPenaltyOnce, TurnAngleSum
from pathloom_agacd.probability import ExponentialFall, ExponentialRise
from pathloom_agacd.sampling import GoalBiasedGreedyWalk
from pathloom_agacd.weighting import DelphiRatio


@dataclass(frozen=True, kw_only=True)
class Agacd(Evolution):
    """AGACD, the adaptive genetic algorithm based on collision detection, as set for maps of 20 × 20."""

    name: ClassVar[str] = "agacd"
    reference: ClassVar[str] = (
        "K. Hao, J. Zhao, B. Wang, Y. Liu, C. Wang (2021), The Application of an Adaptive Genetic Algorithm Based on "
        "Collision Detection in Path Planning of Mobile Robots, Computational Intelligence and Neuroscience, 5536574, "
        "doi:10.1155/2021/5536574"
    )
    bibtex: ClassVar[str] = """\
@article{hao2021agacd,
  author  = {Hao, Kun and Zhao, Jiale and Wang, Beibei and Liu, Yonglei and Wang, Chuanqi},
  title   = {The Application of an Adaptive Genetic Algorithm Based on Collision Detection in Path Planning of Mobile Robots},
  journal = {Computational Intelligence and Neuroscience},
  year    = {2021},
  pages   = {5536574},
  doi     = {10.1155/2021/5536574}
}
"""  # noqa: E501 - a title is one line
    fidelity: ClassVar[Fidelity] = "faithful"
    assumptions: ClassVar[tuple[str, ...]] = (
        "The linear trial (3)-(6) knows no corner policy: what it lets pass must also pass the exact test.",
        "Walks (4.3) longer than 20 (height + width) steps are given up; after 20 in a row perturbed trees take over.",
        "Loops are cut out of walks, children and mutants; of equally near neighbours a walk takes any.",
        "Smoothness (10) is in radians, which the printed fitness values imply; below 1 degree it counts as 1 degree.",
        "Turns (13) are taken from directions, not from slopes, which take going straight back for going straight on.",
        "Safety (18) counts obstacles beside the points of a path, not beside its segments.",
        "One best individual survives each generation, in the place of the worst child; selection is by roulette.",
        "Pairs for crossover are drawn at random from the selected individuals, and f_max and f_avg are theirs.",
        "Crossover (4.6) cuts each parent at a place of its own and joins the halves by a straight segment.",
        "Mutation (4.7) moves one interior point to a random free one of its 8 neighbours.",
        "Whether a child is mutated follows its parent's fitness: its own is not known yet.",
        "For an individual that collides its parent stays, so that the population keeps its size.",
        "The mutation probability (29) is cut off at 1; its middle branch takes pm_low and (26) pc_high, as printed.",
        "The best individual ever seen is the answer; point deletion (4.8) takes one pass over it.",
    )

    population: Count = 60
    sampling: Sampling = GoalBiasedGreedyWalk()
    objectives: Terms = Terms({"length": Length(), "smoothness": TurnAngleSum(), "safety": NeighbourPenaltyOnce()})
    weighting: Weighting | None = DelphiRatio()  # 0.4118, 0.3431, 0.2451, eq. (25)
    fitness: Fitness = WeightedReciprocals(floors=(1.0, math.radians(1.0), 1.0))  # eqs. (7) and (8)
    selection: Selection = Roulette()
    crossover: Crossover | None = SinglePoint(probability=ExponentialFall(low=0.65, high=0.7))
    mutation: Mutation | None = SingleGene(probability=ExponentialRise(low=0.15, high=0.3))
    survival: Survival = KeepBest(elites=1)
    refinement: Repair | None = SequentialPointDeletion()
    termination: tuple[Termination, ...] = (MaxGenerations(limit=300),)


@dataclass(frozen=True, kw_only=True)
class Agacd50(Agacd):
    """AGACD as set for maps of 50 × 50, table 10."""

    name: ClassVar[str] = "agacd-50"

    population: Count = 80
    crossover: Crossover | None = SinglePoint(probability=ExponentialFall(low=0.75, high=0.9))
    termination: tuple[Termination, ...] = (MaxGenerations(limit=500),)
