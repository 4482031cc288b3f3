"""scikit-image: `route_through_array`."""

from typing import Any, ClassVar

import numpy as np

from pathloom.bench.peer import Answer, Peer, Solve
from pathloom.paths.problem import PathProblem


class RouteThroughArray(Peer):
    """The cheapest route through an array of costs; negative ones are no way."""

    name = "scikit-image route_through_array"
    distribution: ClassVar[str] = "scikit-image"
    about = "fully connected and geometric under allow; it knows no corners: else 4 neighbours"
    draws: ClassVar[bool] = False

    def prepare(self, problem: PathProblem) -> Solve:
        from skimage.graph import route_through_array

        costs = np.where(problem.context.occupied, -1.0, 1.0)
        diagonal = problem.corners == "allow"

        def solve(*_: Any) -> Answer:
            try:
                route, _ = route_through_array(costs, *problem.ends, fully_connected=diagonal, geometric=True)
            except ValueError as error:
                if "no minimum-cost path" not in str(error).lower():
                    raise
                return None
            return np.array(route)

        return solve
