"""The independent validator of curves: every curve that is reported has passed it.

It shares no code with what makes curves: chord by chord and obstacle by obstacle,
by separating axes in numpy's floating point, with one allowance for rounding.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.paths.problem import PathProblem

ALLOWANCE = 1e-9
"""Cells: how deep a chord may enter an obstacle, or leave the map, and how far it may miss start and goal."""
ROUNDING = 1e-11
"""Cells: how far from an obstacle a chord still touches it."""


def validate_curve(points: ArrayLike, problem: PathProblem) -> str | None:
    """Return why a curve is not valid, or ``None`` if it is.

    Valid is a polyline (m, 2) of rows and columns, on the map, that leads from
    start to goal and obeys the problem's corner policy.
    """
    curve = np.asarray(points)
    if curve.ndim != 2 or curve.shape[0] == 0 or curve.shape[1] != 2 or curve.dtype.kind != "f":
        return f"is a float array of shape (m, 2); got {curve.dtype} {curve.shape}"
    if not np.isfinite(curve).all():
        return "has points that are no numbers"
    if np.abs(curve[[0, -1]] - np.array(problem.ends)).max() > ALLOWANCE:
        return f"leads from {_shown(curve[0])} to {_shown(curve[-1])}, not from start to goal"
    occupied = problem.context.occupied
    beyond = (curve < -0.5 - ALLOWANCE) | (curve > np.array(occupied.shape) - 0.5 + ALLOWANCE)
    if beyond.any():
        return f"leaves the map at {_shown(curve[beyond.any(axis=1)][0])}"
    a, b = _stretches(curve)
    touching = problem.corners == "strict"
    met = _meet(a, b, occupied, 0.5 + ROUNDING if touching else 0.5 - ALLOWANCE)
    if met is not None:
        return f"{'touches' if touching else 'crosses'} an obstacle near {_shown(met)}"
    if problem.corners == "no-squeeze":  # corner (i, j) is the lower right one of cell (i, j): half a cell away
        met = _meet(a - 0.5, b - 0.5, _squeezes(occupied), ROUNDING)
        if met is not None:
            return f"squeezes between two obstacles near {_shown(met + 0.5)}"
    return None


def _stretches(curve: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return the chords of a curve (m, 2) as stretches from a to b, both (n, 2), of a cell at most."""
    if len(curve) == 1:
        return curve, curve
    chords = np.diff(curve, axis=0)
    parts = np.maximum(np.ceil(np.hypot(*chords.T)), 1).astype(int)
    of = np.repeat(np.arange(len(chords)), parts)
    count = (np.arange(len(of)) - np.repeat(np.cumsum(parts) - parts, parts))[:, np.newaxis]
    step = (chords / parts[:, np.newaxis])[of]
    return curve[of] + count * step, curve[of] + (count + 1) * step


def _squeezes(occupied: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return for each corner within the map whether two obstacles share only that."""
    falling = occupied[:-1, :-1] & occupied[1:, 1:]
    rising = occupied[:-1, 1:] & occupied[1:, :-1]
    return np.asarray(falling | rising)


def _meet(a: NDArray[Any], b: NDArray[Any], marked: NDArray[np.bool_], half: float) -> NDArray[Any] | None:
    """Return the middle of a stretch that meets one of the open squares of that half side about marked places."""
    middle, d = 0.5 * (a + b), b - a
    near = np.floor(middle + 0.5).astype(int)
    for dr, dc in np.ndindex(3, 3):  # a stretch of one cell reaches no farther from its middle
        place = near + np.array([dr - 1, dc - 1])
        there = ((place >= 0) & (place < marked.shape)).all(axis=1)
        there[there] = marked[tuple(place[there].T)]
        away = place - middle
        beside = (np.abs(away) < half + 0.5 * np.abs(d)).all(axis=1)
        across = np.abs(d[:, 0] * away[:, 1] - d[:, 1] * away[:, 0])
        met = there & beside & ((across < half * np.abs(d).sum(axis=1)) | (d == 0.0).all(axis=1))
        if met.any():
            return np.asarray(middle[met][0])
    return None


def _shown(point: NDArray[Any]) -> str:
    return f"{point[0]:.4f},{point[1]:.4f}"
