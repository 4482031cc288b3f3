"""The JSON schema of a config, made of what the components declare."""

import dataclasses
import typing
from typing import Any

import msgspec

from pathloom.config import ProblemSpec
from pathloom.kernel.component import Component, Parameter, parameters
from pathloom.kernel.compose import NONE
from pathloom.kernel.evaluation import Objective, Terms
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import Entry, Registry


def schema_of_config(registry: Registry) -> dict[str, Any]:
    """Return the JSON schema (draft 2020-12) that every valid config file satisfies."""
    entries = list(registry.all_entries())
    kinds = sorted({e.component.kind for e in entries if e.component.kind != "map"})
    definitions: dict[str, Any] = {}
    for kind in kinds:
        of_kind = [e for e in entries if e.component.kind == kind]
        names = sorted({n for e in of_kind for n in (e.name, e.component.name)})
        definitions[kind] = {
            "anyOf": [
                {"type": "string", "enum": names},
                *({"$ref": f"#/$defs/{kind}:{e.name}"} for e in of_kind),
                {
                    "type": "object",
                    "not": {"required": ["use"]},
                    "description": "refines what the slot holds",
                },
            ]
        }
        for entry in of_kind:
            definitions[f"{kind}:{entry.name}"] = _component(entry, kinds)
    problem = {f.name: _of_type(f.type) for f in dataclasses.fields(ProblemSpec)}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "pathloom config",
        "type": "object",
        "additionalProperties": False,
        "properties": {
            "problem": {"type": "object", "additionalProperties": False, "properties": problem},
            "planner": {"$ref": f"#/$defs/{Planner.kind}"},
            "run": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    "seed": {"type": "integer", "minimum": 0},
                    "time_limit": {"anyOf": [{"type": "number", "exclusiveMinimum": 0}, {"const": NONE}]},
                },
            },
        },
        "$defs": definitions,
    }


def _component(entry: Entry, kinds: list[str]) -> dict[str, Any]:
    properties: dict[str, Any] = {"use": {"enum": sorted({entry.name, entry.component.name})}}
    for parameter in parameters(entry.component):
        properties[parameter.name] = _parameter(parameter, kinds)
    required = [p.name for p in parameters(entry.component) if p.required]
    return {
        "type": "object",
        "description": (entry.component.__doc__ or "").strip().partition("\n")[0],
        "properties": properties,
        "required": ["use", *required],
        "additionalProperties": False,
    }


def _parameter(parameter: Parameter, kinds: list[str]) -> dict[str, Any]:
    if parameter.slot is not None:
        known = {"$ref": f"#/$defs/{parameter.slot.kind}"} if parameter.slot.kind in kinds else {"type": "object"}
        return {"anyOf": [known, {"const": NONE}]} if parameter.optional else known
    if parameter.slots is not None:
        one = {"$ref": f"#/$defs/{parameter.slots.kind}"} if parameter.slots.kind in kinds else {"type": "object"}
        return {"anyOf": [{"type": "array", "items": one}, one]}
    if parameter.hint is Terms:
        term = {
            "anyOf": [
                {"type": "number", "minimum": 0},
                {"type": "string"},
                {
                    "type": "object",
                    "properties": {"use": {"type": "string"}, "weight": {"type": "number", "minimum": 0}},
                },
            ]
        }
        return {
            "type": "object",
            "additionalProperties": term,
            "minProperties": 1,
            "description": Objective.kind,
        }
    return _of_type(parameter.hint)


def _of_type(hint: Any) -> dict[str, Any]:
    if hint is Any or (isinstance(hint, type) and issubclass(hint, Component)):
        return {}
    if typing.get_origin(hint) is typing.Annotated and typing.get_origin(typing.get_args(hint)[0]) is tuple:
        hint = typing.get_args(hint)[0]
    return msgspec.json.schema(hint)
