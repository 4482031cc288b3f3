"""Scale: how time and memory grow with the number of cells."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from pathloom.bench.memory import Memory, memory
from pathloom.bench.suite import FAMILIES, problem_on
from pathloom.draw.colours import theme
from pathloom.draw.look import SMALL, TEXT, TITLE, dress
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run
from pathloom.paths.context import Corners

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEADS = ("maps", "side", "cells", "ms CPU", "ms wall", "ns a cell", "bytes a cell, traced", "resident")


@dataclass(frozen=True)
class Point:
    """One planner on one map."""

    family: str
    side: int
    cpu: float
    seconds: float
    """Medians, tables of the map made anew in each run."""
    memory: Memory | None = None

    @property
    def cells(self) -> int:
        """Cells of the map."""
        return self.side**2

    def line(self) -> tuple[str, ...]:
        """Return the point as text, in the order of `HEADS`."""
        of = (self.memory.traced, self.memory.resident) if self.memory else (None, None)
        peaks = ("–" if peak is None else f"{peak:.0f}" for peak in of)
        times = (f"{1000 * s:.3g}" if s < 0.1 else f"{1000 * s:.0f}" for s in (self.cpu, self.seconds))
        return self.family, str(self.side), str(self.cells), *times, f"{1e9 * self.cpu / self.cells:.0f}", *peaks


@dataclass(frozen=True)
class Fit:
    """Times of one family, held against c · N log N."""

    family: str
    exponent: float
    """b of the least squares line t = c (N log N)^b over all sizes: above 1, time grows faster than N log N."""
    last: float
    """The same from the last size but one to the last, where what a run costs on any map weighs least."""
    seconds: float
    """c of c · N log N that fits best where b is 1, in seconds; N log₂ N."""

    def __str__(self) -> str:
        per = 1e9 * self.seconds
        grows = f"(N log N)^{self.exponent:.2f}, over the last two sizes ^{self.last:.2f}"
        return f"{self.family}: t ≈ {per:.2g} ns · N log₂ N; grows as {grows}"


def measured(
    planner: str | Mapping[str, Any],
    corners: Corners,
    sizes: Sequence[int],
    seeds: int,
    families: Sequence[str] = FAMILIES,
    *,
    with_memory: bool = True,
    tell: Callable[[str], None] = lambda _: None,
) -> Iterator[Point]:
    """Yield the time, and the memory, on each family and size of maps."""
    composed = compose(planner)
    run(problem_on("random-20:20%", corners), composed, 0)
    for family in families:
        for side in sizes:
            name = family.format(n=side)
            tell(name)
            problem = problem_on(name, corners)
            times = []
            for seed in range(seeds):
                fresh = replace(problem)
                wall, cpu = time.perf_counter(), time.process_time()
                if fresh.reachable:
                    run(fresh, composed, seed)
                times.append((time.process_time() - cpu, time.perf_counter() - wall))
            cpu, wall = np.median(times, axis=0).tolist()
            peaks = memory(planner, name, corners) if with_memory else None
            yield Point(family.format(n="N"), side, cpu, wall, peaks)


def fits(points: Sequence[Point]) -> list[Fit]:
    """Return the fit of each family that was measured at two sizes or more."""
    found = []
    for family in dict.fromkeys(point.family for point in points):
        n, t = np.array([(p.cells, p.cpu) for p in points if p.family == family], np.float64).T
        if len(n) < 2:
            continue
        work, spent = np.log(n * np.log2(n)), np.log(np.maximum(t, 1e-9))
        exponent, _ = np.polyfit(work, spent, 1)
        last = (spent[-1] - spent[-2]) / (work[-1] - work[-2])
        found.append(Fit(family, float(exponent), float(last), float(np.exp(np.mean(spent - work)))))
    return found


def figure(points: Sequence[Point], title: str, *, dark: bool = False) -> "Figure":
    """Return the picture of times over sizes, with N log N through the first family's largest map."""
    from matplotlib.figure import Figure

    colours = theme(dark=dark)
    drawn = Figure(figsize=(7.0, 4.6), facecolor=colours.ground, layout="constrained")
    axes = drawn.add_subplot()
    looks = zip((colours.path, colours.goal, colours.start, colours.mean), "osD^", strict=True)
    families = list(dict.fromkeys(point.family for point in points))
    for family, (colour, mark) in zip(families, [*looks] * len(families), strict=False):
        of = [p for p in points if p.family == family]
        axes.plot(
            [p.cells for p in of],
            [1000 * p.cpu for p in of],
            color=colour,
            marker=mark,
            markersize=5,
            linewidth=1.6,
            label=family,
        )
    largest = max(points, key=lambda p: (p.cells, p.cpu))
    n = np.array(sorted({p.cells for p in points}), np.float64)
    ideal = 1000 * largest.cpu * n * np.log(n) / (largest.cells * np.log(largest.cells))
    axes.plot(n, ideal, color=colours.quiet, linewidth=1.1, linestyle=(0, (4, 2)), label="N log N")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    sides = sorted({p.side for p in points})
    axes.set_xticks([side**2 for side in sides], [f"{side}²" for side in sides])
    axes.minorticks_off()
    axes.set_xlabel("cells", size=TEXT)
    axes.set_ylabel("milliseconds of processor time", size=TEXT)
    axes.set_title(title, size=TITLE, color=colours.ink, loc="left")
    dress(axes, colours)
    axes.grid(visible=True, color=colours.faint, linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=SMALL, labelcolor=colours.ink)
    return drawn
