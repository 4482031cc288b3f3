"""From what components declare of themselves to the forms of the page."""

import inspect
from typing import Any

from pathloom.errors import ConfigError
from pathloom.kernel.component import Parameter, meanings, parameters
from pathloom.kernel.compose import compose, freeze
from pathloom.kernel.evaluation import Terms
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import Entry, Registry
from pathloom.paths.maps import Map, MapFamily
from pathloom.schema import of_type

APART = ("map", "claim", "observer")
"""Kinds of component that no form offers."""


def catalogue(registry: Registry) -> dict[str, Any]:
    """Return every planner and component with its fields and its complete default table, and the maps by name.

    ``components`` are by kind, then by name; a component that is nothing without
    parts has no ``table``.
    """
    kinds: dict[str, dict[str, Any]] = {}
    for entry in registry.all_entries():
        if entry.component.kind not in APART:
            kinds.setdefault(entry.component.kind, {})[entry.name] = _form(entry, registry)
    maps = [
        {"name": e.component.name, "family": issubclass(e.component, MapFamily), "about": _about(e.component)}
        for e in registry.all_entries(Map)
    ]
    return {"components": kinds, "maps": maps}


def _form(entry: Entry, registry: Registry) -> dict[str, Any]:
    component = entry.component
    about = meanings(component)
    fields = [_field(p, about.get(p.name, "")) for p in parameters(component) if p.name != "observers"]
    form: dict[str, Any] = {
        "plugin": entry.source.namespace,
        "about": _about(component),
        "source": component.source,
        "keeps": list(component.of_the_slot),
        "fields": fields,
    }
    if not any(p.required for p in parameters(component)):
        form["table"] = freeze(component(), registry)
        form["table"].pop("observers", None)
    if issubclass(component, Planner):
        form |= {"front": issubclass(component, FrontPlanner), "reference": component.reference}
        form["fidelity"] = component.fidelity
        form["usable"] = _usable(entry.name, registry)
    return form


def _field(parameter: Parameter, meaning: str) -> dict[str, Any]:
    """Return one field: a slot for a component, a list of such slots, a table of objectives, or a value."""
    field: dict[str, Any] = {"name": parameter.name, "meaning": meaning, "optional": parameter.optional}
    if kind := parameter.slot:
        return field | {"form": "slot", "kind": kind.kind}
    if kind := parameter.slots:
        return field | {"form": "slots", "kind": kind.kind}
    if parameter.own_type is Terms:
        return field | {"form": "terms"}
    return field | {"form": "value", "schema": of_type(parameter.hint), "allowed": parameter.allowed}


def _usable(name: str, registry: Registry) -> bool:
    """Say whether a planner can be run as it comes."""
    try:
        compose(name, registry=registry)
    except ConfigError:
        return False
    return True


def _about(component: type) -> str:
    return (inspect.getdoc(component) or "").partition("\n\n")[0].replace("\n", " ")
