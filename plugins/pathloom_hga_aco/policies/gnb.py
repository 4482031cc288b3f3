"""Gaussian naive Bayes."""

from dataclasses import dataclass
from typing import Any, ClassVar

from pathloom import LearnedPolicy


@dataclass(frozen=True, kw_only=True)
class Gnb(LearnedPolicy):
    """Gaussian naive Bayes: each distance normally distributed within an action, independently of the others."""

    source: ClassVar[str] = "Song et al. 2021, section 3.1, eq. (1)"

    def estimator(self, seed: int) -> Any:
        from sklearn.naive_bayes import GaussianNB

        return GaussianNB()
