"""Section 3: the linear trial."""

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from pathloom import Collision, ConfigError, PathProblem, Unit, compiled, count
from pathloom.paths.cell_paths import flat_ids
from pathloom.paths.collision import Exact
from pathloom.paths.context import Context

Tests = tuple[int, int, float, int]
"""How the kernels test a segment: corner policy, sum of tests, step, samples a cell."""


@dataclass(frozen=True, kw_only=True)
class LinearTrial(Collision):
    """Sample the segment along its longer axis, round each sample to a cell, and look whether that is an obstacle.

    The trial misses some corners that a segment cuts, refuses some that it only
    touches, and in floating point its verdict depends on where on the map the
    segment lies: sums of 0.1 fall now on this, now on that side of a half.
    Axes point from start to goal, as on the paper's maps.
    """

    source: ClassVar[str] = "Hao et al. 2021, section 3, eqs. (3)-(6)"

    arithmetic: Literal["floating", "exact"] = "floating"
    """``floating``: each sample is the last one plus ``step``, as printed; ``exact``: the same rule in integers."""
    step: Annotated[float, msgspec.Meta(ge=0.001, le=0.25), Unit("cells")] = 0.1
    """Distance of samples along the longer axis, in cells; ``exact`` takes 1 / step to be an integer."""
    verified: bool = True
    """What passes must also pass the exact test under the problem's corner policy, of which the trial knows nothing."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.arithmetic == "exact" and abs(1.0 / self.step - round(1.0 / self.step)) > 1e-9:
            raise ConfigError(f"{self.name}: exact arithmetic takes 1 / step to be an integer; got step {self.step!r}")

    def segments_free(self, a: NDArray[Any], b: NDArray[Any], problem: PathProblem) -> NDArray[np.bool_]:
        it = problem.context
        first, second = flat_ids(a, it.cols), flat_ids(b, it.cols)
        free, refused = compiled.trial.segments_free(first, second, it.blocked, it.rows, it.cols, *self._tests(it))
        count_refused(refused)
        return np.asarray(free)

    def _tests(self, it: Context) -> Tests:
        on, (down, right) = compiled.trial, it.signs
        tests = on.TRIAL + on.EXACT * self.verified
        tests += on.MIRRORED_ROWS * (down > 0) + on.MIRRORED_COLS * (right < 0)
        parts = round(1.0 / self.step) if self.arithmetic == "exact" else 0
        return it.policy, tests, self.step, parts


def tests_of(collision: Collision | None, it: Context) -> Tests | None:
    """Return how the kernels do this collision test themselves; ``None``: only its own Python can."""
    if collision is None:
        return it.policy, 0, 0.0, 0
    if type(collision) is LinearTrial:  # a class that inherits from it may test otherwise
        return collision._tests(it)
    if type(collision) is Exact:
        return it.policy, compiled.trial.EXACT, 0.0, 0
    return None


def count_refused(times: int) -> None:
    """Count segments that the linear trial took for free and the exact test did not."""
    count("segments refused by the exact test", times)
