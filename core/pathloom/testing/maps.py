"""Maps: what a map's name stands for is one map, and its corners are connected where a family says so."""

from pathloom.errors import PathloomError
from pathloom.paths.maps import MapFamily
from pathloom.paths.problem import PathProblem
from pathloom.testing.check import Inapplicable, expect, promise
from pathloom.testing.problems import POLICIES


@promise("connected", MapFamily)
def connected(component: MapFamily) -> None:
    """Of a family, every map is connected from corner to corner under the corner policy asked for."""
    for corners in POLICIES:
        for seed in range(5):
            try:
                grid = type(component)(size=17, seed=seed).grid(corners)
            except PathloomError as error:
                raise Inapplicable(f"it has no map of 17 × 17 cells: {error}") from error
            reachable = PathProblem(grid, corners=corners).reachable
            expect(reachable, f"expected a way from corner to corner of seed {seed} under {corners!r}; found none")


CHECKS = (connected,)
