"""Random forest."""

from dataclasses import dataclass
from typing import Any, ClassVar

from pathloom import Count, LearnedPolicy


@dataclass(frozen=True, kw_only=True)
class Rf(LearnedPolicy):
    """Random forest: the action that most trees are for.

    scikit-learn adds up the shares of the examples in the trees' leaves. Its trees grow until a leaf holds
    one action only, so that this is the mode of eq. (6).
    """

    source: ClassVar[str] = "Song et al. 2021, section 3.1, eq. (6)"

    trees: Count = 100
    """n of eq. (6); the paper gives none."""

    def estimator(self, seed: int) -> Any:
        from sklearn.ensemble import RandomForestClassifier

        return RandomForestClassifier(self.trees, random_state=seed)
