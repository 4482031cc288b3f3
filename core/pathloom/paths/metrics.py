"""Metrics of a finished path: what a report says of it."""

from typing import Any

import numpy as np

from pathloom import compiled
from pathloom.paths.cell_paths import Path
from pathloom.paths.problem import PathProblem


def metrics(path: Path, problem: PathProblem) -> dict[str, Any]:
    """Return length (cells, and metres where the map has a place in the world), nodes, turns and clearance.

    ``turn_angle`` is in radians; ``min_clearance`` is the least distance to an
    obstacle cell's border in cells, ``None`` on an empty map; ``unsafe_nodes``
    counts nodes with an obstacle among their 8 neighbours, both ends included.
    """
    it = problem.context
    row = problem.representation.encode([path])
    length = float(compiled.measures.lengths(row, it.cols)[0])
    turns, angle = compiled.measures.turns(row, it.cols)[0].tolist()
    clearance = float(compiled.measures.clearances(row, it.blocked, it.distance, it.rows, it.cols)[0])
    found: dict[str, Any] = {
        "length": length,
        "nodes": len(path),
        "turns": int(turns),
        "turn_angle": angle,
        "min_clearance": clearance if np.isfinite(clearance) else None,
        "unsafe_nodes": int(compiled.measures.sum_over_nodes(row, it.unsafe, 0, 0)[0]),
    }
    if problem.grid.metric:
        found["length_m"] = length * problem.grid.resolution
    return found
