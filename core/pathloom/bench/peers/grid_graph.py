"""The grid as a graph, for peers that search one."""

from itertools import pairwise

import numpy as np

from pathloom.paths.context import STEPS
from pathloom.paths.problem import Cell, PathProblem


def steps(problem: PathProblem) -> dict[Cell, list[Cell]]:
    """Return for each free cell those to which a legal step leads."""
    moves = problem.context.moves.reshape(problem.context.occupied.shape)
    return {
        (r, c): [(r + dr, c + dc) for d, (dr, dc) in enumerate(STEPS) if moves[r, c] >> d & 1]
        for r, c in np.argwhere(~problem.context.occupied).tolist()
    }


def octile(a: Cell, b: Cell) -> float:
    """Return the length of the way from a to b over 8 neighbours, obstacles not counted."""
    far, near = sorted((abs(a[0] - b[0]), abs(a[1] - b[1])), reverse=True)
    return float(far + (2**0.5 - 1) * near)


def length(path: list[Cell]) -> float:
    """Return the length of a path of single steps."""
    return sum(octile(a, b) for a, b in pairwise(path))
