"""Verifying: run a random sample of a bundle again, and compare what comes of it byte for byte."""

import json
import math
import random
import secrets
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from pathloom.errors import ConfigError, PathloomError
from pathloom.files import FilePath, one_line
from pathloom.planning import gap_to
from pathloom.study.bundle.opening import opened, unzipped
from pathloom.study.errors import StudyError
from pathloom.study.execute import Answer, execute
from pathloom.study.session import Crew, Pace, Watch, Workers
from pathloom.study.store import MEASURES, References, Store
from pathloom.study.study import Study
from pathloom.study.worker import Order, Reply, environment, part

NOT_COMPARED = ("seconds", "phases", "attempts", "error", "hypervolume", "hypervolume_ratio",
                "evaluations_to_one_percent")  # fmt: skip
"""What a clock or an address may change, and what takes all fronts of a study."""
REPEATABLE = ("found", "not-found", "unreachable", "failed")
"""Ends of runs that do not depend on the machine."""
JSON = ("objectives", "counts")
LONGEST = 600.0
"""Seconds after which a run is ended."""


@dataclass(frozen=True)
class Check:
    """A run that was made again."""

    variant: str
    map: str
    seed: int
    differs: tuple[str, ...]
    """What is not as it was: ``status``, ``path``, ``history``, names of metrics, ``optimum``; empty if all is."""

    @property
    def same(self) -> bool:
        """Whether all is as it was."""
        return not self.differs


@dataclass(frozen=True)
class Verification:
    """What came of a check."""

    checks: tuple[Check, ...]
    runs: int
    """Runs of the bundle."""
    repeatable: int
    """Runs among them that can be compared."""
    notes: tuple[str, ...]
    """What may explain differences."""

    @property
    def same(self) -> bool:
        """Whether every run of the sample is as it was."""
        return all(check.same for check in self.checks)


class _Sampled(NamedTuple):
    variant: str
    instance: str
    seed: int
    measures: Mapping[str, Any]
    history: bytes | None
    path: bytes | None
    known: References


def verify(
    path: FilePath,
    *,
    sample: int = 10,
    seed: int | None = None,
    workers: Workers | None = None,
    watch: Watch | None = None,
    check: Callable[[], None] = lambda: None,
) -> Verification:
    """Run a random sample of a bundle's runs again, and compare paths, metrics and histories byte for byte.

    Parameters
    ----------
    sample
        Runs.
    seed
        Which sample; by default another one each time.
    workers, watch, check
        As in `carry_out`.

    Raises
    ------
    StudyError
        If it is no bundle, or a part of it is damaged, too large, or not installed here.
    """
    if isinstance(sample, bool) or not isinstance(sample, int) or sample < 1:
        raise ConfigError(f"sample: found {sample!r}, allowed a whole number from 1")
    with opened(path) as (file, _):
        try:
            with Study(store := Store(file)) as study:
                return _verified(study, store, sample, seed, workers or Workers(longest=LONGEST), watch, check)
        except StudyError as error:
            raise StudyError(str(error).replace(str(file), str(path))) from error
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError, OverflowError, PathloomError) as error:
            said = one_line(f"{type(error).__name__}: {error}")
            raise StudyError(f"{path}: study.db: found what no study holds ({said})") from error


def _verified(
    study: Study, store: Store, sample: int, seed: int | None, workers: Workers, watch: Watch | None,
    check: Callable[[], None],
) -> Verification:  # fmt: skip
    keys = list(
        store.reading(
            "SELECT v.name, i.name, r.seed, r.id FROM runs r JOIN variants v ON v.id = r.variant "  # noqa: S608 - ours
            f"JOIN instances i ON i.id = r.instance WHERE r.status IN {REPEATABLE} "
            "ORDER BY r.instance, r.seed, r.variant"
        )
    )
    drawn = sorted(random.Random(seed).sample(range(len(keys)), min(sample, len(keys))))  # noqa: S311 - no secret
    chosen = [_sampled(store, study, *keys[i]) for i in drawn]
    checks = _made_again(study, chosen, workers, watch, check)
    return Verification(tuple(checks), len(study), len(keys), tuple(_notes(study, len(keys))))


