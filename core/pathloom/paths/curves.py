"""Curves: smooth ways along a path, which keep the path's corner policy."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom import compiled
from pathloom.kernel.component import Component, Unit
from pathloom.kernel.planner import Planner
from pathloom.kernel.state import State
from pathloom.paths.problem import PathProblem

Points = NDArray[np.float64]
"""(k, 2), rows and columns of points; whole numbers are the centres of cells."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve from start to goal, in cells."""

    points: Points
    """(m, 2), rows and columns of points on it, as close together as it bends. The chords between them are free too."""
    length: float
    """Length of the curve itself, not of the chords."""
    min_clearance: float | None
    """Least distance to an obstacle cell's border; ``None`` on a map without obstacles."""
    max_curvature: float
    """Greatest curvature, one over the radius in cells; inf where the curve has a corner."""
    fallback: bool
    """Whether it had to keep to the straight segments somewhere, corners included."""
    inserted: int = 0
    """Points put in on the segments to pull it towards them."""


@dataclass(frozen=True, kw_only=True)
class Smoother(Component, ABC):
    """Make a curve of a path."""

    kind: ClassVar[str] = "smoother"

    @abstractmethod
    def smooth(self, path: ArrayLike, problem: PathProblem) -> Curve:
        """Return a curve along a path (k, 2), whose segments are known to be free under the problem's corner policy.

        The path's points are rows and columns, not only of centres of cells.
        """


@dataclass(frozen=True)
class Chain:
    """Bézier pieces of one degree, (m, degree + 1, 2), and which control points each of them depends on."""

    pieces: NDArray[np.float64]
    first: NDArray[np.intp]
    """(m,), index of the first control point."""
    last: NDArray[np.intp]
    """(m,), index of the last one. Where first and last are on one segment of the path, the piece is as well."""


@dataclass(frozen=True, kw_only=True)
class PiecewiseBezier(Smoother):
    """A smoother whose curves are chains of Bézier pieces, and bend to how its control points lie.

    The control points are the path's points. Where a piece collides, the control
    points that it depends on get another one halfway between any two of them, on
    the path's segment, so that the curve keeps closer to the path; again and again
    until nothing collides. Where that does not help, the curve follows the segments.

    A piece within a segment of the path is as free as that is. Any other is proven
    free by its control points' hull, cut in two as often as it takes; with 1e-9
    cells, what is nearer than that counts as touching (``strict``), what is no
    deeper as not entering (``allow``).
    """

    tolerance: Annotated[float, msgspec.Meta(ge=1e-6), Unit("cells")] = 1e-3
    """How far chords between the points given may depart from the curve, in cells."""
    halvings: Annotated[int, msgspec.Meta(ge=0, le=30)] = 12
    """How often the distance between control points is halved where the curve collides."""

    @abstractmethod
    def chain(self, control: Points, sharp: NDArray[np.bool_]) -> Chain:
        """Return the curve of control points (n, 2), n ≥ 2; at the sharp ones (n,) it has a corner."""

    def smooth(self, path: ArrayLike, problem: PathProblem) -> Curve:
        corners = _distinct(np.asarray(path, np.float64))
        if len(corners) == 1:
            return _measured(corners, 0.0, 0.0, False, 0, problem)
        at = np.arange(len(corners), dtype=np.float64)  # where along the path each control point stands
        sharp = np.zeros(len(at), np.bool_)
        halvings = 0
        while True:
            chain = self.chain(_points_at(at, corners), sharp)
            straight = at[chain.last] <= np.floor(at[chain.first]) + 1.0
            free, points, length, curvature = _sampled(chain.pieces, straight, problem, self.tolerance)
            if free.all():
                return _measured(points, length, curvature, bool(sharp.any()), len(at) - len(corners), problem)
            near = _from_to(chain.first[~free], chain.last[~free], len(at))
            if halvings < self.halvings:
                halvings += 1
                left = np.flatnonzero(near[:-1] & near[1:])
                at = np.insert(at, left + 1, 0.5 * (at[left] + at[left + 1]))
                sharp = np.zeros(len(at), np.bool_)
            else:
                sharp |= near


