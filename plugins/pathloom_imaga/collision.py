"""Section 2.6: the test of a segment by midpoints of midpoints."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import Collision, PathProblem, compiled
from pathloom.paths.cell_paths import flat_ids


@dataclass(frozen=True, kw_only=True)
class RecursiveMidpoint(Collision):
    """Look at the cell in the middle, then in the middle of both halves, until neighbours are reached; eqs. (24), (25).

    Not exact: it overlooks obstacles that the segment cuts, and sees some that it
    does not meet. It knows nothing of corners.

    Midpoints are rounded, halves up as ⌊x + ½⌋ on axes that point from start to
    goal: for a start at the bottom left that is MATLAB's ``round``.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.6, eqs. (24) and (25)"

    def segments_free(self, a: NDArray[Any], b: NDArray[Any], problem: PathProblem) -> NDArray[np.bool_]:
        it = problem.context
        first, second = flat_ids(a, it.cols), flat_ids(b, it.cols)
        return np.asarray(compiled.midpoints.segments_free(it.blocked, it.cols, first, second, *it.signs))