def _notes(study: Study, repeatable: int) -> Iterator[str]:
    here = environment(study.variants.values())
    for there in study.versions:
        for name in ("pathloom", "python", "numpy", "numba", "plugins", "platform"):
            if there.get(name) != here[name]:
                yield f"made with {name} {there.get(name)}, checked with {here[name]}"
    if study.budget.of == "seconds" or study.facts["time_limit"] is not None:
        yield "runs were limited in time, so that results depend on the machine"
    if repeatable < len(study):
        yield f"{len(study) - repeatable} runs that were ended or took their process with them are not compared"


def _sampled(store: Store, study: Study, variant: Any, instance: Any, seed: Any, run: int) -> _Sampled:
    if not isinstance(seed, int) or seed < 0 or not isinstance(variant, str) or not isinstance(instance, str):
        raise ValueError("a run without variant, map or seed")
    [row] = store.reading(f"SELECT {', '.join(MEASURES)} FROM runs WHERE id = ?", run)  # noqa: S608 - names of ours
    measures = dict(zip(MEASURES, row, strict=True))
    [(history, path)] = list(store.reading("SELECT history, path FROM traces WHERE run = ?", run)) or [(None, None)]
    return _Sampled(variant, instance, seed, measures, history, path, study.instances[instance])


def _made_again(
    study: Study, chosen: Sequence[_Sampled], workers: Workers, watch: Watch | None, check: Callable[[], None]
) -> list[Check]:
    salt = secrets.token_hex(8)
    variants, instances = list(study.variants), list(study.instances)
    parts: dict[str, bytes] = {}
    orders: dict[tuple[str, str, int], _Sampled] = {}
    listed = []
    for it in chosen:
        planner = f"{salt}/planner/{variants.index(it.variant)}"
        problem = f"{salt}/problem/{instances.index(it.instance)}"
        if planner not in parts:
            parts[planner] = part(study.planner(it.variant))
        if problem not in parts:
            parts[problem] = part(study.problem(it.instance))
            listed.append(Order("references", "", problem))
        listed.append(Order("run", planner, problem, it.seed, study.facts["time_limit"]))
        orders[planner, problem, it.seed] = it
    found: dict[tuple[str, str, int], Check] = {}
    wrong: set[str] = set()
    pace = Pace(len(listed), 0)

    def record(answers: Sequence[Answer]) -> None:
        for order, reply, _ in answers:
            if order.job == "references":
                known = next(it.known for key, it in orders.items() if key[1] == order.instance)
                if not _same_optima(reply.references, known):
                    wrong.add(order.instance)
            else:
                key = order.variant, order.instance, order.seed
                it = orders[key]
                found[key] = Check(it.variant, it.instance, it.seed, tuple(_differences(it, reply)))
        pace.done += len(answers)
        if watch is not None:
            watch(pace, "runs made again")

    with Crew(workers, study.variants.values()) as crew:
        execute(
            listed, crew.lanes(len(listed)), parts=parts.__getitem__, record=record, check=check,
            longest=workers.longest, grace=workers.grace,
        )  # fmt: skip
    return [
        Check(it.variant, it.map, it.seed, (*it.differs, *(["optimum"] if key[1] in wrong else [])))
        for key, it in ((key, found[key]) for key in orders)
    ]


def _differences(it: _Sampled, reply: Reply) -> Iterator[str]:
    """Yield what is not as it was."""
    now = dict(reply.measures)
    length = now.get("length")
    now |= {
        "gap_grid": gap_to(length, it.known.grid),
        "gap_any_angle": gap_to(length, it.known.any_angle),
        "gap_bound": gap_to(length, it.known.any_angle_bound),
    }
    for name in MEASURES:
        if name in NOT_COMPARED:
            continue
        was, value = it.measures[name], now.get(name)
        if name in JSON:
            was, value = None if was is None else json.loads(was), _plain(value)
        if was != value:
            yield name
    for name, blob, mine in (("path", it.path, reply.path), ("history", it.history, reply.history)):
        if (blob is None) != (mine is None) or (blob is not None and unzipped(blob) != unzipped(mine)):
            yield name


def _plain(values: Mapping[str, Any] | None) -> Any:
    """Return values as they come back from JSON."""
    if values is None:
        return None
    finite = {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in values.items()}
    return json.loads(json.dumps(finite))


def _same_optima(now: References | None, was: References) -> bool:
    if now is None:
        return False
    names = ("reachable", "grid", "any_angle", "any_angle_bound")
    return all(np.array_equal(getattr(now, name), getattr(was, name)) for name in names)
