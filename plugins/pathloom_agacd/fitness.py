"""Section 4.4: what becomes of a path without turns, whose reciprocal of smoothness is infinite."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Fitness, Floats, NonNegative


@dataclass(frozen=True, kw_only=True)
class ShiftedReciprocals(Fitness):
    """F = sum of w_k / (t_k + shift_k): eqs. (7) and (8) with 1 / (1 + smoothness) for 1 / smoothness."""

    source: ClassVar[str] = "Hao et al. 2021, section 4.4, eqs. (7) and (8)"

    shifts: tuple[NonNegative, ...] = (0.0, 1.0, 0.0)
    """One for each objective, in order; 0 for those that follow."""

    def combine(self, values: Floats, weights: Floats) -> Floats:
        shifts = np.zeros(values.shape[1])
        shifts[: len(self.shifts)] = self.shifts[: len(shifts)]
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray((weights / (values + shifts)).sum(axis=1, where=weights > 0.0))  # 0 / 0 counts as nothing
