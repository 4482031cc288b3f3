"""RRT: a tree that grows from the start into the open until it meets the goal."""

import time
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from pathloom import Count, Distance, Fidelity, Positive, Problem, Share, State, Termination, Terms, compiled
from pathloom.kernel.counting import count, counting
from pathloom.kernel.search import Search
from pathloom.kernel.state import Individual, generator
from pathloom.paths.curves import Points, PolylinePlanner
from pathloom.paths.objectives import Length
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem

Lattice = NDArray[np.int64]
"""(k, 2), rows and columns in steps of 1/4095 of a cell: tests between such points are exact in integers."""
Row = NDArray[np.int32]
"""(k,), a path as flat ids of cells."""


@dataclass(frozen=True)
class TreeState(State):
    """Where a tree stands. Its population is the path that it has just found, or nobody."""

    nodes: Lattice = field(default_factory=lambda: np.empty((0, 2), np.int64))
    """(n, 2), the nodes of the tree, as old as they come; the first one is the start."""
    parents: NDArray[np.int32] = field(default_factory=lambda: np.empty(0, np.int32))
    """(n,), index of the node that each of them grew from; −1 for the start."""
    samples: int = 0
    """Samples drawn for this tree."""
    ended: bool = False
    """Whether this tree grows no more."""
    trees: int = 0
    """Trees that have come to their end."""
    way: Lattice | None = None
    """(k, 2), from start to goal along branches, what the answer is made of."""

    @property
    def points(self) -> Points:
        """The nodes (n, 2) in cells."""
        return self.nodes / compiled.trees.UNIT


