"""The shortest 8-connected path."""

import numpy as np

from pathloom import compiled
from pathloom.paths.cell_paths import Path
from pathloom.paths.problem import PathProblem


def octile_path(problem: PathProblem) -> tuple[float, Path | None]:
    """Return the octile optimum, in cells, and a path (k, 2) of that length.

    Steps cost 1 and √2 and obey the problem's corner policy; under ``strict``
    this is the optimum that Moving AI scenarios state. Without any path: inf
    and ``None``.
    """
    it = problem.context
    cells = compiled.search.octile_path(it.moves, it.cols, it.start, it.goal)
    if len(cells) == 0:
        return float("inf"), None
    length = float(compiled.measures.lengths(cells[np.newaxis], it.cols)[0])
    return length, problem.representation.decode(cells)
