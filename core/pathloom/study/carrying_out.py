"""Carrying out: from a design to a study, begun, or taken up where it stopped."""

import json
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any

from pathloom.errors import ConfigError
from pathloom.kernel.compose import freeze
from pathloom.study.budget import Budget
from pathloom.study.design import Design, budgeted
from pathloom.study.errors import StudyError
from pathloom.study.execute import Answer, execute
from pathloom.study.lock import Lock
from pathloom.study.session import Crew, Pace, Session, Watch, Workers, check_versions
from pathloom.study.store import MEMORY, Store
from pathloom.study.study import Study
from pathloom.study.worker import Order, environment, part


def carry_out(
    design: Design,
    out: str | Path | None = None,
    *,
    workers: Workers | None = None,
    mixed: bool = False,
    watch: Watch | None = None,
    check: Callable[[], None] = lambda: None,
) -> Study:
    """Carry out a design, and return the study.

    Parameters
    ----------
    out
        The study's file; one that is there already is taken up where it stopped, and
        may have fewer variants, instances or runs. Empty: in memory.
    workers
        Who carries it out.
    mixed
        Take up a study that began with other versions.
    watch
        Told how far it is.
    check
        Called all the time; raises to end everything. What is done is kept.

    Raises
    ------
    StudyError
        If the file holds another study, is no study, is damaged, or is in use.
    """
    workers = workers or Workers()
    if out is not None and not Path(out).parent.is_dir():
        raise StudyError(f"{out}: found no such folder, allowed a file in an existing one")
    lock = nullcontext() if out is None else Lock(Path(out))
    with _writable(out), lock, Crew(workers, _configs(design)) as crew:
        store = Store(MEMORY if out is None else out, create=True)
        try:
            if out is not None:
                store.check()
            facts = store.facts()
            design = _taken_up(design, facts, store) if facts else _with_budget(design, crew, watch, check)
            planners = {v.name: v.planner for v in design.variants}
            store.add(design.variants, design.instances, {**_facts_of(design), **_kept(facts, design)})
            study = Study(store, planners)
            check_versions(store, study.facts, mixed=mixed)
            Session(store, study.planner, crew, watch, check).work()
        except BaseException:
            store.close()
            raise
    return study


@contextmanager
def _writable(out: str | Path | None) -> Iterator[None]:
    try:
        yield
    except PermissionError as error:
        raise StudyError(f"{out}: found a place not writable, allowed a writable folder") from error


def _facts_of(design: Design) -> dict[str, Any]:
    """Return what is written down about a study as a whole."""
    return {
        "kind": design.kind,
        "id": os.urandom(8).hex(),
        "created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
        "runs": design.runs,
        "seed": design.seed,
        "time_limit": design.time_limit,
        "budget": design.budget.table(),
        "notes": list(design.notes),
        "front": design.front,
        "versions": environment(_configs(design)),
    }


def _configs(design: Design) -> list[dict[str, Any]]:
    return [freeze(variant.planner) for variant in design.variants]


def _kept(facts: Mapping[str, Any], design: Design) -> dict[str, Any]:
    """Return what stays as it is when a study is taken up."""
    if not facts:
        return {}
    notes = [*facts["notes"], *(note for note in design.notes if note not in facts["notes"])]
    return {**facts, "runs": design.runs, "notes": notes}


def _taken_up(design: Design, facts: Mapping[str, Any], store: Store) -> Design:
    """Return the design as the study that is there goes on with it.

    Raises
    ------
    StudyError
        If it is another study.
    """

    def differ(what: str, was: Any, asked: Any) -> StudyError:
        return StudyError(f"{store.name}: holds another study: {what} {was}, not {asked}; choose another --out")

    for what, asked in (("kind", design.kind), ("seed", design.seed), ("time_limit", design.time_limit),
                        ("front", design.front)):  # fmt: skip
        if facts[what] != asked:
            raise differ(f"its {what.replace('_', ' ')} is", facts[what], asked)
    if facts["budget"]["of"] != design.budget.of or (
        design.budget.limit is not None and facts["budget"]["limit"] != design.budget.limit
    ):
        raise differ("its budget is", Budget(**facts["budget"]), design.budget)
    design = budgeted(design, Budget(**facts["budget"]))
    configs = store.configs()
    for index, variant in enumerate(design.variants):
        table = json.loads(json.dumps(freeze(variant.planner)))
        if variant.name in configs and configs[variant.name] != table:
            raise differ("variant", f"{variant.name!r} has other parameters there", "those asked for now")
        if index == 0 and design.kind == "ablate" and variant.name not in configs:
            raise differ("its base is", repr(next(iter(configs))), repr(variant.name))
    known = store.instance_ids()
    for instance in design.instances:
        if instance.name in known:
            it, new = store.problem(instance.name), instance.problem
            if (it.grid.sha256, it.ends, it.corners, it.radius) != (new.grid.sha256, new.ends, new.corners, new.radius):
                raise differ("map", f"{instance.name!r} is another one there", "the one asked for now")
    return replace(design, runs=max(design.runs, int(facts["runs"])))


def _with_budget(design: Design, crew: Crew, watch: Watch | None, check: Callable[[], None]) -> Design:
    """Return the design with its budget measured, where that was left open, and applied."""
    if not design.budget.open:
        return budgeted(design, design.budget)
    asked = design.variants[:1] if design.kind != "compare" else design.variants
    instance = next((i for i in design.instances if i.problem.reachable), None)
    if instance is None:
        raise ConfigError("maps: found none on which the goal can be reached, allowed at least one")
    salt = os.urandom(8).hex()  # workers of a cluster outlive a study
    parts = {f"{salt}/{v.name}": v.planner for v in asked}
    spent: dict[str, float] = {}

    def record(answers: Sequence[Answer]) -> None:
        for order, reply, _ in answers:
            number = reply.measures.get(design.budget.of)
            if number:
                spent[order.variant.partition("/")[2]] = number
        if watch is not None:
            watch(Pace(len(asked), len(spent)), "measuring the budget")

    orders = [Order("spending", f"{salt}/{v.name}", salt) for v in asked]
    execute(
        orders, crew.lanes(len(orders)), record=record, longest=crew.workers.longest, grace=crew.workers.grace,
        check=check, parts=lambda key: part(parts.get(key, instance.problem)),
    )  # fmt: skip
    if not spent:
        raise ConfigError(
            f"budget: found nothing that {asked[0].name!r} spends; give a number: --budget evaluations=5000"
        )
    most = max(spent, key=lambda name: spent[name])
    limit = int(spent[most])
    note = f"budget: {limit} {design.budget.of} for every run, what {most!r} spends on {instance.name!r} if it is let"
    return replace(budgeted(design, Budget(design.budget.of, limit)), notes=(*design.notes, note))
