"""How often the paths of weighted-sum planners are dominated by a front, map by map."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from pathloom.fronts.against import Which
from pathloom.multiobjective.composing import Objectives
from pathloom.multiobjective.running import DEFAULT_PLANNER, pareto
from pathloom.paths.context import Corners
from pathloom.paths.maps import load_map
from pathloom.paths.problem import PathProblem

PAPERS = ("agacd", "imga", "imaga", "iga")
"""The planners of four papers that weigh several objectives against each other."""
MAPS = ("iga-map1", "imaga-fig1", "random-20:75:s1", "blocks-30:20%:s2", "rooms-40:8")


@dataclass(frozen=True)
class Standing:
    """How the paths of one planner stand beside the front of one map."""

    map: str
    planner: str
    which: Which
    """Whether these are the paths before refinement or after."""
    runs: int
    found: int
    """Runs that found a path."""
    cells: int
    """Paths among them of single steps only; others may beat every such path."""
    dominated: int
    on_the_front: int
    beats: int
    """Better than a member of the front."""
    beside: int
    """Neither better nor worse than any member."""


def dominance(
    maps: Sequence[str] = MAPS,
    planners: Sequence[str] = PAPERS,
    *,
    algorithm: Any = DEFAULT_PLANNER,
    objectives: Objectives | None = None,
    corners: Corners = "allow",
    seed: int = 0,
    runs: int = 10,
) -> Iterator[Standing]:
    """Yield how each planner's paths of several seeds stand beside the front of each map.

    The front is that of one run of ``algorithm`` with ``seed``. The papers allow
    paths to touch corners, so ``corners`` is ``allow`` by default.
    """
    for name in maps:
        problem = PathProblem(load_map(name, corners=corners), corners=corners)
        front = pareto(problem, algorithm, objectives=objectives, seed=seed, against=planners, runs=runs, map_name=name)
        for planner in dict.fromkeys(rival.planner for rival in front.against):
            rivals = [rival for rival in front.against if rival.planner == planner]
            which: Which
            for which in ("unrefined", "refined"):
                placed = [p for rival in rivals for p in rival.placements if p.which == which]
                verdicts = Counter(placement.verdict for placement in placed)
                yield Standing(
                    name, planner, which, len(rivals), len(placed), sum(p.cells for p in placed),
                    verdicts["dominated"], verdicts["on the front"], verdicts["beats the front"],
                    verdicts["beside the front"],
                )  # fmt: skip


def markdown(standings: Sequence[Standing]) -> str:
    """Return a table: one line for each map, planner and kind of path."""
    heads = ("map", "planner", "path", "runs", "of cells", "dominated", "on the front", "beside it", "beats a member")
    lines = [
        (s.map, s.planner, s.which, f"{s.found}/{s.runs}", s.cells, s.dominated, s.on_the_front, s.beside, s.beats)
        for s in standings
    ]
    rows = [heads, ("---",) * len(heads), *lines]
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in rows) + "\n"
