"""Median insertion, the way in which several papers make a path out of a few cells."""

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.kernel.counting import count
from pathloom.kernel.operators import Indices, Sampling
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.context import Cells
from pathloom.paths.problem import PathProblem


def sample_by_insertion(
    problem: PathProblem,
    n: int,
    rng: np.random.Generator,
    *,
    tries: int,
    insertions: int,
    reach: Literal[4, 8] = 8,
    guarded: bool = True,
    loops: bool = False,
) -> Population:
    """Draw n different paths start – random free cell – goal, with gaps closed by median insertion.

    Parameters
    ----------
    tries
        Failures in a row after which no other path is looked for. If at least
        one was found by then, those found are repeated to make up n; such
        repeats, and the failures, are counted.
    insertions
        Most insertions in one gap; 0 stands for 4 · (height + width).
    reach
        8 or 4 neighbours among which a midpoint in an obstacle gives way.
    guarded
        Never insert an end of the gap, and prefer neighbours that shrink it.
    loops
        Keep whatever lies between two visits of one cell.
    """
    it = problem.context
    sign_r, sign_c = it.signs
    if it.start == it.goal:
        return np.full((n, 1), it.start, np.int32)
    found, failed, again = compiled.insertion.sample_by_insertion(
        n, tries, it.start, it.goal, it.reachable_cells, it.blocked, it.moves, it.rows, it.cols, sign_r, sign_c,
        reach, insertions or 4 * (it.rows + it.cols), guarded, loops, rng.bit_generator.random_raw(4),
    )  # fmt: skip
    count("samples failed", failed)
    count("samples drawn again", again)
    return _repeated(found, n)


def sample_through(
    problem: PathProblem,
    libraries: Sequence[Cells],
    n: int,
    rng: np.random.Generator,
    *,
    tries: int,
    insertions: int,
    step: int = 0,
    redraws: int = 1,
    to_goal: bool = False,
    reach: Literal[4, 8] = 8,
    guarded: bool = True,
    loops: bool = False,
) -> Population:
    """Draw n paths start – a random cell of each library – goal, with gaps closed by median insertion.

    Parameters
    ----------
    libraries
        Free cells (flat ids) of which the path visits one each, in this order; empty ones are passed over.
    tries
        Failures in a row after which no other path is looked for. If at least
        one was found by then, those found are repeated to make up n; such
        repeats, and the failures, are counted.
    step
        Each cell lies less than so many rows and columns from the one before,
        else it is drawn again, up to ``redraws`` times; 0: no limit.
    to_goal
        The last cell must lie as near to the goal.
    insertions, reach, guarded, loops
        As for `sample_by_insertion`.
    """
    it = problem.context
    if it.start == it.goal:
        return np.full((n, 1), it.start, np.int32)
    cells, begin = _packed(libraries)
    found, failed = compiled.libraries.sample_from_libraries(
        n, tries, redraws, step, to_goal, it.start, it.goal, cells, begin, it.blocked, it.moves, it.rows, it.cols,
        *it.signs, reach, insertions or 4 * (it.rows + it.cols), guarded, loops, rng.bit_generator.random_raw(4),
    )  # fmt: skip
    count("samples failed", failed)
    return _repeated(found, n)


def sample_in_turn(
    problem: PathProblem,
    libraries: Sequence[Cells],
    n: int,
    rng: np.random.Generator,
    *,
    tries: int,
    redraws: int,
    insertions: int,
    reach: Literal[4, 8] = 8,
    guarded: bool = True,
    loops: bool = False,
) -> Population:
    """Draw n paths as `sample_through` does, but join each cell to the one before as soon as it is drawn.

    A cell that cannot be joined is drawn again, up to ``redraws`` draws in all,
    where `sample_through` begins the whole path again: a path through many
    libraries has a chance even where a join often fails. What is drawn again is
    counted.
    """
    it = problem.context
    if it.start == it.goal:
        return np.full((n, 1), it.start, np.int32)
    cells, begin = _packed(libraries)
    found, failed, again = compiled.libraries.sample_in_turn(
        n, tries, redraws, it.start, it.goal, cells, begin, it.blocked, it.moves, it.rows, it.cols, *it.signs,
        reach, insertions or 4 * (it.rows + it.cols), guarded, loops, rng.bit_generator.random_raw(4),
    )  # fmt: skip
    count("samples failed", failed)
    count("cells drawn again", again)
    return _repeated(found, n)


def _packed(libraries: Sequence[Cells]) -> tuple[Cells, NDArray[np.int64]]:
    """Return the cells of all libraries that are not empty, and where each begins and the last one ends."""
    filled = [np.asarray(cells, np.int32) for cells in libraries if len(cells)]
    return np.concatenate([*filled, np.empty(0, np.int32)]), np.cumsum([0, *map(len, filled)])


def _repeated(found: Population, n: int) -> Population:
    """Return n paths: those found, again and again, where there are fewer; none where there is none."""
    if 0 < len(found) < n:
        count("samples repeated", n - len(found))
        return np.ascontiguousarray(found[np.arange(n) % len(found)])
    return np.asarray(found)


def or_fallback(
    found: Population, n: int, fallback: Sampling | None, problem: Problem, rng: np.random.Generator
) -> Population:
    """Return the paths found, or, where there is not one, n of the fallback's, which are counted."""
    if len(found) or fallback is None:
        return found
    count("samples by fallback", n)
    return fallback.sample(problem, n, rng)


def mutate_neighbour(
    population: Population,
    chosen: Indices,
    problem: PathProblem,
    rng: np.random.Generator,
    *,
    insertions: int,
    reach: Literal[4, 8] = 8,
    guarded: bool = True,
    loops: bool = False,
) -> Population:
    """Move one interior cell of each chosen path to a free neighbour and join it up by median insertion.

    The parameters are those of `sample_by_insertion`, but −1 insertions stand
    for 4 · (height + width), and with 0 the new cell must fit as it is. A path
    that cannot be joined up stays, and is counted.
    """
    it = problem.context
    sign_r, sign_c = it.signs
    changed, failed = compiled.insertion.mutate_neighbour(
        population, chosen, it.blocked, it.moves, it.rows, it.cols, sign_r, sign_c, reach,
        insertions if insertions >= 0 else 4 * (it.rows + it.cols), guarded, loops, rng.bit_generator.random_raw(4),
    )  # fmt: skip
    count("mutation failed", failed)
    return changed  # type: ignore[no-any-return]


def mutate_between(
    population: Population,
    chosen: Indices,
    problem: PathProblem,
    rng: np.random.Generator,
    *,
    beyond: bool,
    tries: int,
    insertions: int,
    reach: Literal[4, 8] = 8,
    guarded: bool = True,
    loops: bool = False,
) -> Population:
    """Draw two cells of each chosen path and make what lies between them anew, by median insertion.

    Parameters
    ----------
    beyond
        Give up the two drawn cells as well: both are interior ones, and those
        next to them are joined. Otherwise the two stay, and at least one cell
        lies between them.
    tries
        How many pairs are drawn for a path until one can be joined. A path
        without one stays, as does one without an interior, and is counted.
    insertions, reach, guarded, loops
        As for `sample_by_insertion`.
    """
    it = problem.context
    changed, failed = compiled.rejoining.mutate_between(
        population, chosen, 2 if beyond else 1, tries, it.blocked, it.moves, it.rows, it.cols, *it.signs,
        reach, insertions or 4 * (it.rows + it.cols), guarded, loops, rng.bit_generator.random_raw(4),
    )  # fmt: skip
    count("mutation failed", failed)
    return changed  # type: ignore[no-any-return]
