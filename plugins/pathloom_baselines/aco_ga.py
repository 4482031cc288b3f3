"""Genetic algorithms whose first population ants have walked: what is called ACO-GA, in two forms."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import (
    Colony,
    Count,
    Crossover,
    Evolution,
    Fidelity,
    Indices,
    Mutation,
    Population,
    Problem,
    Repair,
    Sampling,
    Selection,
    Termination,
    Terms,
    compiled,
    count,
)
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.ants.ant_system import AntSystem
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.objectives import Length
from pathloom.paths.pathwise import path_problem
from pathloom_baselines.ants import DORIGO, InProportion, NoWorseThanMean, StepAndGoalDistance
from pathloom_baselines.basic_ga import HOLLAND, BasicGa
from pathloom_baselines.crossover import SinglePoint
from pathloom_baselines.mutation import TwoPoint
from pathloom_baselines.objectives import SmoothnessPenalty
from pathloom_baselines.selection import KeepAll


@dataclass(frozen=True, kw_only=True)
class AntPaths(Sampling):
    """Let a colony of ants come to its end, and take the paths of its last march, the best first.

    Where they are too few they are repeated, and the repeats are mutated.
    """

    source: ClassVar[str] = "public programs for grids"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    colony: Colony = Colony(termination=(MaxGenerations(limit=10),))
    """The ants, until their own termination. What they measure counts as evaluations."""
    mutation: Mutation | None = TwoPoint()
    """Changes the repeats, every one of them."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        state = self.colony.start(problem, rng)
        while not self.colony.done(state):
            state = self.colony.step(state)
        rng.bit_generator.state = state.random  # go on where the ants stopped
        count("evaluations", state.evaluations)
        for event, times in state.counts.items():
            count(event, times)
        if len(state.population) == 0:
            count("samples failed", self.colony.ants)
            return state.population
        ranked = np.argsort(-state.fitness, kind="stable")
        found = np.ascontiguousarray(state.population[np.resize(ranked, n)])
        if n <= len(ranked):
            return found
        count("samples repeated", n - len(ranked))
        if self.mutation is None:
            return found
        return self.mutation.apply(found, np.arange(len(ranked), n), problem, rng)


@dataclass(frozen=True, kw_only=True)
class AcoGa(BasicGa):
    """ACO-GA: a genetic algorithm that begins with the paths of ants, and cuts corners."""

    name: ClassVar[str] = "aco-ga"
    reference: ClassVar[str] = f"{DORIGO}; {HOLLAND}; the sequence of both is common in public code"
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Papers that compare themselves with ACO-GA give neither its form nor its parameters; this is what public code "
        "has. Its ants: 50, 100 iterations, alpha 2, beta 6, rho 0.1, Q 1, tau 10 eta at first. Its genetic algorithm: "
        "200 generations, probabilities 0.2 and 0.05, fitness 20 / L + 1 / S.",
        "The first population are the paths of the last march; so it has as many individuals as there are ants. Where "
        "some are lost, other paths are repeated and mutated.",
        "After each generation every node goes whose neighbours see each other, by the exact test; public code tests a "
        "rectangle.",
        "The penalty S of a straight path is 0, and public code divides by it; here S is one more.",
        "The rest of the ants is that of aco, the rest of the genetic algorithm that of basic-ga.",
    )

    population: Count = 50
    sampling: Sampling = AntPaths(
        colony=Colony(
            alpha=2.0,
            beta=6.0,
            initial=InProportion(factor=10.0),
            pheromone=AntSystem(rho=0.1),
            termination=(MaxGenerations(limit=100),),
        )
    )
    objectives: Terms = Terms({"length": (Length(), 20.0), "smoothness": (SmoothnessPenalty(base=1.0), 1.0)})
    crossover: Crossover | None = SinglePoint(rate=0.2)
    mutation: Mutation | None = TwoPoint(rate=0.05)
    repair: Repair | None = PointDeletion()
    termination: tuple[Termination, ...] = (MaxGenerations(limit=200),)


@dataclass(frozen=True, kw_only=True)
class ShorterParts(Crossover):
    """Make one child that goes, from each common cell to the next, the way of the parent who is quicker.

    It takes the place of the longer parent, where it is shorter. Common cells
    count as far as they follow each other in both parents.
    """

    source: ClassVar[str] = "our reconstruction of Châari et al. 2014"
    works_on: ClassVar[str] = "cells"

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        children, failed = compiled.merging.merge(population, np.ascontiguousarray(pairs), it.blocked.size, it.cols)
        count("crossover without gain", failed)
        return np.asarray(children)


@dataclass(frozen=True, kw_only=True)
class Smartpath(Evolution):
    """SmartPATH, an ant colony whose last paths are crossed, as far as it can be known from outside."""

    name: ClassVar[str] = "smartpath"
    reference: ClassVar[str] = (
        "I. Châari, A. Koubâa, S. Trigui, H. Bennaceur, A. Ammar, K. Al-Shalfan (2014), SmartPATH: An Efficient Hybrid "
        "ACO-GA Algorithm for Solving the Global Path Planning Problem of Mobile Robots, International Journal of "
        "Advanced Robotic Systems 11(7), 94, doi:10.5772/58543"
    )
    bibtex: ClassVar[str] = """\
@article{chaari2014smartpath,
  author  = {Ch{\\^a}ari, Imen and Koub{\\^a}a, Anis and Trigui, Sahar and Bennaceur, Hachemi and Ammar, Adel
             and Al-Shalfan, Khaled},
  title   = {{SmartPATH}: An Efficient Hybrid {ACO-GA} Algorithm for Solving the Global Path Planning Problem
             of Mobile Robots},
  journal = {International Journal of Advanced Robotic Systems},
  volume  = {11},
  number  = {7},
  year    = {2014},
  pages   = {94},
  doi     = {10.5772/58543}
}
"""
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Only the abstract was at hand: an improved colony for fast path selection, then a modified crossover that "
        "lowers the risk of a local minimum. All that follows is ours.",
        "The heuristic adds the length of the step to the distance from where it leads to the goal.",
        "Ants leave pheromone whose paths are no longer than the mean of their march; the rest of the colony is as "
        "in aco.",
        "The paths of the last march are the population. The child of a pair goes, from each common cell to the next, "
        "the shorter of both ways, and takes the place of the longer parent if it is shorter.",
        "Every pair is crossed, drawn anew in each of 20 generations; there is neither selection nor mutation.",
    )

    population: Count = 50
    sampling: Sampling = AntPaths(
        colony=Colony(
            heuristic=StepAndGoalDistance(),
            pheromone=NoWorseThanMean(),
            termination=(MaxGenerations(limit=100),),
        )
    )
    objectives: Terms = Terms({"length": Length()})
    selection: Selection = KeepAll()
    crossover: Crossover | None = ShorterParts(rate=1.0)
    termination: tuple[Termination, ...] = (MaxGenerations(limit=20),)
