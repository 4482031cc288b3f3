"""Peak memory of planning, measured in a process of its own: ``python -m pathloom.bench.memory PLANNER MAP CORNERS``.

numpy tells tracemalloc what it allocates, compiled kernels do not: so the peak of
the resident memory is measured too, where the system tells it (Linux).
"""

import json
import subprocess
import sys
import tracemalloc
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pathloom.bench.suite import problem_on
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run
from pathloom.paths.context import Corners

STATUS, CLEAR = Path("/proc/self/status"), Path("/proc/self/clear_refs")


@dataclass(frozen=True)
class Memory:
    """Bytes a cell, beyond what the loaded program and the map itself take."""

    traced: float
    """Peak of what Python and numpy allocate."""
    resident: float | None
    """Peak of all memory in use, where it can be known."""


def memory(planner: str | Mapping[str, Any], name: str, corners: Corners) -> Memory:
    """Return what planning on a map takes, as another process measures it."""
    words = [sys.executable, "-m", __name__, json.dumps(planner), name, corners]
    done = subprocess.run(words, capture_output=True, text=True, check=True)  # noqa: S603 - our own module
    return Memory(**json.loads(done.stdout))


def _measured(planner: str | Mapping[str, Any], name: str, corners: Corners) -> Memory:
    composed = compose(planner)
    run(problem_on("random-20:20%", corners), composed, 0)  # kernels and modules are loaded
    problem = problem_on(name, corners)
    cells = problem.grid.width * problem.grid.height
    before = _resident("VmRSS")
    try:
        CLEAR.write_text("5")  # Linux: the peak begins anew
    except OSError:
        before = None
    run(problem, composed, 0)
    peak = _resident("VmHWM")
    resident = None if before is None or peak is None else max(0, peak - before) / cells
    fresh = problem_on(name, corners)
    tracemalloc.start()
    run(fresh, composed, 0)
    return Memory(tracemalloc.get_traced_memory()[1] / cells, resident)


def _resident(key: str) -> int | None:
    """Return a line of the process's status, in bytes."""
    try:
        lines = STATUS.read_text().splitlines()
    except OSError:
        return None
    return next((1024 * int(line.split()[1]) for line in lines if line.startswith(f"{key}:")), None)


if __name__ == "__main__":
    planner, name, corners = sys.argv[1:]
    sys.stdout.write(json.dumps(vars(_measured(json.loads(planner), name, corners))))  # type: ignore[arg-type]