@dataclass(frozen=True, kw_only=True)
class Rrt(Search, PolylinePlanner):
    """RRT, the rapidly-exploring random tree.

    Nodes are points anywhere on the map. The path over cells goes through the
    cells of the branch's nodes, and where the segments between their centres are
    not free, through all cells that the branch crosses.
    """

    name: ClassVar[str] = "rrt"
    works_on: ClassVar[str] = "cells"
    reference: ClassVar[str] = (
        "S. M. LaValle (1998), Rapidly-Exploring Random Trees: A New Tool for Path Planning, "
        "Computer Science Department, Iowa State University, TR 98-11"
    )
    bibtex: ClassVar[str] = """\
@techreport{lavalle1998rrt,
  author      = {LaValle, Steven M.},
  title       = {Rapidly-Exploring Random Trees: A New Tool for Path Planning},
  institution = {Computer Science Department, Iowa State University},
  number      = {TR 98-11},
  year        = {1998}
}
"""
    fidelity: ClassVar[Fidelity] = "standard"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Samples are drawn from the whole map, obstacles included; 5 % of them are the goal.",
        "Between two obstacles that share a corner no tree finds its way, even where paths may: a branch does not meet "
        "a point by chance.",
        "The step is the 1.7 cells that S-RRT and the RRT it is compared with take on maps of 20 × 20, whatever the "
        "size of the map: obstacles are cells. With a step in proportion to the map fewer samples are needed, and the "
        "paths get longer.",
        "A branch grows by one step, or up to the sample where that is nearer; where that collides it does not grow.",
        "From a new node within one step of the goal, the goal is tried at once.",
        "The first path is the answer. More `trees` grow one after the other, and the shortest path of all is.",
        "One evaluation is one path found, whatever growing the tree took.",
    )

    objectives: Terms = Terms({"length": Length()})
    step_length: Distance = 1.7
    """Length of a branch in cells: δ."""
    goal_bias: Share = 0.05
    """Probability that the goal is the target instead of a random point: 1 − p."""
    tolerance: Positive = 1.0
    """Distance from the goal, in steps, within which a new node tries to reach it."""
    nearest: Literal["target", "sample"] = "target"
    """Which node grows towards the goal where that is the target: the nearest to it, or to the random point."""
    samples: Count = 1_000_000
    """Samples after which a tree is given up."""
    chunk: Count = 1_000
    """Samples in each step of a run."""
    trees: Count = 1
    """Trees that grow, one after the other; the shortest of their paths is the answer."""
    denoise: bool = False
    """Whether a tree that has reached the goal loses all nodes that are not on the way there."""
    termination: tuple[Termination, ...] = ()

    def start(self, problem: Problem, rng: np.random.Generator) -> TreeState:
        self.check_representation(problem)
        began = time.perf_counter()
        it = path_problem(problem)
        root = _rooted(TreeState(problem, rng.bit_generator.state))
        if it.ends[0] != it.ends[1]:
            return self._recorded(root, None, rng, began)
        return self._recorded(replace(root, ended=True, trees=self.trees), root.nodes, rng, began)

    def step(self, state: State) -> TreeState:
        assert isinstance(state, TreeState), "a state of this planner"
        began = time.perf_counter()
        rng = generator(state.random)
        grown, goal = self._grown(_rooted(state) if state.ended else state, rng)
        way = grown.nodes[_way_to(goal, grown.parents)] if goal >= 0 else None
        return self._recorded(grown, way, rng, began)

    def done(self, state: State) -> bool:
        assert isinstance(state, TreeState), "a state of this planner"
        return state.trees >= self.trees or super().done(state)

    def progress(self, state: State) -> float:
        assert isinstance(state, TreeState), "a state of this planner"
        growing = 0.0 if state.ended else state.samples / self.samples
        return max(super().progress(state), min(1.0, (state.trees + growing) / self.trees))

    def solution(self, state: State, answer: Individual) -> Row:
        assert isinstance(state, TreeState), "a state of this planner"
        assert state.way is not None, "what the answer was made of"
        return self.path(state.way, path_problem(state.problem))

    def nothing(self, state: State) -> str:
        assert isinstance(state, TreeState), "a state of this planner"
        tried = f"{state.samples} samples made a tree of {len(state.nodes)} nodes that has not reached the goal"
        return tried if state.trees < 2 else f"{state.trees} trees, of the last of which {tried}"

    def polyline(self, state: State) -> Points | None:
        assert isinstance(state, TreeState), "a state of this planner"
        if state.way is None:
            return None
        return self.refined(state.way, path_problem(state.problem)) / compiled.trees.UNIT

    def refined(self, way: Lattice, problem: PathProblem) -> Lattice:
        """Return what is made of a way (k, 2) through the tree before it is the answer: nothing here."""
        return way

    def path(self, way: Lattice, problem: PathProblem) -> Row:
        """Return the path over cells for a way (k, 2) through the tree."""
        return over_cells(self.refined(way, problem), problem)

    def _grown(self, state: TreeState, rng: np.random.Generator) -> tuple[TreeState, int]:
        """Return the tree after a chunk of samples, and the index of the goal among its nodes or −1."""
        problem = path_problem(state.problem)
        it, unit = problem.context, compiled.trees.UNIT
        n, most = len(state.nodes), min(self.chunk, self.samples - state.samples)
        nodes, parents = np.empty((n + most + 1, 2), np.int64), np.empty(n + most + 1, np.int32)
        nodes[:n], parents[:n] = state.nodes, state.parents
        step = self.step_length * unit
        n, drawn, goal = compiled.trees.grow(
            it.blocked, it.rows, it.cols, it.policy, problem.ends[1][0] * unit, problem.ends[1][1] * unit,
            step, self.tolerance * step, self.goal_bias, self.nearest == "sample",
            nodes, parents, n, most, rng.bit_generator.random_raw(4),
        )  # fmt: skip
        samples = state.samples + drawn
        ended = goal >= 0 or samples >= self.samples
        grown = replace(state, nodes=nodes[:n].copy(), parents=parents[:n].copy(), samples=samples, ended=ended)
        return replace(grown, generation=state.generation + 1, trees=state.trees + ended), goal

    def _recorded(self, grown: TreeState, way: Lattice | None, rng: np.random.Generator, began: float) -> TreeState:
        """Return the state of a tree that has grown, and reached the goal along a way (k, 2) or not."""
        problem = path_problem(grown.problem)
        with counting() as counts:
            rows = np.empty((0, 1), np.int32) if way is None else over_cells(way, problem)[np.newaxis]
            deme = self.evaluate(rows, problem)
            count("trees without a path", int(grown.ended and way is None))
        best = self.fittest(grown.best, deme, grown.generation)
        state = replace(grown, **self.recorded(grown, deme, best, grown.generation, rng, counts, began))
        if way is None:  # the history goes from path to path
            return replace(state, answer=grown.answer, history=grown.history)
        if self.denoise:
            state = replace(state, nodes=way, parents=np.arange(-1, len(way) - 1, dtype=np.int32))
        short = -_length(self.refined(way, problem))
        if grown.answer is not None and short <= grown.answer.merit:
            return replace(state, answer=grown.answer)
        found = Individual(rows[0], deme.values[0], float(deme.fitness[0]), grown.generation, short)
        return replace(state, answer=found, way=way)


def over_cells(points: Lattice, problem: PathProblem) -> Row:
    """Return a path over cells for a free polyline (k, 2)."""
    it = problem.context
    cells = compiled.trees.cells_of_points(points, it.blocked, it.cols, it.policy)
    return np.asarray(compiled.reshaping.without_loops(cells[np.newaxis], it.blocked.size)[0])


def _rooted(state: TreeState) -> TreeState:
    """Return the state with a tree that is nothing but the start."""
    root = np.array([path_problem(state.problem).ends[0]], np.int64) * compiled.trees.UNIT
    return replace(state, nodes=root, parents=np.array([-1], np.int32), samples=0, ended=False)


def _way_to(node: int, parents: NDArray[np.int32]) -> list[int]:
    """Return the indices of the nodes from the root to one of them."""
    way = [node]
    while parents[way[-1]] >= 0:
        way.append(int(parents[way[-1]]))
    return way[::-1]


def _length(points: Lattice) -> float:
    """Return the length of a polyline (k, 2), in cells."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum()) / float(compiled.trees.UNIT)
