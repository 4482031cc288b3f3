"""Section 4: S-RRT, a tree drawn to the goal, its branch straightened and smoothed."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Fidelity, Share, Smoother, compiled
from pathloom.paths.curves import BSpline
from pathloom.paths.problem import PathProblem
from pathloom_hga_aco.planner import BIBTEX, SONG
from pathloom_hga_aco.rrt import Lattice, Row, Rrt, over_cells


@dataclass(frozen=True, kw_only=True)
class SRrt(Rrt):
    """S-RRT, the smooth rapidly-exploring random tree."""

    name: ClassVar[str] = "s-rrt"
    reference: ClassVar[str] = f"{SONG}; section 4"
    bibtex: ClassVar[str] = BIBTEX
    fidelity: ClassVar[Fidelity] = "faithful"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Algorithm 1 takes the node nearest to the random point even where the goal is the target; here it is the "
        "nearest to the target, or nothing would speed up the growth towards the goal (`nearest`).",
        "The target is the goal if q > p, so with p = 0.6 in 40 % of all cases, although the text calls p the "
        "threshold; the other reading is a `goal_bias` of 0.6. The bias announced as variable is constant.",
        "The goal counts as reached from any new node within one step of it that sees it: X_new = X_goal alone would "
        "hardly ever hold.",
        "The step of 1.7, printed for a space of 20 × 20, is that of every map.",
        "Samples are drawn from the whole map; a million of them are the limit, of which the paper gives none. As with "
        "any tree, a way that leads between two obstacles which share a corner is not found, even where it is allowed.",
        "Algorithm 2 prints one collision test twice and X_init in two roles. Meant is: from the start, look from the "
        "goal back, parent by parent, for the first node in sight; go on from there.",
        "The spline's degree is not given: 3. Eqs. (12) to (15) count control points and knots in two ways at once; "
        "here they are clamped uniform knots for a degree, and half-open intervals in (13).",
        "Nothing is said of a spline that cuts an obstacle, as it does: then control points are inserted halfway on "
        "the segments near by, until it is clear.",
        "The path over cells is the straightened branch with its nodes moved to the centres of their cells, or where "
        "that collides, over the cells that the branch crosses, straightened again.",
    )

    goal_bias: Share = 0.4  # p = 0.6, section 4.3
    shortcut: bool = True
    """Whether the branch is straightened (algorithm 2)."""
    denoise: bool = True  # algorithm 2, line 2
    smoothing: Smoother | None = BSpline()  # eqs. (12) to (15)

    def refined(self, way: Lattice, problem: PathProblem) -> Lattice:
        if not self.shortcut:
            return way
        it = problem.context
        return np.asarray(compiled.trees.straightened(way, it.blocked, it.cols, it.policy))

    def path(self, way: Lattice, problem: PathProblem) -> Row:
        row = over_cells(self.refined(way, problem), problem)
        if not self.shortcut:
            return row
        it = problem.context
        return np.asarray(compiled.trees.straightened_paths(row[np.newaxis], it.blocked, it.cols, it.policy)[0])
