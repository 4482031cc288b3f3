"""Section 3: what the paper says of coding and operators, to be measured again."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np

from pathloom import Bench, Claim, Finding, PathProblem, compiled
from pathloom.claims import smaller, verdict
from pathloom.kernel.counting import counting
from pathloom.paths.collision import Exact
from pathloom.paths.loops import LoopRemoval
from pathloom.paths.numbering import Numbering
from pathloom_iga.claims import OURS, at_random, generations, lengths
from pathloom_iga.collision import LineDistance
from pathloom_iga.mutation import TwoPointMidpoint
from pathloom_iga.probability import SincAdaptive
from pathloom_iga.sampling import RowWise

EXAMPLE = (1, 12, 23, 36, 47, 59, 70, 80)
"""The individual of fig. 2."""
AS_PRINTED = {
    "use": OURS,
    "repair": {"steps": ["loop-removal", {"use": "triplet-point-deletion", "collision": "line-distance"}]},
}
"""Points deleted by eq. (11) as printed."""


@dataclass(frozen=True, kw_only=True)
class Section31(Claim):
    """Numbers of cells."""

    source: ClassVar[str] = "Liu et al. 2024, section 3.1, eq. (1)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        G = 10
        N = np.arange(1, G * G + 1)
        cells = Numbering(G, G).cells(N)
        x, y = G - cells[:, 0], cells[:, 1] + 1  # the row from the bottom, the column
        agree = {
            "N": (x - 1) * G + (y - 1) == N,
            "x": (N - 1 / G).astype(int) + 1 == x,
            "y": np.mod(N - 1 / G, G) + 1 == y,
        }
        yield Finding(
            "eq. (1)",
            "N = (x − 1) G + (y − 1), x = int(N − 1 / G) + 1, y = mod(N − 1 / G) + 1, with number 1 at the bottom left",
            f"right for {', '.join(f'{right.sum()} of 100 {name}' for name, right in agree.items())}; "
            "N = (x − 1) G + y and its inverse are meant",
            verdict(all(right.all() for right in agree.values())),
        )


@dataclass(frozen=True, kw_only=True)
class Section32(Claim):
    """First individuals by midpoint interpolation."""

    source: ClassVar[str] = "Liu et al. 2024, section 3.2, fig. 2, eqs. (2) to (4)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        problem = bench.problem("iga-map1")
        occupied = problem.context.occupied
        cells = Numbering(10, 10).cells(EXAMPLE)
        upright, upside_down = (int(occupied[rows, cells[:, 1]].sum()) for rows in (cells[:, 0], 9 - cells[:, 0]))
        yield Finding(
            "fig. 2",
            f"the individual {', '.join(map(str, EXAMPLE))} on map 1 stands on free cells",
            f"{upright} of its cells on obstacles if row 1 is the last line of the matrix, {upside_down} if it is the "
            "first",
            verdict(upright == 0),
        )
        shares = []
        for source in ("iga-map1", "random-20:75"):
            problem = bench.problem(source)
            shares.append(np.mean([_free(problem, np.random.default_rng(seed)) for seed in range(1000)]))
        yield Finding(
            "section 3.2",
            "midpoint interpolation keeps first individuals from crossing obstacles",
            f"as printed, {100 * shares[0]:.1f} % of 1000 individuals are free of obstacles on map 1, "
            f"{100 * shares[1]:.1f} % on random-20:75; a midpoint in an obstacle needs a rule",
            verdict(min(shares) == 1),
        )


def _free(problem: PathProblem, rng: np.random.Generator) -> bool:
    """Draw an individual by eqs. (2) to (4) with no rule for obstacles; say whether it avoids them."""
    occupied = problem.context.occupied[::-1]  # row 0 at the bottom, as in the paper
    last = len(occupied) - 1
    drawn = [(r, int(rng.choice(np.flatnonzero(~occupied[r])))) for r in range(1, last)]
    way = [(0, 0), *drawn, (last, last)]
    return all(_clear(a, b, occupied) for a, b in pairwise(way))


def _clear(a: tuple[int, int], b: tuple[int, int], occupied: np.ndarray) -> bool:
    if max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= 1:
        return True
    middle = (a[0] + b[0]) // 2, (a[1] + b[1]) // 2
    return not occupied[middle] and _clear(a, middle, occupied) and _clear(middle, b, occupied)


@dataclass(frozen=True, kw_only=True)
class Section33(Claim):
    """The large constant of the fitness."""

    source: ClassVar[str] = "Liu et al. 2024, section 3.3, eq. (5)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        small, large = at_random(bench, OURS), at_random(bench, {"use": OURS, "fitness": {"constant": 10.0}})
        distinct = [[100 * float(np.mean(r.history["diversity"])) for r in runs] for runs in (small, large)]
        lead = smaller(*distinct)
        ratio = [(1 / 28 + C) / (1 / 50 + C) for C in (0, 0.01, 10)]
        yield Finding(
            "section 3.3",
            "C, a large positive number, keeps the diversity",
            f"{np.mean(distinct[1]):.0f} % distinct individuals with C = 10, {np.mean(distinct[0]):.0f} % with 0.01, "
            f"more in {lead}; but {np.mean(generations(large)):.1f} generations to the best instead of "
            f"{np.mean(generations(small)):.1f}: a path of 28 is selected {ratio[2]:.3f} times as often as one of 50, "
            f"{ratio[1]:.2f} with 0.01, {ratio[0]:.2f} with 0",
            verdict(lead.p < 0.05),
        )


@dataclass(frozen=True, kw_only=True)
class Section34(Claim):
    """Adaptive probabilities and mutation between two points."""

    source: ClassVar[str] = "Liu et al. 2024, section 3.4, eqs. (6) to (10)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        low, high = 0.5, 0.8
        fitness = 1 / np.random.default_rng(0).uniform(28, 50, 300) + 0.01
        rates = SincAdaptive(low=low, high=high).rates(fitness, 0.0)
        above = fitness >= fitness.mean()
        falls = bool((np.diff(rates[above][np.argsort(fitness[above])]) <= 1e-12).all())
        yield Finding(
            "section 3.4, eqs. (6) to (10)",
            "the probability is P_max below the mean, falls from there, and is P_min for the fittest",
            f"300 lengths from 28 to 50, P in [0.5, 0.8]: {rates[~above].min():.2f} below the mean, "
            f"{rates[above].max():.3f} just above it, a jump of f_avg / f_max; {rates.min():.2f} for the fittest",
            verdict(falls and rates[~above].min() == high and rates.min() == rates[np.argmax(fitness)] == low),
        )
        problem, rng = bench.problem("random-20:75"), np.random.default_rng(0)
        paths = RowWise().sample(problem, 1000, rng)
        with counting() as counts:
            TwoPointMidpoint().apply(paths, np.arange(len(paths)), problem, rng)
        failed = counts.get("mutation failed", 0)
        yield Finding(
            "section 3.4.3",
            "mutation by midpoint interpolation does not end in infeasible paths, as that of a random gene does",
            f"{failed} of {len(paths)} paths found no mutant; where one gene becomes a random free cell "
            f"{_infeasible(problem, paths, rng)} of {len(paths)} collide; random-20:75",
            verdict(failed == 0, failed < 100),
        )


def _infeasible(problem: PathProblem, paths: np.ndarray, rng: np.random.Generator) -> int:
    """Return how many paths collide after one of their inner cells has become any free cell."""
    cols = problem.context.cols
    free = np.flatnonzero(~problem.context.occupied.ravel())
    k = np.arange(len(paths))
    gene = rng.integers(1, (paths >= 0).sum(axis=1) - 1)
    mutant = np.stack(divmod(rng.choice(free, len(paths)), cols), axis=1)
    ok = np.ones(len(paths), bool)
    for neighbour in (gene - 1, gene + 1):
        other = np.stack(divmod(paths[k, neighbour], cols), axis=1)
        ok &= Exact().segments_free(mutant, other, problem)
    return int((~ok).sum())


@dataclass(frozen=True, kw_only=True)
class Section35(Claim):
    """Loops."""

    source: ClassVar[str] = "Liu et al. 2024, section 3.5"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        problem, rng = bench.problem("random-20:75"), np.random.default_rng(0)
        paths = RowWise(loops=True).sample(problem, 1000, rng)
        cols = problem.context.cols
        before = compiled.measures.lengths(paths, cols)
        after = compiled.measures.lengths(LoopRemoval().apply(paths, problem, rng), cols)
        yield Finding(
            "section 3.5",
            "paths go round in circles; cutting that out shortens them",
            f"{100 * np.mean(after < before - 1e-9):.0f} % of 1000 first paths do (random-20:75); without their loops "
            f"they are {100 * (1 - after.sum() / before.sum()):.0f} % shorter, and none longer",
            verdict(np.mean(after < before - 1e-9) > 0 and bool((after <= before + 1e-9).all())),
        )


@dataclass(frozen=True, kw_only=True)
class Equation11(Claim):
    """The test of a line by the distance of obstacles."""

    source: ClassVar[str] = "Liu et al. 2024, section 3.6, eq. (11)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        rng, missed, refused = np.random.default_rng(0), 0, []
        for obstacles in (40, 80, 120, 160):
            problem = bench.problem(f"random-20:{obstacles}")
            free = np.argwhere(~problem.context.occupied)
            a, b = free[rng.integers(len(free), size=(2, 4000))]
            apart = np.abs(a - b).max(axis=1)
            a, b = a[(apart >= 2) & (apart <= 6)], b[(apart >= 2) & (apart <= 6)]
            passed, truly = LineDistance().segments_free(a, b, problem), Exact().segments_free(a, b, problem)
            missed += int((passed & ~truly).sum())
            refused.append(100 * float(1 - passed[truly].mean()))
        yield Finding(
            "eq. (11)",
            "a line passes through an obstacle whose centre is nearer to it than √2, and otherwise does not",
            f"no obstacle is overlooked ({missed}), but {', '.join(f'{share:.0f}' for share in refused)} % of the free "
            "segments between cells 2 to 6 apart are refused with 10, 20, 30, 40 % of obstacles",
            verdict(missed == 0 and max(refused) == 0),
        )
        runs = bench.runs(AS_PRINTED, bench.problem("iga-map1"), bench.seeds(20, 2))
        yield Finding(
            "eq. (11)",
            "with it the best path of map 1 is 13.8",
            f"{min(lengths(runs)):.4f} in the best of {len(runs)} runs; half a cell's diagonal, √½ = "
            f"{math.sqrt(0.5):.3f}, would give 13.8639, the exact test gives 13.7901",
            verdict(round(min(lengths(runs)), 1) == 13.8),
        )
