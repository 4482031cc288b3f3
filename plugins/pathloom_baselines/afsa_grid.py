"""The artificial fish swarm that walks over cells, as programs for grids have it."""

import time
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import (
    Count,
    Deme,
    Distance,
    Fidelity,
    Problem,
    Share,
    State,
    Termination,
    Terms,
    compiled,
)
from pathloom.kernel.counting import counting
from pathloom.kernel.search import Search
from pathloom.kernel.state import generator
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.context import STEPS, Cells, Context
from pathloom.paths.objectives import Length
from pathloom.paths.pathwise import path_problem
from pathloom_baselines.afsa import Afsa

Places = NDArray[np.intp]
"""(…, 2), rows and columns."""
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class ShoalState(State):
    """Where the fish are, and how they came there."""

    trails: Cells
    """(n, generation + 1), the cells of each fish, one an iteration; fish that have arrived stay."""


@dataclass(frozen=True, kw_only=True)
class AfsaGrid(Search):
    """AFSA on cells: fish that step to neighbours, all from the start, until they come to the goal."""

    name: ClassVar[str] = "afsa-grid"
    reference: ClassVar[str] = f"{Afsa.reference}; on cells: common practice in programs"
    bibtex: ClassVar[str] = Afsa.bibtex
    fidelity: ClassVar[Fidelity] = "standard"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Food is the distance to the goal as the crow flies: fish get stuck behind obstacles that are hollow there.",
        "All fish start where the path starts; one that has come to the goal yields its trail, without its loops.",
        "A fish preys by stepping to the best neighbour (probability 0.8) or to a better one of five at random; where "
        "there is none, to any.",
        "It swarms and follows by stepping to a random neighbour that is nearer to the centre or to the best fish, if "
        "that is better and not crowded, and does what brings it nearer to the goal.",
    )

    fish: Count = 20
    """Number of fish."""
    visual: Distance = 4.0
    """How far a fish sees, in cells."""
    delta: Share = 0.8
    """δ, the share of all fish from which on a place is crowded."""
    tries: Count = 5
    """How many random neighbours a fish looks at."""
    greed: Share = 0.8
    """Probability that it looks at all of them instead."""
    objectives: Terms = Terms({"length": Length()})
    termination: tuple[Termination, ...] = (MaxGenerations(limit=100),)

    def start(self, problem: Problem, rng: np.random.Generator) -> ShoalState:
        self.check_representation(problem)
        it = path_problem(problem)
        began = time.perf_counter()
        trails = np.full((self.fish, 1), it.context.start, np.int32)
        return self._reached(State(it, rng.bit_generator.state), trails, 0, rng, {}, began)

    def step(self, state: State) -> ShoalState:
        assert isinstance(state, ShoalState), "a state of this planner"
        began = time.perf_counter()
        rng = generator(state.random)
        with counting() as counts:
            it = path_problem(state.problem).context
            cells = self._moved(np.stack(np.divmod(state.trails[:, -1], it.cols), axis=1), it, rng)
            trails = np.column_stack((state.trails, (cells[:, 0] * it.cols + cells[:, 1]).astype(np.int32)))
            return self._reached(state, trails, state.generation + 1, rng, counts, began)

    def done(self, state: State) -> bool:
        assert isinstance(state, ShoalState), "a state of this planner"
        return bool((state.trails[:, -1] == path_problem(state.problem).context.goal).all()) or super().done(state)

    def nothing(self, state: State) -> str:
        return f"none of {self.fish} fish came to the goal"

    def _reached(
        self, before: State, trails: Cells, generation: int, rng: np.random.Generator, counts: dict[str, int],
        began: float,
    ) -> ShoalState:  # fmt: skip
        it = path_problem(before.problem).context
        arrived = trails[:, -1] == it.goal
        if generation > 0:
            arrived &= trails[:, -2] != it.goal
        with counting() as more:
            paths = compiled.reshaping.without_loops(np.ascontiguousarray(trails[arrived]), it.blocked.size)
            deme: Deme = self.evaluate(paths, before.problem)
        best = self.fittest(before.best, deme, generation)
        fields = self.recorded(before, deme, best, generation, rng, counts | more, began)
        return ShoalState(**fields, trails=trails)

    def _moved(self, X: Places, it: Context, rng: np.random.Generator) -> Places:
        """Return where fish (n, 2) are after a step."""
        goal = np.array(divmod(it.goal, it.cols))
        beside = X[:, np.newaxis] + STEPS
        legal = (it.moves[X[:, 0] * it.cols + X[:, 1], np.newaxis] >> np.arange(8, dtype=np.uint8) & 1).astype(bool)
        near = _squared(X[:, np.newaxis] - X) <= self.visual**2
        np.fill_diagonal(near, val=False)
        n_f = near.sum(axis=1)
        uncrowded = n_f / len(X) < self.delta
        hunger = _squared(goal - X)

        centre = (near @ X) / np.maximum(n_f, 1)[:, np.newaxis]
        swarming = (n_f > 0) & uncrowded & (_squared(goal - centre) < hunger)
        leader = np.where(near, hunger, np.iinfo(np.intp).max).argmin(axis=1)
        following = (n_f > 0) & uncrowded[leader] & (hunger[leader] < hunger)

        swarmed = self._preyed(X, beside, legal, goal, rng)
        followed = self._preyed(X, beside, legal, goal, rng)
        swarmed = np.where(swarming[:, np.newaxis], _nearer(X, centre, beside, legal, swarmed, rng), swarmed)
        followed = np.where(following[:, np.newaxis], _nearer(X, X[leader], beside, legal, followed, rng), followed)
        better = _squared(goal - followed) < _squared(goal - swarmed)
        moved = np.where(better[:, np.newaxis], followed, swarmed)
        return np.where((hunger == 0)[:, np.newaxis], X, moved)

    def _preyed(
        self, X: Places, beside: Places, legal: Mask, goal: NDArray[np.intp], rng: np.random.Generator
    ) -> Places:
        """Return where fish are that step to the best neighbour, to a better one that they hit upon, or anywhere."""
        lot = np.where(legal, rng.random(legal.shape), np.inf)
        hunger = np.where(legal, _squared(goal - beside), np.iinfo(np.intp).max)
        best = hunger == hunger.min(axis=1, keepdims=True)
        hit = lot.argsort(axis=1).argsort(axis=1) < self.tries
        looked = np.where(rng.random((len(X), 1)) < self.greed, best, hit)
        better = looked & (hunger < _squared(goal - X)[:, np.newaxis])
        return _drawn(better, lot, beside, _drawn(legal, lot, beside, X))


def _nearer(
    X: Places, target: NDArray[Any], beside: Places, legal: Mask, otherwise: Places, rng: np.random.Generator
) -> Places:
    """Return a random neighbour of each fish that is nearer to its target."""
    nearer = _squared(target[:, np.newaxis] - beside) < _squared(target - X)[:, np.newaxis]
    return _drawn(legal & nearer, rng.random(legal.shape), beside, otherwise)


def _drawn(among: Mask, lot: NDArray[np.float64], beside: Places, otherwise: Places) -> Places:
    """Return the neighbour with the smallest lot among some (n, 8), or where there is none something else (n, 2)."""
    which = np.where(among, lot, np.inf).argmin(axis=1)
    return np.where(among.any(axis=1, keepdims=True), beside[np.arange(len(beside)), which], otherwise)


def _squared(way: NDArray[Any]) -> NDArray[Any]:
    return np.asarray((way**2).sum(axis=-1))
