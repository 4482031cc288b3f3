"""Quality of a front, alone and against the exact one. All objectives are minimised.

Everything is measured in the objectives' own units; the ratio of hypervolumes
alone does not depend on them.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.errors import ConfigError
from pathloom.kernel.evaluation import Floats

MARGIN = 0.1
"""How far the reference point lies beyond the nadir, as a share of the front's range."""
SAME = 1e-9
"""Values this close are the same: sums of the same terms in another order differ in their last digits."""


def non_dominated(values: Floats) -> Floats:
    """Return the distinct rows of (n, m) that no other one dominates, in lexicographic order."""
    if len(values) == 0:
        return values
    from moocore import is_nondominated

    kept = values[is_nondominated(values, keep_weakly=False)]
    return np.asarray(kept[np.lexsort(kept.T[::-1])])


def reference_point(values: Floats) -> Floats:
    """Return a point (m,) that all values (n, m) are better than in every objective.

    It lies a tenth of the front's range beyond the nadir (the worst of each
    objective on the front), so that extreme points count as well; 1 beyond it
    where an objective does not vary.
    """
    ideal, nadir = values.min(axis=0), values.max(axis=0)
    span = nadir - ideal
    return np.asarray(nadir + np.where(span > SAME, MARGIN * span, 1.0))


def hypervolume(values: ArrayLike, reference: ArrayLike) -> float:
    """Return the volume that values (n, m) dominate, up to the reference point (m,).

    Source: Zitzler and Thiele 1998; computed by moocore.
    """
    import moocore

    points, corner = np.asarray(values, np.float64), np.asarray(reference, np.float64)
    return float(moocore.hypervolume(points, ref=corner)) if len(points) else 0.0


def hypervolume_ratio(values: ArrayLike, exact: ArrayLike, reference: ArrayLike | None = None) -> float | None:
    """Return the hypervolume as a share of the exact front's; ``None`` where that is 0.

    The reference point is by default that of the exact front.
    """
    front = np.asarray(exact, np.float64)
    corner = reference_point(front) if reference is None else reference
    whole = hypervolume(front, corner)
    return hypervolume(values, corner) / whole if whole > 0 else None


def igd_plus(values: ArrayLike, exact: ArrayLike) -> float:
    """Return how far a point of the exact front (k, m) is, on average, from being dominated by the values (n, m).

    Source: Ishibuchi et al. 2015, IGD+; computed by moocore.
    """
    import moocore

    return float(moocore.igd_plus(np.asarray(values, np.float64), ref=np.asarray(exact, np.float64)))


def additive_epsilon(values: ArrayLike, exact: ArrayLike) -> float:
    """Return by how much the values (n, m) must improve in every objective to dominate all of the exact front (k, m).

    Source: Zitzler et al. 2003, additive ε; computed by moocore.
    """
    import moocore

    return float(moocore.epsilon_additive(np.asarray(values, np.float64), ref=np.asarray(exact, np.float64)))


def attainment(fronts: Sequence[ArrayLike], percent: float = 50.0) -> Floats:
    """Return the points (k, m) that as many of several runs reached: an empirical attainment surface.

    Parameters
    ----------
    fronts
        One front (n, m) for each run or seed, of 2 or 3 objectives.
    percent
        How many of the runs, in (0, 100]; 50 gives the median surface, 100 what
        every run reached.

    Raises
    ------
    ConfigError
        If there is no front, or one of more than 3 objectives.

    Notes
    -----
    Source: Fonseca, Guerreiro, López-Ibáñez and Paquete 2011; computed by moocore.
    """
    import moocore

    sets = [np.asarray(front, np.float64) for front in fronts]
    if not sets or not 0 < percent <= 100:
        raise ConfigError(f"attainment: found {len(sets)} fronts and {percent} %, allowed at least 1 and (0, 100]")
    if sets[0].shape[1] not in (2, 3):
        raise ConfigError(f"attainment: found {sets[0].shape[1]} objectives, allowed 2 or 3")
    if any(len(front) == 0 for front in sets):  # moocore counts the sets that have points
        raise ConfigError("attainment: found an empty front, allowed fronts of at least one point")
    which = np.repeat(np.arange(len(sets)), [len(front) for front in sets])
    surface = moocore.eaf(np.concatenate(sets), which, percentiles=[percent])
    return np.asarray(surface[np.lexsort(surface[:, -2::-1].T), :-1])


def _among(points: Floats, values: Floats) -> NDArray[np.bool_]:
    """Return which points (k, m) are among the values (n, m)."""
    same = np.all(np.abs(points[:, np.newaxis] - values) <= SAME, axis=2)
    return np.asarray(np.any(same, axis=1))


def indicators(values: Floats, exact: Floats | None = None, reference: ArrayLike | None = None) -> dict[str, Any]:
    """Return what a result says of its front (n, m), n ≥ 1, and how it stands against the exact one (k, m).

    ``reference_point`` is the given one, else that of the exact front where it is
    known, else that of the front itself; ``reference_of`` says which.
    """
    of, whose = ("exact", exact) if exact is not None and len(exact) else ("front", values)
    corner = reference_point(whose) if reference is None else np.asarray(reference, np.float64)
    found: dict[str, Any] = {
        "hypervolume": hypervolume(values, corner),
        "reference_point": corner.tolist(),
        "reference_of": of if reference is None else "given",
        "ideal": values.min(axis=0).tolist(),
        "nadir": values.max(axis=0).tolist(),
        "size": len(values),
    }
    if exact is not None and len(exact):
        found |= {
            "exact_hypervolume": hypervolume(exact, corner),
            "hypervolume_ratio": hypervolume_ratio(values, exact, corner),
            "igd_plus": igd_plus(values, exact),
            "additive_epsilon": additive_epsilon(values, exact),
            "exact_size": len(exact),
            "exact_found": int(_among(exact, values).sum()),
        }
    return found
