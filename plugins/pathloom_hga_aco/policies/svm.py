"""Support vector machine."""

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from pathloom import LearnedPolicy, Positive


@dataclass(frozen=True, kw_only=True)
class Svm(LearnedPolicy):
    """Support vector machine, one action against another, and a vote.

    In eq. (2) the second margin has to be at most −1, in eq. (3) the norm is to be squared. The
    kernel is not given: ``linear`` gives the figures of the hold-out, ``rbf`` those of the ten folds.
    """

    source: ClassVar[str] = "Song et al. 2021, section 3.1, eqs. (2) and (3)"

    kernel: Literal["linear", "rbf"] = "linear"
    """Whether classes are parted by planes, or by radial basis functions."""
    penalty: Positive = 1.0
    """C of eq. (3); the paper gives none."""

    def estimator(self, seed: int) -> Any:
        from sklearn.svm import SVC

        return SVC(kernel=self.kernel, C=self.penalty)
