"""What each part of `loom` is worth: the planner with one part changed at a time, beside itself.

``python tests/benchmarks/loom_parts.py`` prints the table of plugins/pathloom_loom/README.md in
Markdown: mean and worst gap, share of runs without one, median milliseconds. Maps have seeds from 5000 on, which no test and no tuning has. For length the gap is to
the exact any-angle optimum, else to the best that any variant found with any seed. Times are
processor time, tables of the map included, as `any-angle`'s.
"""

import argparse
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

import pathloom as pl
from pathloom.bench.table import markdown
from pathloom.exact import any_angle_search
from pathloom.kernel.run import run

FROM = 5000
"""The first seed of the maps."""
TREES = {"use": "perturbed-trees", "spread": 0.5, "detour": 1.2}
PULLING, POOL = {"use": "loom/string-pulling"}, {"use": "loom/gene-pool"}
IMMIGRANTS, REROUTE = {"use": "random-immigrants", "sampling": TREES}, {"use": "reroute", "longest": 24}


def learning(*steps):
    return {"control": {"learning": {"steps": list(steps)}}}


def only(mutation):
    """One of the two mutations, as often as it is drawn otherwise."""
    return {"mutation": {"rate": 0.5, "parts": [mutation]}}


def ends(patience):
    return {"termination": [{"use": "max-generations", "limit": 50}, {"use": "stagnation", "patience": patience}]}


VARIANTS = {
    "`loom`": {},
    "without string pulling": learning(POOL),
    "without gene pool": learning(PULLING),
    "gene pool of the points alone (halo 0)": learning(PULLING, POOL | {"halo": 0}),
    "gene pool with halo 1": learning(PULLING, POOL | {"halo": 1}),
    "without band search": {"control": {"polish": "none"}},
    "band search on the best 5": {"control": {"elite": 5}},
    "without learning and band search": {"control": {"learning": "none", "polish": "none"}},
    "without crossover": {"crossover": "none"},
    "without re-routing": only(IMMIGRANTS),
    "without immigrants": only(REROUTE),
    "without any mutation": {"mutation": "none"},
    "neither crossover nor mutation": {"crossover": "none", "mutation": "none"},
    "one pair of trees": {"sampling": {"parts": [TREES, {"use": "scalarised", "vectors": 1, "work": 50_000}]}},
    "without the optimum of single steps": {"sampling": TREES | {"pairs": 2}},
    "first paths by median insertion": {"sampling": "imga/median-insertion"},
    "20 individuals": {"population": 20},
    "80 individuals": {"population": 80},
    "patience 1": ends(1),
    "patience 5": ends(5),
    "patience 10": ends(10),
    "band search on the best 5, patience 5": {"control": {"elite": 5}} | ends(5),
}


class Group(NamedTuple):
    """Maps, and what is minimised on them."""

    name: str
    maps: tuple[str, ...]
    objectives: dict[str, float]


LENGTH = {"length": 1.0}
ADDITIVE = {"length": 1.0, "unsafe-cells": 1.0, "turns": 1.0}
OTHER = {"length": 1.0, "clearance": 10.0, "turn-angle": 1.0}
SMALL = tuple(f"random-20:{density}%" for density in (10, 20, 30, 40))
MIDDLE = ("random-50:20%", "random-50:30%", "random-50:40%")
LARGE = ("rooms-100", "rooms-200", "maze-101", "maze-201")
MANY = ("random-20:20%", "random-20:30%", "random-50:20%", "random-50:30%", "rooms-100")


def groups(n: int) -> Iterator[tuple[Group, int]]:
    """Yield the groups with the number of maps of each family."""
    yield Group("length, 20 × 20", SMALL, LENGTH), n
    yield Group("length, 50 × 50", MIDDLE, LENGTH), max(1, n // 2)
    yield Group("length, rooms and mazes of 100 and 200", LARGE, LENGTH), max(1, n // 5)
    yield Group("length + unsafe cells + turns", MANY, ADDITIVE), max(1, n // 2)
    yield Group("length + 10 clearance + turn angle", MANY, OTHER), max(1, n // 2)


class Measured(NamedTuple):
    """A run: the weighted sum, and milliseconds."""

    total: float
    ms: float


def measured(planner, problem, seed) -> Measured:
    began = time.process_time()
    fresh = replace(problem)
    solution = run(fresh, planner, seed).outcome.solution if fresh.reachable else None
    ms = 1000 * (time.process_time() - began)
    if solution is None:
        return Measured(np.inf, ms)
    assert pl.validate(problem.representation.decode(solution), problem) is None
    values, _ = planner.fitness_of(solution, problem)
    return Measured(sum(term.weight * values[term.label] for term in planner.objectives), ms)


EXACT = "exact search, `any-angle`"


def cells(group: Group, n: int, seeds: int) -> dict[str, str]:
    """Return for each variant what a table says of it."""
    names = list(VARIANTS)
    planners = [pl.compose("loom", objectives=group.objectives, **VARIANTS[name]) for name in names]
    corners = ("strict", "allow", "no-squeeze")
    problems = []
    for family in group.maps:
        for k in range(n):
            policy = corners[k % 3]
            map_ = pl.load_map(f"{family}:s{FROM + k}", corners=policy)
            problems.append(pl.PathProblem(map_, corners=policy))
    for planner in planners:
        measured(planner, problems[0], 0)  # loads the kernels
    gaps = np.empty((len(problems), seeds, len(names)))
    ms = np.empty_like(gaps)
    exact = []
    for k, problem in enumerate(problems):
        runs = [[measured(planner, problem, seed) for planner in planners] for seed in range(seeds)]
        totals = np.array([[one.total for one in row] for row in runs])
        least = totals.min()
        if group.objectives == LENGTH:
            fresh = replace(problem)
            began = time.process_time()
            known = any_angle_search(fresh)
            exact.append(1000 * (time.process_time() - began))
            assert known.proven
            least = known.length
        gaps[k] = totals / least - 1.0
        ms[k] = [[one.ms for one in row] for row in runs]
    gaps[np.abs(gaps) < 1e-12] = 0.0
    said = {name: cell(gaps[:, :, k], ms[:, :, k]) for k, name in enumerate(names)}
    return said | {EXACT: cell(np.zeros(len(exact)), np.array(exact)) if exact else ""}


def cell(gaps, ms) -> str:
    found = gaps[np.isfinite(gaps)]
    failed = f"; {gaps.size - found.size} of {gaps.size} found nothing" if found.size < gaps.size else ""
    shares = f"{100 * found.mean():.4f} % · {100 * found.max():.2f} %"
    return f"{shares} · {100 * (gaps == 0).mean():.0f} % · {np.median(ms):.1f}{failed}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--maps", type=int, default=30, help="maps of each family of 20 × 20; fewer of the others")
    parser.add_argument("--seeds", type=int, default=2, help="runs on each map")
    chosen = parser.parse_args()
    tables = []
    for group, n in groups(chosen.maps):
        print(f"{group.name}: {', '.join(group.maps)}; {n} maps each, {chosen.seeds} seeds", file=sys.stderr)
        tables.append(cells(group, n, chosen.seeds))
    heads = ("variant", *(group.name for group, _ in groups(chosen.maps)))
    print(markdown(heads, [(name, *(table[name] for table in tables)) for name in (EXACT, *VARIANTS)]))


if __name__ == "__main__":
    main()
