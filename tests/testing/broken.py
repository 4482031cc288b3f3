"""Components that are deliberately broken: each breaks one promise, which its name says, and keeps all others."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from multiprocessing import parent_process
from typing import Any, ClassVar

import numpy as np

import pathloom as pl
from pathloom.kernel.selection import Roulette
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.maps import MapFamily
from pathloom.paths.objectives import Length
from pathloom.paths.tree_seeding import PerturbedTrees

component = dataclass(frozen=True, kw_only=True)
LENGTH = Length()
TREES = PerturbedTrees()


@component
class Wheel(pl.Selection):
    """A selection as it should be."""

    def select(self, fitness, n, rng):
        return Roulette().select(fitness, n, rng)


@component
class Made(Wheel):
    """Needs what nobody can guess."""

    prices: Mapping[str, Any] = field()


@component
class Described(Wheel):  # it says nothing of itself
    pass


@component
class Cited(pl.Evolution):
    """Names a publication, but not how it is cited."""

    reference: ClassVar[str] = "A. Author (1999)"
    assumptions: ClassVar[tuple[str, ...]] = ("It was so.",)

    sampling: pl.Sampling = TREES
    objectives: pl.Terms = pl.Terms({"length": LENGTH})


@component
class ParametersRefused(Wheel):
    """Takes anything."""

    size: pl.Count = 2

    def __post_init__(self):
        pass


@component
class ParametersTaken(Wheel):
    """Takes its default only, whatever it declares."""

    size: pl.Count = 7

    def __post_init__(self):
        super().__post_init__()
        if self.size != 7:
            raise pl.ConfigError(f"size is 7; got {self.size}")


@component
class Value(Wheel):
    """Has another hash every time."""

    def __hash__(self):
        return id(self)


@component
class Pickled(Wheel):
    """Does not want to be pickled."""

    def __reduce__(self):
        raise TypeError("no")


@component
class Rebuilt(Wheel):
    """Is larger each time that it is built."""

    size: pl.Count = 2

    def __post_init__(self):
        super().__post_init__()
        object.__setattr__(self, "size", self.size + 1)


@component
class Answers(Wheel):
    """Does not know what to do with three."""

    def select(self, fitness, n, rng):
        if n == 3:
            raise ZeroDivisionError("three")
        return super().select(fitness, n, rng)


@component
class InputsKept(Wheel):
    """Writes into the fitness that it is given."""

    def select(self, fitness, n, rng):
        fitness *= 1.0 + 1e-12
        return super().select(fitness, n, rng)


@component
class Silent(Wheel):
    """Talks."""

    def select(self, fitness, n, rng):
        print("I select")
        return super().select(fitness, n, rng)


CALLS = [0]


@component
class Repeatable(Wheel):
    """Remembers how often it was called."""

    def select(self, fitness, n, rng):
        CALLS[0] += 1
        return super().select(fitness, n, np.random.default_rng(CALLS[0]))


@component
class OwnGenerator(Wheel):
    """Draws from numpy's global generator."""

    def select(self, fitness, n, rng):
        return super().select(fitness, n, np.random.default_rng(np.random.randint(9)))  # noqa: NPY002


@component
class OtherProcess(Wheel):
    """Does something else in another process."""

    def select(self, fitness, n, rng):
        return super().select(fitness, n, rng) if parent_process() else np.arange(n)


@component
class Shape(Wheel):
    """Gives a list where an array is promised."""

    def select(self, fitness, n, rng):
        return super().select(fitness, n, rng).tolist()


