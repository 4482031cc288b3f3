"""A genetic algorithm over the control points of Bézier curves."""

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from pathloom import (
    ConfigError,
    Count,
    Distance,
    Fidelity,
    Floats,
    NonNegative,
    PathProblem,
    Share,
    State,
    Termination,
    VectorPlanner,
    VectorState,
    compiled,
    count,
)
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.curves import CubicBezier, Points, PolylinePlanner, Smoother
from pathloom.paths.pathwise import path_problem
from pathloom.paths.vectors.decoding import violations
from pathloom.paths.vectors.planner import Judge, Vectors

STEP = 0.25
"""Cells: distance of the points in which curves are held against the map.

Between two of them a cubic departs from its chord by less than STEP² / (6 · longest
leg of its control polygon).
"""


@dataclass(frozen=True, kw_only=True)
class BezierGa(VectorPlanner, PolylinePlanner):
    """A genetic algorithm whose genes are the control points of a smooth curve.

    The values of an individual are the length of its curve and how far, on
    average, it falls short of the safe distance.
    """

    name: ClassVar[str] = "bezier-ga"
    reference: ClassVar[str] = (
        "J. Ma, Y. Liu, S. Zang, L. Wang (2020), Robot Path Planning Based on Genetic Algorithm Fused with Continuous "
        "Bezier Optimization, Computational Intelligence and Neuroscience, 9813040, doi:10.1155/2020/9813040; after "
        "B. Song, Z. Wang, L. Sheng (2016), A new genetic algorithm approach to smooth path planning for mobile "
        "robots, Assembly Automation 36(2), 138-145, doi:10.1108/AA-11-2015-094"
    )
    bibtex: ClassVar[str] = """\
@article{ma2020bezier,
  author  = {Ma, Jianwei and Liu, Yang and Zang, Shaofei and Wang, Lin},
  title   = {Robot Path Planning Based on Genetic Algorithm Fused with Continuous {Bezier} Optimization},
  journal = {Computational Intelligence and Neuroscience},
  year    = {2020},
  pages   = {9813040},
  doi     = {10.1155/2020/9813040}
}
"""
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Only the abstract and the introduction of the paper were at hand: control points by genetic operations, the "
        "length of the curve, a safe distance and an adaptive penalty factor are the paper's, all the rest is ours.",
        "That this is the Bézier method BCA of Li et al. 2021 is our guess: their reference is to something else.",
        "Pieces are cubic; where two meet lies the middle between their handles, so that they join with one tangent.",
        "Control points are centres of cells, of obstacles too; only the curve has to be free.",
        "The first control points are drawn around the straight way from start to goal.",
        "Cost is length · (1 + mean shortage of the safe distance) plus penalty factor · violation; the factor is "
        "λ (1 + g / G) (share of colliding individuals + 0.1).",
        "Tournaments of two, uniform crossover point by point, mutation to a free cell whose distance is at most "
        "5 (1 - g / G) + 1, one elite.",
        "The answer is the cells that the curve crosses; the curve is reported as a polyline of points on it.",
    )

    points: Annotated[int, msgspec.Meta(ge=1, le=64)] = 8
    """Control points between start and goal, for pieces two each."""
    form: Literal["pieces", "single"] = "pieces"
    """``pieces``: cubic curves that join smoothly; ``single``: one curve of degree ``points`` + 1, at most 12."""
    noise: NonNegative = 0.15
    """Standard deviation of the first control points about the straight way, as a share of the map's sides."""
    safe: Distance = 1.5
    """Distance of a cell's centre from the nearest obstacle's centre from which on it is safe, in cells."""
    penalty: NonNegative = 10.0
    """λ, in cells of length for one unit of violation."""
    crossing: Share = 0.8
    """Probability that a pair is crossed."""
    mutating: Share = 0.1
    """Probability that a control point is moved."""
    tries: Count = 20
    """How often a free cell is looked for to move a control point to."""
    smoothing: Smoother | None = CubicBezier()
    termination: tuple[Termination, ...] = (MaxGenerations(limit=100),)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.form == "pieces" and self.points % 2:
            raise ConfigError(f"{self.name}: points is even, two for each piece; got {self.points}")
        if self.form == "single" and self.points > 11:
            raise ConfigError(f"{self.name}: one curve has at most 11 points; got {self.points}: take form = pieces")

    def first_genes(self, problem: PathProblem, rng: np.random.Generator) -> Floats:
        start, goal = np.array(problem.ends, np.float64)
        sides = np.array(problem.grid.shape)
        share = np.arange(1, self.points + 1)[:, np.newaxis] / (self.points + 1)
        straight = start + share * (goal - start)
        drawn = straight + self.noise * sides * rng.standard_normal((self.population, self.points, 2))
        return np.asarray(np.clip(np.rint(drawn), 0, sides - 1).reshape(self.population, -1))

    def evaluate_genes(self, genes: Floats, problem: PathProblem) -> tuple[Vectors, NDArray[np.bool_]]:
        it = problem.context
        paths, lengths, shortage = compiled.decoding.along_curves(
            self._pieces(genes, problem), it.cols, STEP, it.distance, self.safe
        )
        wrong = violations(paths, problem)
        costs = lengths * (1.0 + shortage)
        legal = wrong == 0.0
        with np.errstate(divide="ignore"):
            fitness = np.where(legal, 1.0 / costs, -wrong)
        return Vectors(genes, paths, np.stack((lengths, shortage), axis=1), wrong, fitness, costs), legal

    def move(self, state: VectorState, judge: Judge, rng: np.random.Generator) -> tuple[Vectors, Any]:
        parents, progress = state.vectors, self.progress(state)
        n = len(parents)
        factor = self.penalty * (1.0 + progress) * ((parents.violations > 0.0).mean() + 0.1)
        cost = parents.costs + factor * parents.violations
        rivals = rng.integers(n, size=(n, 2))
        winners = np.where(cost[rivals[:, 0]] <= cost[rivals[:, 1]], rivals[:, 0], rivals[:, 1])
        genes = parents.genes[winners].reshape(n, self.points, 2)
        genes = self._mutated(self._crossed(genes, rng), judge.problem, progress, rng)
        genes[0] = parents.genes[np.argmin(cost)].reshape(self.points, 2)  # the elite
        return judge(genes.reshape(n, -1)), None

    def polyline(self, state: State) -> Points | None:
        assert isinstance(state, VectorState), "a state of this planner"
        if state.legal is None:
            return None
        (pieces,) = self._pieces(state.legal.genes, path_problem(state.problem))
        return np.asarray(compiled.decoding.sample_curve(pieces, STEP))

    def _pieces(self, genes: Floats, problem: PathProblem) -> Floats:
        """Return the curves' Bézier pieces (n, pieces, degree + 1, 2)."""
        start, goal = np.array(problem.ends, np.float64)
        control = genes.reshape(len(genes), self.points, 2)
        if problem.context.start == problem.context.goal:
            control = np.broadcast_to(start, control.shape)
        starts, goals = (np.broadcast_to(end, (len(genes), 1, 2)) for end in (start, goal))
        if self.form == "single":
            return np.ascontiguousarray(np.concatenate((starts, control, goals), axis=1)[:, np.newaxis])
        first, second = control[:, ::2], control[:, 1::2]  # the handles of each piece
        joints = np.concatenate((starts, 0.5 * (second[:, :-1] + first[:, 1:]), goals), axis=1)
        return np.stack((joints[:, :-1], first, second, joints[:, 1:]), axis=2)

    def _crossed(self, genes: Floats, rng: np.random.Generator) -> Floats:
        """Return genes (n, points, 2), of each pair that is crossed every point exchanged or not."""
        pairs = len(genes) // 2
        swapped = rng.random((pairs, self.points)) < 0.5
        swapped &= rng.random((pairs, 1)) < self.crossing
        mothers, fathers, both = genes[0 : 2 * pairs : 2], genes[1 : 2 * pairs : 2], swapped[..., np.newaxis]
        children = genes.copy()
        children[0 : 2 * pairs : 2] = np.where(both, fathers, mothers)
        children[1 : 2 * pairs : 2] = np.where(both, mothers, fathers)
        return children

    def _mutated(self, genes: Floats, problem: PathProblem, progress: float, rng: np.random.Generator) -> Floats:
        """Return genes (n, points, 2), some of the points moved to a free cell nearby."""
        free = ~problem.context.occupied
        reach = 5.0 * (1.0 - progress) + 1.0
        most = int(reach)
        points = genes.reshape(-1, 2).copy()
        pending = np.flatnonzero(rng.random(len(points)) < self.mutating)
        for _ in range(self.tries):
            way = rng.integers(-most, most + 1, size=(len(pending), 2))
            there = points[pending].astype(np.intp) + way
            far = (way**2).sum(axis=1)
            fine = (far > 0) & (far <= reach**2) & (there >= 0).all(axis=1) & (there < free.shape).all(axis=1)
            fine[fine] = free[tuple(there[fine].T)]
            points[pending[fine]] = there[fine]
            pending = pending[~fine]
            if len(pending) == 0:
                break
        count("mutation failed", len(pending))
        return points.reshape(genes.shape)
