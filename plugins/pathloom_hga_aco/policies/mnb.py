"""Multinomial naive Bayes."""

from dataclasses import dataclass
from typing import Any, ClassVar

from pathloom import LearnedPolicy, NonNegative


@dataclass(frozen=True, kw_only=True)
class Mnb(LearnedPolicy):
    """Multinomial naive Bayes: distances as if they were counts.

    Eq. (1) with P(x | c) that of words in a text, which distances are not; it is the weakest of the five.
    """

    source: ClassVar[str] = "Song et al. 2021, section 3.1, eq. (1)"

    alpha: NonNegative = 1.0
    """Added to every count; the paper gives none, 1 is Laplace's."""

    def estimator(self, seed: int) -> Any:
        from sklearn.naive_bayes import MultinomialNB

        return MultinomialNB(alpha=self.alpha)
