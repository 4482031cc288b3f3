"""The JSON schema of a config, made of what the components declare."""

import typing
from typing import Any

import msgspec

from pathloom.config import ProblemSpec
from pathloom.fronts.asked import Asked
from pathloom.kernel.component import Component, Parameter, meanings, parameters
from pathloom.kernel.compose import NONE
from pathloom.kernel.evaluation import Objective, Terms, Weighting
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import Entry, Registry
from pathloom.paths.context import POLICIES
from pathloom.paths.curves import Smoother
from pathloom.paths.problem import CORNER_NAMES

Schema = dict[str, Any]

NUMBER = {"type": "number", "minimum": 0}
PLACE: Schema = {
    "anyOf": [
        {"enum": list(CORNER_NAMES)},
        {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2},
    ]
}
PROBLEM: Schema = {
    "map": {"type": "string"},
    "start": PLACE,
    "goal": PLACE,
    "corners": {"enum": sorted(POLICIES)},
    "radius": NUMBER,
    "world": {"type": "boolean"},
    "unknown": {"enum": ["occupied", "free"]},
    "threshold": {"type": "integer", "minimum": 0, "maximum": 255},
}
FRONT: Schema = {
    "exact": {"type": "boolean"},
    "against": {"type": "array", "items": {"$ref": f"#/$defs/{Planner.kind}"}},
    "runs": {"type": "integer", "minimum": 1},
    "prefer": {
        "anyOf": [
            {"type": "object", "minProperties": 1, "additionalProperties": NUMBER},
            {"$ref": f"#/$defs/{Weighting.kind}"},
            {"const": NONE},
        ]
    },
    "reference": {"anyOf": [{"type": "array", "items": {"type": "number"}}, {"const": NONE}]},
}
assert PROBLEM.keys() == ProblemSpec.__dataclass_fields__.keys()
assert FRONT.keys() == Asked.__dataclass_fields__.keys()


def schema_of_config(registry: Registry) -> Schema:
    """Return the JSON schema (draft 2020-12) that every valid config file satisfies."""
    writer = _Writer(registry)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "pathloom config",
        **_table(
            {
                "problem": _table(PROBLEM),
                "planner": {"$ref": f"#/$defs/{Planner.kind}"},
                "front": _table(FRONT),
                "run": _table(
                    {
                        "seed": {"type": "integer", "minimum": 0},
                        "time_limit": {"anyOf": [{"type": "number", "exclusiveMinimum": 0}, {"const": NONE}]},
                        "smooth": {"anyOf": [{"$ref": f"#/$defs/{Smoother.kind}"}, {"const": NONE}]},
                    }
                ),
            }
        ),
        "$defs": writer.definitions(),
    }


def schema_of(parameter: Parameter) -> Schema:
    """Return the JSON schema of a parameter's values; of a slot, the kind of component that it takes."""
    if kind := parameter.slot or parameter.slots:
        return {"kind": kind.kind, "many": parameter.slots is not None, "optional": parameter.optional}
    if parameter.own_type is Terms:
        return {"kind": Objective.kind, "many": True, "optional": parameter.optional}
    return of_type(parameter.hint)


