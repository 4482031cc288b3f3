"""A forest's trees as flat arrays, so that one decision takes microseconds; scikit-learn's own takes milliseconds."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.errors import ConfigError
from pathloom.kernel.evaluation import Floats
from pathloom.local.examples import Actions


@dataclass(frozen=True, eq=False)
class Forest:
    """All nodes of all trees, one after the other. It decides as the classifier that it comes from."""

    classes: Actions
    """(c,) the actions that occurred in training."""
    roots: NDArray[np.int64]
    """(t,) where each tree begins."""
    feature: NDArray[np.int32]
    """(n,) −1 in a leaf."""
    threshold: Floats
    left: NDArray[np.int32]
    right: NDArray[np.int32]
    shares: Floats
    """(n, c) how the examples in a node are divided among the classes."""

    @classmethod
    def of(cls, classifier: Any) -> "Forest | None":
        """Return the forest within a classifier, or ``None`` where there is none.

        Raises
        ------
        ConfigError
            If the trees are not well formed, as those of a file from elsewhere may be.
        """
        from sklearn.ensemble import ExtraTreesClassifier, RandomForestClassifier
        from sklearn.tree import DecisionTreeClassifier

        if type(classifier) in (RandomForestClassifier, ExtraTreesClassifier):
            trees = [tree.tree_ for tree in classifier.estimators_]
        elif isinstance(classifier, DecisionTreeClassifier):
            trees = [classifier.tree_]
        else:
            return None
        sizes = [int(tree.node_count) for tree in trees]
        roots = np.cumsum([0, *sizes[:-1]]).astype(np.int64)
        children = {
            side: np.concatenate(
                [getattr(tree, f"children_{side}") + root for tree, root in zip(trees, roots, strict=True)]
            )
            for side in ("left", "right")
        }
        inner = np.concatenate([tree.children_left != -1 for tree in trees])
        feature = np.where(inner, np.concatenate([tree.feature for tree in trees]), -1)
        shares = np.concatenate([tree.value[:, 0, :] for tree in trees])
        _check(inner, feature, children, np.repeat(np.cumsum(sizes), sizes), int(classifier.n_features_in_))
        if shares.shape[1] != len(classifier.classes_):
            raise ConfigError("model: found trees of other classes than the model's")
        return cls(
            np.asarray(classifier.classes_, np.int64),
            roots,
            feature.astype(np.int32),
            np.concatenate([tree.threshold for tree in trees]).astype(np.float64),
            children["left"].astype(np.int32),
            children["right"].astype(np.int32),
            np.ascontiguousarray(shares, np.float64),
        )

    def decide(self, distances: Floats) -> Actions:
        """Return the actions (n,) for distances (n, k), compared in single precision as scikit-learn does."""
        rows = np.ascontiguousarray(distances, np.float32)
        it = self
        chosen = compiled.forests.vote(it.roots, it.feature, it.threshold, it.left, it.right, it.shares, rows)
        return np.asarray(it.classes[chosen])


def _check(
    inner: NDArray[np.bool_],
    feature: NDArray[Any],
    children: dict[str, NDArray[Any]],
    ends: NDArray[np.int64],
    features: int,
) -> None:
    """Refuse trees in which a walk could leave its tree, go round for ever, or ask for a distance that there is not."""
    places = np.arange(len(inner))
    whole = (feature[inner] >= 0) & (feature[inner] < features)
    for side in children.values():
        whole &= (side[inner] > places[inner]) & (side[inner] < ends[inner])
    if not whole.all():
        raise ConfigError("model: found trees that are not well formed")
