"""Several planners on the same maps with the same seeds, and what a table says of them."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import compress

import numpy as np
from numpy.typing import NDArray

from pathloom import Bench, Finding, Floats, Result
from pathloom.claims import Comparison, smaller, verdict
from pathloom.kernel.planner import Planner
from pathloom_agacd.objectives import NeighbourPenaltyOnce

SMALL = tuple(f"random-20:{75 if k < 5 else 102}:s{k}" for k in range(10))
LARGE = tuple(f"random-50:20%:s{k}" for k in range(6))

Runs = dict[str, list[Result]]
"""Runs by planner, one list as long as the other; the planner that the paper proposes stands first."""


@dataclass(frozen=True)
class Quantity:
    """What runs are compared by."""

    of: Callable[[Result], float | None]
    better: str
    """What the better one of two runs is called."""
    larger: bool = False
    """Whether the larger value is the better one."""
    digits: int = 2
    timed: bool = False

    def values(self, runs: list[Result]) -> Floats:
        """Return the value of every run."""
        return np.array([self.of(r) for r in runs], np.float64)

    def lead(self, first: list[Result], second: list[Result]) -> Comparison:
        """Return how far the first runs are better than the second."""
        a, b = self.values(first), self.values(second)
        return smaller((-a).tolist(), (-b).tolist()) if self.larger else smaller(a.tolist(), b.tolist())

    def said(self, numbers: Mapping[str, float]) -> str:
        """Say a number of each planner."""
        return ", ".join(f"{name} {number:.{self.digits}f}" for name, number in numbers.items())


def _safety_along(run: Result) -> float:
    assert run.path is not None, "comparable runs found a path"
    assert run.path_problem is not None, "they come from a bench"
    row = run.path_problem.representation.encode([run.path])
    return float(NeighbourPenaltyOnce(of="cells").measure(row, run.path_problem)[0])


FITNESS = Quantity(lambda r: r.fitness, "fitter", larger=True, digits=3)
UNREFINED = Quantity(lambda r: float(r.history["best"][-1]), "fitter", larger=True, digits=3)
CONVERGENCE = Quantity(lambda r: r.convergence, "earlier", digits=0)
SECONDS = Quantity(lambda r: float(r.budget["seconds"]), "faster", digits=3, timed=True)
LENGTH = Quantity(lambda r: r.objectives["length"], "shorter")
SMOOTHNESS = Quantity(lambda r: r.objectives["smoothness"], "smoother")
SAFETY = Quantity(lambda r: r.objectives["safety"], "safer")
SAFETY_ALONG = Quantity(_safety_along, "safer")
"""With the obstacles beside every cell that a path passes, not only beside its points."""


def tried(bench: Bench, planners: Mapping[str, str | Planner], maps: Iterable[str], seeds: int) -> Runs:
    """Return the runs of all planners on all maps with as many seeds."""
    problems = [bench.problem(name) for name in maps]
    return {name: [r for p in problems for r in bench.runs(planner, p, seeds)] for name, planner in planners.items()}


def comparable(runs: Runs) -> Runs:
    """Return the runs on those maps with those seeds with which every planner found a path."""
    found = [all(r.found for r in together) for together in zip(*runs.values(), strict=True)]
    return {name: list(compress(of, found)) for name, of in runs.items()}


def only(runs: Runs, *names: str) -> Runs:
    """Return the runs of these planners, in this order."""
    return {name: runs[name] for name in names}


def extent(runs: Runs) -> str:
    """Say how many runs of each planner are compared."""
    maps = _maps(runs)
    return f"{len(maps)} runs each on {len(set(maps))} maps"


def averages(place: str, says: str, runs: Runs, quantity: Quantity, *more: str) -> Finding:
    """Return whether the first planner is better on average than each other one, and not by chance."""
    (name, first), *others = runs.items()
    means = quantity.said({name: float(quantity.values(of).mean()) for name, of in runs.items()})
    leads = {other: quantity.lead(first, of) for other, of in others}
    ahead = [f"{name} {quantity.better} than {other} in {lead}" for other, lead in leads.items()]
    result = verdict(False, all(lead.p < 0.05 for lead in leads.values()))
    return Finding(place, says, "; ".join((means, *ahead, *more)), result, quantity.timed)


def wins(place: str, says: str, runs: Runs, quantity: Quantity, shares: Mapping[str, float]) -> Finding:
    """Return whether the first planner is better than others in at least these shares of its runs."""
    (name, first), *_ = runs.items()
    leads = {other: quantity.lead(first, runs[other]) for other in shares}
    measured = f"{quantity.better} than " + ", than ".join(f"{other} in {lead}" for other, lead in leads.items())
    won = {other: lead.wins / lead.pairs for other, lead in leads.items()}
    result = verdict(all(won[other] >= shares[other] for other in shares), all(share > 0.5 for share in won.values()))
    return Finding(place, says, f"{name} {measured}", result, quantity.timed)


def spreads(place: str, says: str, runs: Runs, quantity: Quantity, ordered: Callable[[list[float]], bool]) -> Finding:
    """Return how far runs on one map differ, and whether that is ordered as it should be."""
    found = {name: _spread(quantity.values(of), _maps(runs)) for name, of in runs.items()}
    measured = f"{quantity.said(found)} for the runs on one map"
    return Finding(place, says, measured, verdict(False, ordered(list(found.values()))), quantity.timed)


def extremes(place: str, says: str, runs: Runs, other: str) -> Finding:
    """Return whether the first planner's best and worst runs beat another one's, on at least nine maps of ten."""
    (_, first), *_ = runs.items()
    maps = _maps(runs)
    mine, theirs = ([FITNESS.values(of)[maps == m] for m in np.unique(maps)] for of in (first, runs[other]))
    best, worst = (
        sum(end(a) > end(b) for a, b in zip(mine, theirs, strict=True)) for end in (np.max, np.min)
    )  # fmt: skip
    measured = (
        f"best {max(a.max() for a in mine):.3f} against {max(b.max() for b in theirs):.3f}; "
        f"of {len(mine)} maps the best is better on {best}, the worst on {worst}"
    )
    return Finding(place, says, measured, verdict(False, min(best, worst) >= 0.9 * len(mine)))


def overtaken(runs: Runs, other: str) -> str:
    """Say from when on the first planner was past the final fitness of another one."""
    (_, first), *_ = runs.items()
    when = [
        next((k for k, fitness in enumerate(a.history["best"]) if fitness > b.history["best"][-1]), None)
        for a, b in zip(first, runs[other], strict=True)
    ]
    known = [k for k in when if k is not None]
    return f"past the final fitness of {other} at generation {np.median(known):.0f} (median of {len(known)})"


def sampling_shares(runs: Runs) -> tuple[dict[str, float], str]:
    """Return the share of the time that each planner's first population takes, and say it; medians."""
    shares, said = {}, []
    for name, of in runs.items():
        first = np.array([r.budget["phases"]["sampling"] for r in of])
        both = first + [r.budget["phases"]["evolution"] for r in of]
        shares[name] = float(np.median(first / both))
        said.append(f"{name} {np.median(first):.4f} of {np.median(both):.3f} s, {100 * shares[name]:.1f} %")
    return shares, "; ".join(said)


def _maps(runs: Runs) -> NDArray[np.str_]:
    """Return the name of the map of each run."""
    return np.array([r.problem["map"] for r in next(iter(runs.values()))])


def _spread(values: Floats, maps: NDArray[np.str_]) -> float:
    """Return the standard deviation of the values on one map, pooled over maps."""
    groups = [values[maps == m] for m in np.unique(maps)]
    return float(np.sqrt(sum(len(g) * g.var() for g in groups) / (len(values) - len(groups))))
