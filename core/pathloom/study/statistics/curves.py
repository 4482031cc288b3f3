"""Curves over runs: targets reached, performance profiles, bands of convergence."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pathloom.kernel.evaluation import Floats

TARGETS = (0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0)
"""Gaps to the optimum."""


@dataclass(frozen=True)
class Steps:
    """A share that rises in steps: ``shares[i]`` from ``at[i]`` on."""

    at: Floats
    shares: Floats


@dataclass(frozen=True)
class Band:
    """Quantiles over runs on a common grid; nan where the quantile has no answer yet."""

    evaluations: Floats
    low: Floats
    median: Floats
    high: Floats


def first_reached(evaluations: ArrayLike, values: ArrayLike, targets: ArrayLike) -> Floats:
    """Return after how many evaluations a run was first at or below each target (t,); inf where never.

    Parameters
    ----------
    evaluations, values
        (k,) when the answer changed, and what it cost from then on.
    """
    spent, best = np.asarray(evaluations, np.float64), np.asarray(values, np.float64)
    goals = np.asarray(targets, np.float64)
    if not len(spent):
        return np.full(len(goals), np.inf)
    lowest = np.minimum.accumulate(best)
    place = np.searchsorted(-lowest, -goals, side="left")  # the first that is not above the target
    return np.where(place < len(spent), spent[np.minimum(place, len(spent) - 1)], np.inf)


def ecdf(reached: ArrayLike) -> Steps:
    """Return the share of (run, target) pairs reached, over evaluations; inf among them counts as never.

    Source: N. Hansen et al. (2021), Optim. Methods Softw. 36, 114, section 5.2 (COCO).
    """
    found = np.asarray(reached, np.float64).ravel()
    at, counts = np.unique(found[np.isfinite(found)], return_counts=True)
    return Steps(at, np.cumsum(counts) / max(len(found), 1))


def performance_profile(names: Sequence[str], costs: Floats) -> dict[str, Steps]:
    """Return for each solver on which share of the instances it costs at most so many times the least cost.

    Source: E. D. Dolan, J. J. Moré (2002), Math. Program. 91, 201.

    Parameters
    ----------
    costs
        (instances, solvers), above 0; inf for a failure. Instances that nobody
        solves stay in the shares: no curve reaches 1 then.
    """
    best = costs.min(axis=1, keepdims=True)
    ratios = np.where(np.isfinite(costs), costs / np.where(np.isfinite(best), best, 1.0), np.inf)
    return {name: ecdf(column) for name, column in zip(names, ratios.T, strict=True)}


def band(
    runs: Iterable[tuple[ArrayLike, ArrayLike]],
    grid: ArrayLike,
    quantiles: tuple[float, float, float] = (0.25, 0.5, 0.75),
) -> Band:
    """Return quantiles over runs of the best value so far, on a common grid of evaluations.

    Parameters
    ----------
    runs
        (k,) evaluations at which the answer changed, and its cost from then on; a
        run without an answer yet counts as worse than any.
    grid
        (g,) evaluations.
    """
    at = np.asarray(grid, np.float64)
    lines = []
    for evaluations, values in runs:
        spent, best = np.asarray(evaluations, np.float64), np.asarray(values, np.float64)
        so_far = np.concatenate(([np.inf], np.minimum.accumulate(best) if len(best) else best))
        lines.append(so_far[np.searchsorted(spent, at, side="right")])
    if not lines:
        nothing = np.full(len(at), np.nan)
        return Band(at, nothing, nothing, nothing)
    ordered = np.sort(np.array(lines), axis=0)
    last = len(ordered) - 1
    # The worse of the two values beside each quantile: between an answer and none there is nothing.
    low, median, high = (ordered[int(np.ceil(q * last - 1e-9))] for q in quantiles)
    low, median, high = (np.where(np.isfinite(line), line, np.nan) for line in (low, median, high))
    return Band(at, low, median, high)


def common_grid(runs: Iterable[ArrayLike], most: int = 200) -> Floats:
    """Return at most so many evaluations from the first to the last of all runs, spread by their logarithm."""
    spent = [np.asarray(run, np.float64) for run in runs]
    every = np.concatenate(spent) if spent else np.empty(0)
    if not len(every):
        return np.empty(0)
    low, high = max(1.0, float(every.min())), max(1.0, float(every.max()))
    return np.unique(np.rint(np.geomspace(low, high, most)))


def reached_by_variant(
    histories: Iterable[tuple[str, float, ArrayLike, ArrayLike]], targets: Sequence[float] = TARGETS
) -> Mapping[str, Floats]:
    """Return for each variant (runs, targets) evaluations to gaps.

    Parameters
    ----------
    histories
        Variant, optimum of the instance, evaluations (k,) at which the answer
        changed, and its lengths (k,).
    """
    found: dict[str, list[Floats]] = {}
    for variant, optimum, evaluations, lengths in histories:
        goals = (1.0 + np.asarray(targets)) * optimum * (1.0 + 1e-9)
        found.setdefault(variant, []).append(first_reached(evaluations, lengths, goals))
    return {variant: np.array(reached) for variant, reached in found.items()}