@component
class FavoursTheFit(Wheel):
    """Chooses the least fit."""

    def select(self, fitness, n, rng):
        return np.resize(np.argsort(fitness)[: (n + 1) // 2], n)


@component
class Careless(pl.Mutation):
    """A mutation that changes nothing, but where a map is strict: there it does what `carelessly` does."""

    works_on: ClassVar[str] = "cells"

    def apply(self, population, chosen, problem, rng):
        if problem.corners != "strict" or population.shape[1] == 2:
            return population
        return self.carelessly(population.copy(), chosen, problem)

    def carelessly(self, children, chosen, problem):
        return children


@component
class Ends(Careless):
    """Loses the goal."""

    def carelessly(self, children, chosen, problem):
        for k in chosen:
            children[k, (children[k] >= 0).sum() - 1] = -1
        return children


@component
class Free(Careless):
    """Goes straight from start to goal."""

    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    def carelessly(self, children, chosen, problem):
        children[chosen] = -1
        children[chosen, 0], children[chosen, 1] = problem.context.start, problem.context.goal
        return children


@component
class SingleSteps(Careless):
    """Leaves out cells, and does not say so."""

    def carelessly(self, children, chosen, problem):
        deleted = PointDeletion().apply(children[chosen], problem, np.random.default_rng(0))
        children[chosen] = -1
        children[chosen, : deleted.shape[1]] = deleted
        return children


@component
class OthersKept(Careless):
    """Changes somebody who was not chosen."""

    def carelessly(self, children, chosen, problem):
        children[-1] = children[0]
        return children


@component
class ParentKept(Careless):
    """Goes back and forth where there is nowhere else to go."""

    def apply(self, population, chosen, problem, rng):
        short = (population >= 0).sum(axis=1) == 2
        return np.tile(population[:, :2], 2) if short.all() else population


@component
class Smallest(pl.Sampling):
    """Finds nothing where start and goal are one."""

    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    def sample(self, problem, n, rng):
        found = TREES.sample(problem, n, rng)
        return found[:0] if problem.start == problem.goal else found


@component
class Symmetric(pl.Sampling):
    """Prefers the right hand side."""

    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    def sample(self, problem, n, rng):
        drawn = [TREES.sample(problem, 3, rng) for _ in range(n)]
        column = [np.where(rows < 0, 0, rows % problem.context.cols).sum(axis=1) for rows in drawn]
        kept = [problem.representation.decode(rows[c.argmax()]) for rows, c in zip(drawn, column, strict=True)]
        return problem.representation.encode(kept)


@component
class InPymoo(pl.Sampling):
    """Gives up where it is told of NSGA-II's objectives."""

    works: bool = True

    def serving(self, objectives):
        return InPymoo(works={"unsafe-cells", "turns"}.isdisjoint(objectives.labels))

    def sample(self, problem, n, rng):
        return TREES.sample(problem, n if self.works else 0, rng)


@component
class Padding(pl.Objective):
    """Counts padding."""

    def measure(self, population, problem):
        return np.full(len(population), float(population.shape[1]))


@component
class OwnValue(pl.Objective):
    """Compares with the longest."""

    def measure(self, population, problem):
        lengths = LENGTH.measure(population, problem)
        return lengths / lengths.max(initial=1.0)


@component
class LessIsFitter(pl.Fitness):
    """Makes fitness of what is to be minimised."""

    def combine(self, values, weights):
        return values @ weights


@component
class Connected(MapFamily):
    """Has a wall from left to right."""

    def draw(self, rng):
        return np.arange(self.size)[:, np.newaxis].repeat(self.size, axis=1) == self.size // 2

    def grid(self, corners="strict"):
        return pl.OccupancyGrid(self.draw(np.random.default_rng(0)))


@component
class Resumed(pl.Evolution):
    """Writes into the state that it steps on from."""

    sampling: pl.Sampling = TREES
    objectives: pl.Terms = pl.Terms({"length": LENGTH})

    def step(self, state):
        state.demes[0].fitness[0] *= 0.5
        return super().step(state)


@component
class InAPlanner(pl.Deadlock):
    """Closes every cell."""

    retreats: ClassVar[bool] = False

    def closed(self, table):
        return np.ones(len(table), np.uint8)


@component
class InOthersPlanners(Careless):
    """Needs what nobody gives."""

    needs: ClassVar[frozenset[str]] = frozenset({"wings"})


BROKEN = (
    Made, Described, Cited, ParametersRefused, ParametersTaken, Value, Pickled, Rebuilt, Answers, InputsKept, Silent,
    Repeatable, OwnGenerator, OtherProcess, Shape, FavoursTheFit, Ends, Free, SingleSteps, OthersKept, ParentKept,
    Smallest, Symmetric, InPymoo, Padding, OwnValue, LessIsFitter, Connected, Resumed, InAPlanner, InOthersPlanners,
)  # fmt: skip
