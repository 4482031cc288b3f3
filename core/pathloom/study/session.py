"""Session: one sitting of work on a study. It sends orders out, and writes down what comes back."""

import contextlib
import json
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from types import TracebackType
from typing import Any, Self

import numpy as np

from pathloom.errors import ConfigError
from pathloom.fronts import hypervolume, non_dominated, reference_point
from pathloom.kernel.planner import Planner
from pathloom.planning import gap_to
from pathloom.study.errors import StudyError
from pathloom.study.execute import LONGEST, Answer, execute
from pathloom.study.lanes import DaskLane, Lane, LocalLane
from pathloom.study.store import Finished, Key, References, Store, unpacked
from pathloom.study.worker import Order, Reply, environment, part

WITHIN = 0.01
"""How near to the optimum ``evaluations_to_one_percent`` asks for."""
LEAST_MEMORY = 4 << 30
"""Address space that a worker may always have, in bytes."""

Watch = Callable[["Pace", str], None]
"""Told after every few runs how far the study is, and what is being done."""


class Pace:
    """How fast a study goes, and how long it will take."""

    def __init__(self, total: int, done: int) -> None:
        self.total, self.done, self.before = total, done, done
        self.began = time.monotonic()

    @property
    def rate(self) -> float:
        """Runs a second, since it began."""
        return (self.done - self.before) / max(time.monotonic() - self.began, 1e-9)

    @property
    def remaining(self) -> float | None:
        """Seconds that are left at this rate; ``None`` before anything is done."""
        return (self.total - self.done) / self.rate if self.done > self.before else None


@dataclass(frozen=True)
class Workers:
    """Who carries a study out."""

    count: int | None = None
    """Processes on this machine; by default one for each core."""
    dask: str | None = None
    """Address of a Dask scheduler, instead."""
    memory: int | None = None
    """Bytes of address space for each process; by default its share of the machine's memory, at least 4 GiB."""
    longest: float = LONGEST
    """Seconds after which a run is ended that has no time limit."""
    grace: float = 30.0
    """Seconds that a run has to stop by itself when its time limit is over, before it is ended."""

    def __post_init__(self) -> None:
        if self.count is not None and (
            isinstance(self.count, bool) or not isinstance(self.count, int) or self.count < 1
        ):
            raise ConfigError(f"workers: found {self.count!r}, allowed a whole number from 1")


class Crew:
    """The lanes of a session, begun when they are needed, and all ended with it."""

    def __init__(self, workers: Workers, configs: Iterable[Any]) -> None:
        self.workers = workers
        self._configs = configs
        self._lanes: list[Lane] = []

    def lanes(self, orders: int) -> list[Lane]:
        """Return lanes for so many orders: on this machine no more than that, and no more than there are cores."""
        if self.workers.dask is not None:
            self._lanes = self._lanes or [DaskLane(self.workers.dask, environment(self._configs))]
            return self._lanes
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        count = self.workers.count or cores
        wanted = max(1, min(count, orders))
        memory = self.workers.memory or _share_of_memory(count)
        self._lanes += [LocalLane(memory) for _ in range(len(self._lanes), wanted)]
        return self._lanes[:wanted]

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for lane in self._lanes:
            lane.stop()


