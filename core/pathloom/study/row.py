"""Row: what a study keeps of one run, as everything that reads a study sees it."""

from dataclasses import dataclass, fields
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

Status = Literal["found", "not-found", "unreachable", "failed", "timeout", "crashed"]
"""What became of a run.

``found``: a path that passed the exact validator. ``not-found``: none within the
budget, or one that collides. ``unreachable``: there is no path, said before any
search. ``failed``: the planner raised an exception. ``timeout``: it did not stop
when its time was over, and was ended. ``crashed``: it took its process with it, twice.
"""

STATUSES: tuple[Status, ...] = get_args(Status)


@dataclass(frozen=True, slots=True)
class Row:
    """One run. Lengths are in cells; ``None`` is what is unknown or does not apply."""

    variant: str
    """Name of the variant, unique within the study; the base of an ablation bears its planner's name."""
    planner: str
    """Name of the planner."""
    map: str
    """Name of the instance (map, start, goal), unique within the study; a case of a scenario is ``FILE:CASE``."""
    seed: int
    """Runs of all variants with the same map and seed are pairs."""
    status: Status
    length: float | None = None
    """Length of the path in cells; of a front, that of its shortest path."""
    fitness: float | None = None
    """The planner's own fitness; comparable only where objectives and weights are the same."""
    turns: int | None = None
    turn_angle: float | None = None
    """Radians."""
    min_clearance: float | None = None
    """Least distance to an obstacle cell's border, in cells."""
    unsafe_nodes: int | None = None
    nodes: int | None = None
    gap_grid: float | None = None
    """length / octile optimum − 1; negative where a path cuts corners that single steps cannot."""
    gap_any_angle: float | None = None
    """length / any-angle optimum − 1."""
    gap_bound: float | None = None
    """length / lower bound − 1: the gap to the any-angle optimum is at most this, also where that is unknown."""
    hypervolume: float | None = None
    """Of a front: the volume that it dominates, up to the reference point of its instance."""
    hypervolume_ratio: float | None = None
    """The same divided by that of the exact front, where that is known, else by that of all fronts of the instance."""
    evaluations: int | None = None
    evaluations_to_first: int | None = None
    """Evaluations spent when there first was an answer."""
    evaluations_to_one_percent: int | None = None
    """Evaluations spent when the answer was first within 1 % of the any-angle optimum (or of its lower bound)."""
    generations: int | None = None
    seconds: float | None = None
    """Time of the run itself, without loading of kernels."""
    error: str | None = None
    """Why there is no path, in one line."""


NAMES: tuple[str, ...] = tuple(field.name for field in fields(Row))
"""The columns of a study, in the order in which they are exported."""


@dataclass(frozen=True, slots=True)
class RunHistory:
    """What a run was like on its way: one entry a generation, and one for each new answer."""

    evaluations: NDArray[np.int64]
    """(g,) evaluations spent so far."""
    best: NDArray[np.float64]
    """(g,) best fitness found so far."""
    generation_best: NDArray[np.float64]
    """(g,) best fitness within the generation."""
    mean: NDArray[np.float64]
    """(g,) mean fitness of the generation."""
    diversity: NDArray[np.float64]
    """(g,) share of distinct individuals."""
    answer_evaluations: NDArray[np.int64]
    """(k,) evaluations spent when the planner's answer changed."""
    answer_lengths: NDArray[np.float64]
    """(k,) length in cells of the answer that it would have given then, refinement included; inf where it collides."""