class _Writer:
    """Writes one definition for each kind and each component."""

    def __init__(self, registry: Registry) -> None:
        self._entries = [e for e in registry.all_entries() if e.component.kind != "map"]
        self._kinds = sorted({e.component.kind for e in self._entries})

    def definitions(self) -> Schema:
        found: Schema = {}
        for kind in self._kinds:
            entries = self._of(kind)
            found[kind] = {
                "anyOf": [
                    {"type": "string", "enum": _names(entries)},
                    *({"$ref": _reference(e)} for e in entries),
                    self._refinement(entries),
                ]
            }
            found |= {_reference(e).rpartition("/")[2]: self._component(e) for e in entries}
        if Objective.kind in self._kinds:
            found["terms"], found["term"] = self._terms()
        return found

    def _of(self, kind: str) -> list[Entry]:
        return [e for e in self._entries if e.component.kind == kind]

    def _component(self, entry: Entry, **more: Any) -> Schema:
        about = meanings(entry.component)
        fields = {p.name: _described(self._parameter(p), p, about.get(p.name)) for p in parameters(entry.component)}
        required = [p.name for p in parameters(entry.component) if p.required]
        table = _table({"use": {"enum": _names([entry])}, **fields, **more}, "use", *required)
        return {"description": (entry.component.__doc__ or "").strip().partition("\n")[0], **table}

    def _refinement(self, entries: list[Entry]) -> Schema:
        """Return the schema of a table without ``use``: fields of whatever stands in the slot."""
        fields: dict[str, list[Schema]] = {}
        for entry in entries:
            for parameter in parameters(entry.component):
                one = self._parameter(parameter)
                if one not in (known := fields.setdefault(parameter.name, [])):
                    known.append(one)
        return _table({name: forms[0] if len(forms) == 1 else {"anyOf": forms} for name, forms in fields.items()})

    def _parameter(self, parameter: Parameter) -> Schema:
        if kind := parameter.slot or parameter.slots:
            one: Schema = {"$ref": f"#/$defs/{kind.kind}"} if kind.kind in self._kinds else {"not": {}}
            if parameter.slots is not None:
                return {"anyOf": [{"type": "array", "items": one}, one]}
            return {"anyOf": [one, {"const": NONE}]} if parameter.optional else one
        one = {"$ref": "#/$defs/terms"} if parameter.own_type is Terms else of_type(parameter.hint)
        return {"anyOf": [one, {"const": NONE}]} if parameter.optional else one

    def _terms(self) -> tuple[Schema, Schema]:
        """Return the schemas of a table of objectives, and of one in it whose label may be any word."""
        entries = self._of(Objective.kind)
        weighed = {entry.name: self._component(entry, weight=NUMBER) for entry in entries}
        by_name: Schema = {}
        for entry in entries:
            own = weighed[entry.name]
            by_label = {**own, "required": [r for r in own["required"] if r != "use"]}
            for name in _names([entry]):  # the label names the objective: a weight alone will do
                by_name[name] = {"anyOf": [NUMBER, by_label, {"$ref": "#/$defs/term"}]}
        term = {"anyOf": [{"enum": _names(entries)}, *weighed.values()]}
        other = {"$ref": "#/$defs/term"}
        return {"type": "object", "minProperties": 1, "properties": by_name, "additionalProperties": other}, term


def _described(schema: Schema, parameter: Parameter, about: str | None) -> Schema:
    """Return a parameter's schema with what an editor shows of it: its meaning, its unit and its default."""
    words = about or ""
    if parameter.unit:
        words = f"{words.rstrip('.')} [{parameter.unit}]." if words else f"[{parameter.unit}]"
    shown: Schema = {"description": words} if words else {}
    if isinstance(parameter.default, (bool, int, float, str)) and parameter.default == parameter.default:
        shown["default"] = parameter.default
    return {**shown, **schema}


def _names(entries: list[Entry]) -> list[str]:
    return sorted({name for e in entries for name in (e.name, e.component.name)})


def _reference(entry: Entry) -> str:
    return f"#/$defs/{entry.component.kind}:{entry.name.replace('/', '.')}"


def _table(properties: Schema, *required: str) -> Schema:
    return {"type": "object", "properties": properties, "required": [*required], "additionalProperties": False}


def of_type(hint: Any) -> Schema:
    """Return the JSON schema of a field's type."""
    if hint is Any or (isinstance(hint, type) and issubclass(hint, Component)):
        return {}
    if typing.get_origin(hint) is typing.Annotated and typing.get_origin(typing.get_args(hint)[0]) is tuple:
        hint = typing.get_args(hint)[0]
    return msgspec.json.schema(hint)
