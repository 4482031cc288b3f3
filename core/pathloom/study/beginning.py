"""Ablate and compare: studies from a few words."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from pathloom.config import ProblemSpec
from pathloom.kernel.planner import Planner
from pathloom.study.budget import Budget
from pathloom.study.carrying_out import carry_out
from pathloom.study.design import Design, ablation, comparison
from pathloom.study.instances import Maps, instances_of
from pathloom.study.session import Watch, Workers
from pathloom.study.study import Study


def ablate(
    base: str | Mapping[str, Any] | Planner,
    *,
    swap: Mapping[str, Sequence[Any]] | None = None,
    without: Sequence[str] = (),
    factorial: bool = False,
    add_one_in: bool = False,
    maps: Maps = (),
    scenarios: Sequence[str | Path] = (),
    cases: str | Sequence[int] = "all",
    start: Any = "bottom-left",
    goal: Any = "top-right",
    corners: str = "strict",
    radius: float = 0.0,
    runs: int = 30,
    seed: int = 0,
    budget: str | Budget = "evaluations",
    time_limit: float | None = None,
    out: str | Path | None = None,
    workers: int | None = None,
    dask: str | None = None,
    watch: Watch | None = None,
) -> Study:
    """Change one part of a planner at a time, and see what comes of it.

    Parameters
    ----------
    base
        A planner's name, a table as in a config, or a planner.
    swap
        By slot (``selection``) or parameter (``crossover.rate``), what takes its place.
    without
        Optional slots, members of a list or objectives that are left out.
    factorial
        All combinations instead of one change at a time.
    add_one_in
        Also the base without all of ``without`` at once, and with each alone of them.
    maps
        Names (``random-20:75:x10`` for ten), files, grids or problems.
    scenarios, cases
        Moving AI scenario files, and which lines of each, from 0.
    start, goal, corners, radius
        Of all maps; of scenarios the last two.
    runs, seed
        Runs of each variant on each instance, with the seeds from ``seed`` on.
    budget
        What every run may spend: ``evaluations`` (as many as the base does if it is
        let), ``evaluations=5000``, ``generations``, ``seconds=2``, or ``own`` for the
        limits that each variant brings.
    time_limit
        Seconds after which a run has to answer with the best it has.
    out
        The study's file; taken up where it stopped if it is there. Empty: in memory.
    workers, dask
        Processes on this machine (by default one a core), or the address of a Dask scheduler.
    watch
        Told how far it is.

    Raises
    ------
    PathloomError
        If anything asked for cannot be used; nothing is written then.
    """
    measure = Budget.parse(budget)
    variants, notes = ablation(
        base, swap=swap, without=without, factorial=factorial, add_one_in=add_one_in, budget=measure
    )
    spec = ProblemSpec(start=start, goal=goal, corners=corners, radius=radius)
    places = instances_of(maps, scenarios=scenarios, cases=cases, spec=spec)
    design = Design("ablate", variants, places, runs, seed, measure, time_limit, notes)
    return carry_out(design, out, workers=Workers(workers, dask), watch=watch)


def compare(
    planners: Iterable[str | Mapping[str, Any] | Planner] | Mapping[str, Any],
    *,
    maps: Maps = (),
    scenarios: Sequence[str | Path] = (),
    cases: str | Sequence[int] = "all",
    start: Any = "bottom-left",
    goal: Any = "top-right",
    corners: str = "strict",
    radius: float = 0.0,
    runs: int = 30,
    seed: int = 0,
    budget: str | Budget = "evaluations",
    time_limit: float | None = None,
    out: str | Path | None = None,
    workers: int | None = None,
    dask: str | None = None,
    watch: Watch | None = None,
) -> Study:
    """Hold planners against each other on the same maps, with the same seeds and the same budget.

    ``planners`` are names, tables or planners, or a mapping of names to them. The
    budget is by default the most evaluations that any of them spends if it is let.
    All else is as in `ablate`.
    """
    variants = comparison(planners)
    spec = ProblemSpec(start=start, goal=goal, corners=corners, radius=radius)
    places = instances_of(maps, scenarios=scenarios, cases=cases, spec=spec)
    design = Design("compare", variants, places, runs, seed, Budget.parse(budget), time_limit)
    return carry_out(design, out, workers=Workers(workers, dask), watch=watch)
