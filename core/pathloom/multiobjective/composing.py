"""From names to a planner of fronts, with two to five objectives and perhaps constraints."""

import re
from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

from pathloom.errors import ConfigError
from pathloom.kernel.compose import build, compose
from pathloom.kernel.evaluation import Objective, Term, Terms
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry
from pathloom.naming import closest
from pathloom.paths.constraints import parse_constraint

FEWEST, MOST = 2, 5
"""How many objectives a front may have."""

Objectives = Sequence[str | Mapping[str, Any] | Objective] | Mapping[str, Any] | Terms


def front_planner(
    planner: str | Mapping[str, Any] | Planner, objectives: Objectives | None = None, constraints: Sequence[Any] = ()
) -> FrontPlanner:
    """Return a planner of fronts, with other objectives and constraints where these are given.

    Raises
    ------
    ConfigError
        If it answers with a single path, or objectives or constraints cannot be used.
    """
    slots: dict[str, Any] = {}
    if objectives is not None:
        slots["objectives"] = objectives_of(objectives)
    if constraints:
        listed = [constraints] if isinstance(constraints, (str, Mapping)) else constraints
        slots["constraints"] = [_constraint(constraint) for constraint in listed]
    _check_kind(planner)
    if isinstance(planner, Planner):
        composed = compose(planner, **slots)
    else:  # at once, for a planner may need objectives to be made at all
        table = {"use": planner} if isinstance(planner, str) else planner
        composed = compose({**table, **slots})
    assert isinstance(composed, FrontPlanner)
    _check(composed.objectives)
    return composed


def objectives_of(objectives: Objectives) -> Terms:
    """Return the terms that a list of objectives or a table by label stands for, two to five.

    Raises
    ------
    ConfigError
        If there are fewer or more, one is unknown, or one comes twice.
    """
    registry = default_registry()
    if isinstance(objectives, Terms):
        terms = objectives
    elif isinstance(objectives, Mapping):
        terms = _of_table(objectives)
    elif isinstance(objectives, str):
        raise ConfigError(f"objectives: found {objectives!r}, allowed a list of {FEWEST} to {MOST} names")
    else:
        found: list[Term] = []
        for asked in objectives:
            built = build(Objective, asked, registry, "objectives")
            label = asked if isinstance(asked, str) else built.name
            if label in (term.label for term in found):
                raise ConfigError(f"objectives: found {label!r} twice, allowed each objective once")
            found.append(Term(label, built))
        terms = Terms(found)
    _check(terms)
    return terms


def _constraint(asked: Any) -> Any:
    """Return the constraint that a text such as ``length <= 20`` stands for; anything else as it is."""
    return parse_constraint(asked) if isinstance(asked, str) and re.search("[<>≤≥]", asked) else asked


def _of_table(table: Mapping[str, Any]) -> Terms:
    """Return the terms of a table, read as a planner would read it."""
    registry = default_registry()
    terms = []
    for label, entry in table.items():
        where = f"objectives.{label}"
        if isinstance(entry, (int, float)) and not isinstance(entry, bool):
            terms.append(Term(label, build(Objective, label, registry, where), float(entry)))
            continue
        if isinstance(entry, Mapping):
            weight = entry.get("weight", 1.0)
            if isinstance(weight, bool) or not isinstance(weight, (int, float)):
                raise ConfigError(f"{where}: weight is a number in [0, inf); got {weight!r}")
            fields = {key: value for key, value in entry.items() if key != "weight"}
            terms.append(Term(label, build(Objective, {"use": label, **fields}, registry, where), float(weight)))
            continue
        terms.append(Term(label, build(Objective, entry, registry, where)))
    return Terms.__checked__(Terms(terms), "objectives") if terms else Terms()


def _check(terms: Terms) -> None:
    """Refuse too few, too many, and one objective under two labels."""
    if not FEWEST <= len(terms) <= MOST:
        named = f" ({', '.join(terms.labels)})" if terms else ""
        raise ConfigError(f"objectives: found {len(terms)}{named}, allowed {FEWEST} to {MOST}")
    for one, other in combinations(terms, 2):
        if one.objective == other.objective:
            raise ConfigError(
                f"objectives: {one.label!r} and {other.label!r} are the same, allowed each objective once"
            )


def _check_kind(planner: str | Mapping[str, Any] | Planner) -> None:
    """Refuse a planner that answers with a single path, before its slots are looked at."""
    registry = default_registry()
    if isinstance(planner, Planner):
        kind, name = type(planner), planner.name
    else:
        name = planner if isinstance(planner, str) else str(planner.get("use"))
        kind = registry.find(Planner, name, "planner")
    if not issubclass(kind, FrontPlanner):
        fronts = [entry.component.name for entry in registry.all_entries(FrontPlanner)]
        raise ConfigError(f"planner: {name!r} answers with one path, not with a front; {closest(name, fronts)}")