@dataclass(frozen=True, kw_only=True)
class BSpline(PiecewiseBezier):
    """A B-spline with clamped uniform knots: it begins and ends with the path and rounds the points between.

    With fewer control points than the degree asks for, the degree is lowered.
    """

    name: ClassVar[str] = "b-spline"
    source: ClassVar[str] = "de Boor 1978; Song et al. 2021, section 4.2, eqs. (12) to (15)"

    degree: Annotated[int, msgspec.Meta(ge=1, le=30)] = 3
    """Of the polynomials; k in eqs. (12) to (15)."""

    def chain(self, control: Points, sharp: NDArray[np.bool_]) -> Chain:
        # Eq. (15) repeats the ends degree + 1 times: n + degree + 2 clamped knots in all; eq. (13) with ≤ on both
        # sides would count interior knots twice: half-open intervals, of which the last is closed.
        most = min(self.degree, len(control) - 1)
        owner = np.repeat(np.arange(len(control)), np.where(sharp, most, 1))  # as often as the degree: a corner
        pieces = compiled.curves.spline_pieces(control[owner], most)
        first, last = owner[: len(owner) - most], owner[most:]
        moving = first != last  # where one point fills a piece, the curve stands still
        return Chain(np.ascontiguousarray(pieces[moving]), first[moving], last[moving])


@dataclass(frozen=True, kw_only=True)
class CubicBezier(PiecewiseBezier):
    """A chain of cubic Bézier pieces through the path's points, joined with one tangent and one speed (C1).

    The tangent at a point is that of the parabola through it and its neighbours
    (Bessel's), with the lengths of the segments as parameter.
    """

    name: ClassVar[str] = "cubic-bezier"
    source: ClassVar[str] = "Farin 2002, Curves and Surfaces for CAGD, section 9.8"

    reach: Annotated[float, msgspec.Meta(gt=0.0, le=1.5)] = 1.0
    """Length of the handles, in thirds of a segment; the shorter, the tighter the bends."""

    def chain(self, control: Points, sharp: NDArray[np.bool_]) -> Chain:
        index = np.arange(len(control))
        corner = sharp | (index == 0) | (index == len(control) - 1)
        step = np.diff(control, axis=0)
        long = np.hypot(*step.T)[:, np.newaxis]
        along = step / long
        before, after = long[:-1], long[1:]
        smooth = np.zeros_like(control)
        smooth[1:-1] = (after * along[:-1] + before * along[1:]) / (before + after)
        leaving = np.where(corner[:-1, np.newaxis], along, smooth[:-1])
        arriving = np.where(corner[1:, np.newaxis], along, smooth[1:])
        third = self.reach * long / 3.0
        pieces = np.stack(
            (control[:-1], control[:-1] + third * leaving, control[1:] - third * arriving, control[1:]), axis=1
        )
        return Chain(pieces, np.where(corner, index, index - 1)[:-1], np.where(corner, index, index + 1)[1:])


@dataclass(frozen=True, kw_only=True)
class PolylinePlanner(Planner):
    """A planner whose answer is a polyline with points anywhere, of which its path over cells is made."""

    smoothing: Smoother | None = None
    """Makes a curve of the polyline, where nobody asks for another."""

    @abstractmethod
    def polyline(self, state: State) -> Points | None:
        """Return the polyline (k, 2) from start to goal of a state's answer, free under the problem's corner policy."""


def _distinct(path: Points) -> Points:
    """Return the path with points that directly follow themselves named once."""
    moved = np.ones(len(path), np.bool_)
    moved[1:] = (path[1:] != path[:-1]).any(axis=1)
    return path[moved]


def _points_at(at: NDArray[np.float64], corners: Points) -> Points:
    """Return the points of a polyline at parameters that count its corners."""
    left = np.minimum(at.astype(np.intp), len(corners) - 2)
    share = (at - left)[:, np.newaxis]
    return np.asarray((1.0 - share) * corners[left] + share * corners[left + 1])


def _from_to(first: NDArray[np.intp], last: NDArray[np.intp], n: int) -> NDArray[np.bool_]:
    """Return which of n indices lie within any of the ranges, both ends included."""
    change = np.zeros(n + 1, np.intp)
    np.add.at(change, first, 1)
    np.add.at(change, last + 1, -1)
    return np.cumsum(change[:-1]) > 0


def _sampled(pieces: NDArray[Any], straight: NDArray[np.bool_], problem: PathProblem, tolerance: float) -> Any:
    it = problem.context
    return compiled.curves.sampled(pieces, straight, it.blocked, it.rows, it.cols, it.policy, tolerance)


def _measured(
    points: Points, length: float, curvature: float, fallback: bool, inserted: int, problem: PathProblem
) -> Curve:
    it = problem.context
    clearance = float(compiled.curves.clearance(points, it.blocked, it.distance, it.rows, it.cols))
    return Curve(points, length, clearance if np.isfinite(clearance) else None, curvature, fallback, inserted)
