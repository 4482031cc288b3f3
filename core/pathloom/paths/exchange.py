"""Exchange of tails between two paths: at a cell that they have in common, or at a position."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Share
from pathloom.kernel.counting import count
from pathloom.kernel.operators import Crossover, Indices
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem


def exchange_tails(
    population: Population,
    pairs: Indices,
    problem: PathProblem,
    rng: np.random.Generator,
    *,
    loops: bool = False,
) -> Population:
    """Let each pair (k, 2) exchange what follows a random cell that both visit between start and goal.

    ``loops``: keep whatever a child then has between two visits of one cell.
    Pairs without a common cell stay as they are, and are counted.
    """
    it = problem.context
    children, failed = compiled.exchange.exchange_tails(
        population, np.ascontiguousarray(pairs), it.blocked.size, loops, rng.bit_generator.random_raw(4)
    )
    count("crossover without a common cell", failed)
    return children  # type: ignore[no-any-return]


def exchange_at_position(
    population: Population,
    pairs: Indices,
    problem: PathProblem,
    rng: np.random.Generator,
    *,
    insertions: int,
    reach: Literal[4, 8] = 8,
    guarded: bool = True,
    loops: bool = False,
) -> Population:
    """Let each pair (k, 2) exchange what follows a random position, the same in both and inside the shorter one.

    The two parts of a child are joined by median insertion; ``insertions``,
    ``reach``, ``guarded`` and ``loops`` are those of `insertion.mutate_neighbour`.
    Where they cannot be joined the parent stays, and is counted.
    """
    it = problem.context
    children, failed = compiled.joining.exchange_at_position(
        population, np.ascontiguousarray(pairs), it.blocked, it.moves, it.rows, it.cols, *it.signs, reach,
        insertions if insertions >= 0 else 4 * (it.rows + it.cols), guarded, loops, rng.bit_generator.random_raw(4),
    )  # fmt: skip
    count("crossover failed", failed)
    return children  # type: ignore[no-any-return]


@dataclass(frozen=True, kw_only=True)
class SharedNode(Crossover):
    """Exchange the tails behind a random node that both parents visit; without one, keep the parents."""

    source: ClassVar[str] = "Ahn and Ramakrishna 2002, section III-D"
    works_on: ClassVar[str] = "cells"

    rate: Share = 0.9

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return exchange_tails(population, pairs, path_problem(problem), rng)
