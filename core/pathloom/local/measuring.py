"""How well actions are predicted: Song et al. (2021), section 3.3, for four actions instead of two.

The paper's formulas (7)-(11) are those of a yes and a no. Here accuracy is the share of right predictions, precision,
recall and F1 are means over the actions, each against the rest (macro), and MCC is the coefficient for several classes.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from typing import Any

import numpy as np

from pathloom.local.actions import Action
from pathloom.local.examples import Actions


@dataclass(frozen=True)
class Measures:
    """Measures of predictions, each at most 1."""

    accuracy: float
    """Eq. (7)."""
    precision: float
    """Eq. (8), macro; an action that is never predicted counts 0."""
    recall: float
    """Eq. (9), macro."""
    f1: float
    """Eq. (10), macro."""
    mcc: float
    """Eq. (11) for several classes: J. Gorodkin (2004), Comput. Biol. Chem. 28, 367. From −1 on; 0 by chance."""
    confusion: tuple[tuple[int, ...], ...]
    """Real actions by row, predicted ones by column, in the order of `Action`."""

    @classmethod
    def of(cls, real: Actions, predicted: Actions) -> "Measures":
        """Measure predictions (n,) of actions (n,)."""
        from sklearn import metrics

        precision, recall, f1, _ = metrics.precision_recall_fscore_support(
            real, predicted, average="macro", zero_division=0
        )
        return cls(
            accuracy=float(metrics.accuracy_score(real, predicted)),
            precision=float(precision),
            recall=float(recall),
            f1=float(f1),
            mcc=float(metrics.matthews_corrcoef(real, predicted)) if len(real) > 1 else 0.0,
            confusion=_table(metrics.confusion_matrix(real, predicted, labels=list(Action))),
        )

    @classmethod
    def mean(cls, several: Sequence["Measures"]) -> "Measures":
        """Return the means of measures, and the sum of their confusions."""
        names = [field.name for field in fields(cls) if field.name != "confusion"]
        means = {name: float(np.mean([getattr(one, name) for one in several])) for name in names}
        return cls(**means, confusion=_table(np.sum([one.confusion for one in several], axis=0)))

    def to_dict(self) -> dict[str, Any]:
        """Return the measures as they stand in a document."""
        return {**asdict(self), "confusion": [list(row) for row in self.confusion]}


def _table(counts: Any) -> tuple[tuple[int, ...], ...]:
    return tuple(tuple(int(value) for value in row) for row in counts)
