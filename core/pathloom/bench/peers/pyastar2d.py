"""pyastar2d: A* in C++ on an array of weights."""

from typing import Any, ClassVar

import numpy as np

from pathloom.bench.peer import Answer, Peer, Solve
from pathloom.paths.problem import PathProblem


class Pyastar2d(Peer):
    """A*; the weight of the cell that is entered is the whole price of a step, a diagonal one's too."""

    name = "pyastar2d"
    distribution: ClassVar[str] = "pyastar2d"
    about = "diagonal steps under allow, at the price of straight ones; it knows no corners: else 4 neighbours"
    draws: ClassVar[bool] = False

    def prepare(self, problem: PathProblem) -> Solve:
        import pyastar2d

        weights = np.where(problem.context.occupied, np.inf, 1.0).astype(np.float32)
        diagonal = problem.corners == "allow"

        def solve(*_: Any) -> Answer:
            found = pyastar2d.astar_path(weights, *problem.ends, allow_diagonal=diagonal)
            return None if found is None else np.asarray(found, np.int64)

        return solve