def _share_of_memory(workers: int) -> int | None:
    with contextlib.suppress(AttributeError, ValueError, OSError):
        return max(LEAST_MEMORY, os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // workers)
    return None


def check_versions(store: Store, facts: Mapping[str, Any], *, mixed: bool) -> None:
    """Refuse to add runs of other versions than those that a study began with, unless they may be mixed."""
    began, here = facts["versions"], environment(store.configs().values())
    names = ("pathloom", "python", "numpy", "numba")
    was = {**{name: began.get(name) for name in names}, **began["plugins"]}
    now = {**{name: here[name] for name in names}, **here["plugins"]}
    for name, version in was.items():
        if now.get(name) != version and not mixed:
            raise StudyError(
                f"{store.name}: began with {name} {version}, found {now.get(name, 'none')} here; results may differ: "
                "--mixed goes on all the same"
            )
    store.environment(here)


class Session:
    """One sitting of work on a study."""

    def __init__(
        self, store: Store, planner: Callable[[str], Planner], crew: Crew, watch: Watch | None,
        check: Callable[[], None],
    ) -> None:  # fmt: skip
        self.store, self.planner, self.crew, self.watch, self.check = store, planner, crew, watch, check
        self.facts = store.facts()
        self.variants, self.instances = store.variant_ids(), store.instance_ids()
        salt = self.facts["id"]  # workers of a cluster outlive a study
        self.names = {f"{salt}/planner/{n}": name for name, n in self.variants.items()}
        self.names |= {f"{salt}/problem/{n}": name for name, n in self.instances.items()}
        self.keys = {(key.split("/")[1], name): key for key, name in self.names.items()}
        self.pace = Pace(len(self.variants) * len(self.instances) * self.facts["runs"], store.count())
        self._references = lru_cache(maxsize=64)(store.references)
        self._part = lru_cache(maxsize=64)(self._made)

    def work(self) -> None:
        """Do all that is left to do."""
        self.measure_instances(self.store.unmeasured())
        self.run()
        self.measure_fronts()

    def _made(self, key: str) -> bytes:
        """Return a planner or a problem as workers take it."""
        name = self.names[key]
        return part(self.planner(name) if "/planner/" in key else self.store.problem(name))

    def _execute(self, orders: Iterable[Order], count: int, record: Callable[[Sequence[Answer]], None]) -> None:
        if count > 0:
            execute(
                orders, self.crew.lanes(count), parts=self._part, record=record, check=self.check,
                longest=self.crew.workers.longest, grace=self.crew.workers.grace,
            )  # fmt: skip

    def measure_instances(self, names: Sequence[str]) -> None:
        """Look for the exact optima of instances."""
        first = next(iter(self.variants))
        planner = self.keys["planner", first] if self.facts["front"] else ""
        pace = Pace(len(names), 0)

        def record(answers: Sequence[Answer]) -> None:
            for order, reply, _ in answers:
                found = reply.references or References(note=str(reply.measures.get("error")))
                self.store.set_references(self.names[order.instance], found)
            pace.done += len(answers)
            self._tell(pace, "exact optima")

        orders = (Order("references", planner, self.keys["problem", name]) for name in names)
        self._execute(orders, len(names), record)

    def run(self) -> None:
        """Carry out the runs that are missing."""
        self._execute(self._missing(), self.pace.total - self.pace.done, self._record)

    def _missing(self) -> Iterator[Order]:
        facts = self.facts
        for instance, number in self.instances.items():
            done = self.store.done(number)
            for seed in range(facts["seed"], facts["seed"] + facts["runs"]):
                for variant, n in self.variants.items():
                    if (seed, n) not in done:
                        keys = self.keys["planner", variant], self.keys["problem", instance]
                        yield Order("run", *keys, seed, facts["time_limit"])

    def _record(self, answers: Sequence[Answer]) -> None:
        self.store.write([self._finished(*answer) for answer in answers])
        self.pace.done += len(answers)
        self._tell(self.pace, "runs")

    def _tell(self, pace: Pace, what: str) -> None:
        if self.watch is not None:
            self.watch(pace, what)

    def _finished(self, order: Order, reply: Reply, attempts: int) -> Finished:
        instance, variant = (int(key.rpartition("/")[2]) for key in (order.instance, order.variant))
        known: References = self._references(instance)
        measures = dict(reply.measures)
        trajectory = measures.pop("trajectory", None)
        length = measures.get("length")
        for name in ("phases", "objectives", "counts"):
            if measures.get(name) is not None:
                measures[name] = json.dumps(_sayable(measures[name]))
        measures |= {
            "gap_grid": gap_to(length, known.grid),
            "gap_any_angle": gap_to(length, known.any_angle),
            "gap_bound": gap_to(length, known.any_angle_bound),
            "evaluations_to_one_percent": _when_near(trajectory, known.any_angle_bound),
            "attempts": attempts,
        }
        return Finished(Key(instance, order.seed, variant), measures, reply.history, reply.path, reply.front)

    def measure_fronts(self) -> None:
        """Measure all fronts of an instance up to one reference point, which takes all of them, or the exact one."""
        for number in self.instances.values():
            fronts = {run: np.array(unpacked(blob)["values"], np.float64) for run, blob in self.store.fronts(number)}
            if not fronts:
                continue
            exact = self.store.references(number).exact_front
            best = np.array(unpacked(exact), np.float64) if exact else non_dominated(np.concatenate([*fronts.values()]))
            corner = reference_point(best)
            whole = hypervolume(best, corner)
            volumes = {run: hypervolume(values, corner) for run, values in fronts.items()}
            ratios = {run: (volume, volume / whole if whole > 0 else None) for run, volume in volumes.items()}
            self.store.set_hypervolumes(number, corner.tolist(), ratios)


def _sayable(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values without those that JSON cannot say."""
    return {k: v if not isinstance(v, float) or np.isfinite(v) else None for k, v in values.items()}


def _when_near(trajectory: Mapping[str, Sequence[Any]] | None, optimum: float | None) -> int | None:
    """Return the evaluations after which the answer was first within a percent of the optimum."""
    if trajectory is None or optimum is None:
        return None
    pairs = zip(trajectory["answer_evaluations"], trajectory["answer_lengths"], strict=True)
    return next((spent for spent, length in pairs if length is not None and length <= (1.0 + WITHIN) * optimum), None)
