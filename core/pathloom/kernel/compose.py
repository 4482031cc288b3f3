"""Composition: from names and tables to components, and back.

One rule: a table with ``use`` is a component, its other keys are that
component's fields, and nothing else is allowed. A table without ``use`` refines
the component that stands in the slot already; lists and objectives are replaced.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any, TypeVar

from pathloom.deprecation import warn
from pathloom.errors import ConfigError
from pathloom.kernel.component import Component, Parameter, parameters
from pathloom.kernel.evaluation import Objective, Term, Terms
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import Registry, default_registry
from pathloom.naming import a, closest

NONE = "none"
"""What a config writes into a slot that is to be empty."""

C = TypeVar("C", bound=Component)


def compose(planner: "str | Mapping[str, Any] | Planner", *, registry: Registry | None = None, **slots: Any) -> Planner:
    """Return a planner with some of its slots or parameters changed.

    Parameters
    ----------
    planner
        A planner's name, a table with ``use`` as in a config file, or a planner.
    slots
        New values: a component, a component's name, a table with ``use``, a
        table without (which refines the component in that slot), or a plain value.

    Raises
    ------
    ConfigError
        If a name, a slot or a field is unknown, or a value out of range.
    """
    registry = registry or default_registry()
    base = build(Planner, planner, registry, "planner")
    return refine(base, slots, registry, "planner") if slots else base


def part(kind: type[C], what: "str | Mapping[str, Any] | C", *, registry: Registry | None = None) -> C:
    """Return the component of a kind that a name, or a table with ``use`` as in a config, stands for.

    Raises
    ------
    ConfigError
        If there is none, a field is unknown, or a value out of range.
    """
    return build(kind, what, registry or default_registry(), kind.kind)


def build(kind: type[C], value: Any, registry: Registry, where: str) -> C:
    """Return the component that a config value stands for: a component, a name or a table with ``use``."""
    if isinstance(value, kind):
        return value
    if isinstance(value, str):
        value = {"use": value}
    if not isinstance(value, Mapping):
        raise ConfigError(f"{where}: {a(kind.kind)} is a name or a table with 'use'; got {value!r}")
    name = value.get("use")
    if not isinstance(name, str):
        what = f"got use = {name!r}" if "use" in value else f"found {', '.join(map(repr, value)) or 'an empty table'}"
        raise ConfigError(f"{where}: {a(kind.kind)} needs 'use', the name of one; {what}")
    component = registry.find(kind, name, f"{where}.use" if len(value) > 1 else where)
    return _assemble(component, value, None, registry, where)


def refine(component: C, table: Mapping[str, Any], registry: Registry, where: str) -> C:
    """Return a component with some of its fields changed."""
    return _assemble(type(component), table, component, registry, where)


def override(component: C, path: str, value: Any, registry: Registry | None = None, where: str = "") -> C:
    """Return a component with one field changed, which a dotted path names.

    ``selection`` names a slot, ``crossover.rate`` a field of the component in
    it, ``objectives.length`` one term, ``termination.max-generations.limit`` a
    field of one component of a list.
    """
    registry = registry or default_registry()
    head, _, rest = path.partition(".")
    here = f"{where}.{head}" if where else head
    parameter = _parameter(type(component), head, where, registry)
    head = parameter.name
    current = getattr(component, head)
    if not rest:
        return refine(component, {head: value}, registry, where)
    if isinstance(current, Terms):
        terms = {label: table for label, table in freeze(component, registry)[head].items()}  # noqa: C416
        label, _, field = rest.partition(".")
        if field:
            if label not in terms:
                raise ConfigError(f"{here}: no term is called {label!r}; {closest(label, terms)}")
            terms[label] = {**terms[label], field: value}
        elif isinstance(value, (int, float)) and label in terms:
            terms[label] = {**terms[label], "weight": value}
        elif value == NONE:
            terms.pop(label, None)
        else:
            terms[label] = value
        return refine(component, {head: terms}, registry, where)
    if parameter.slots is not None:
        chosen, _, field = rest.partition(".")
        index = _member(current, chosen, here)
        if index is None:  # no name between: the one member that has such a field
            field = rest
            having = [i for i, m in enumerate(current) if rest in (p.name for p in parameters(type(m)))]
            if len(having) != 1:
                names = [m.name for m in current]
                raise ConfigError(
                    f"{here}: no {parameter.slots.kind} here is called {chosen!r}; {closest(chosen, names)}"
                )
            index = having[0]
        changed = list(current)
        if not field and value == NONE:
            del changed[index]
            return refine(component, {head: tuple(changed)}, registry, where)
        if not field:
            changed[index] = value
            return refine(component, {head: changed}, registry, where)
        changed[index] = override(changed[index], field, value, registry, here)
        return refine(component, {head: tuple(changed)}, registry, where)
    if isinstance(current, Component):
        return refine(component, {head: override(current, rest, value, registry, here)}, registry, where)
    raise ConfigError(f"{here}: has no field {rest!r}: it is {parameter.allowed}")


def freeze(component: Component, registry: Registry | None = None) -> dict[str, Any]:
    """Return the complete table that rebuilds a component: every field, every default."""
    registry = registry or default_registry()
    table: dict[str, Any] = {"use": registry.name_of(type(component))}
    for parameter in parameters(type(component)):
        table[parameter.name] = _frozen(getattr(component, parameter.name), registry)
    return table


def _frozen(value: Any, registry: Registry) -> Any:
    if value is None:
        return NONE
    if isinstance(value, Component):
        return freeze(value, registry)
    if isinstance(value, Terms):
        return {
            t.label: {"use": (f := freeze(t.objective, registry)).pop("use"), "weight": t.weight, **f} for t in value
        }
    if isinstance(value, (tuple, list)):
        return [_frozen(v, registry) for v in value]
    if isinstance(value, Mapping):
        return {k: _frozen(v, registry) for k, v in value.items()}
    return value


def _assemble(component: type[C], table: Mapping[str, Any], base: C | None, registry: Registry, where: str) -> C:
    """Build a component of the fields in a table; what the table leaves out is the base's or the default."""
    fields: dict[str, Any] = {}
    for key, value in table.items():
        if key == "use" and base is None:
            continue
        parameter = _parameter(component, key, where, registry)
        current = getattr(base, parameter.name) if base is not None else parameter.default
        fields[parameter.name] = _value(parameter, value, current, registry, f"{where}.{key}" if where else key)
    if base is None:
        for parameter in parameters(component):
            if parameter.required and parameter.name not in fields:
                raise ConfigError(
                    f"{where}: {registry.name_of(component)!r} needs {parameter.name!r}: {parameter.allowed}"
                )
    else:
        fields = {**{p.name: getattr(base, p.name) for p in parameters(component)}, **fields}
    try:
        return component(**fields)
    except ConfigError as error:
        raise ConfigError(f"{where}: {error}") from error
    except (ValueError, TypeError) as error:
        raise ConfigError(f"{where}: {registry.name_of(component)}: {error}") from error


def _value(parameter: Parameter, value: Any, current: Any, registry: Registry, where: str) -> Any:
    if kind := parameter.slot:
        if parameter.optional and (value is None or value == NONE):
            return None
        if isinstance(value, Mapping) and "use" not in value and isinstance(current, Component):
            return refine(current, value, registry, where)
        built = build(kind, value, registry, where)
        given = value if isinstance(value, Mapping) else {}
        is_new = not isinstance(value, Component)
        return _keep_the_slots_own(built, current, given) if is_new else built
    if kind := parameter.slots:
        listed = value if isinstance(value, Sequence) and not isinstance(value, str) else [value]
        return tuple(
            build(kind, v, registry, f"{where}[{i}]" if len(listed) > 1 else where) for i, v in enumerate(listed)
        )
    if isinstance(value, str) and value == NONE and parameter.optional:
        return None
    if parameter.own_type is Terms and value is not None:
        return _terms(value, registry, where)
    if isinstance(value, list):
        value = tuple(value)
    return parameter.check(value, where)


def _keep_the_slots_own(built: C, current: Any, given: Mapping[str, Any]) -> C:
    """Carry over what belongs to the slot, unless the new table sets any of it."""
    own = built.of_the_slot
    if not own or not isinstance(current, Component) or current.of_the_slot != own or any(f in given for f in own):
        return built
    return dataclasses.replace(built, **{f: getattr(current, f) for f in own})  # type: ignore[type-var]


def _terms(value: Any, registry: Registry, where: str) -> Terms:
    if isinstance(value, Terms):
        return value
    if isinstance(value, Sequence) and not isinstance(value, str):
        value = _labelled(value, where)
    if not isinstance(value, Mapping):
        raise ConfigError(f"{where}: objectives are a table of terms; got {value!r}")
    terms = []
    for label, entry in value.items():
        here = f"{where}.{label}"
        weight: Any = 1.0
        if isinstance(entry, (int, float)) and not isinstance(entry, bool):
            objective, weight = build(Objective, label, registry, here), entry
        elif isinstance(entry, Mapping):
            fields = {k: v for k, v in entry.items() if k != "weight"}
            weight = entry.get("weight", 1.0)
            objective = build(Objective, {"use": label, **fields}, registry, here)
        else:
            objective = build(Objective, entry, registry, here)
        if isinstance(weight, bool) or not isinstance(weight, (int, float)):
            raise ConfigError(f"{here}: weight is a number in [0, inf); got {weight!r}")
        terms.append(Term(label, objective, float(weight)))
    return Terms.__checked__(Terms(terms), where)


def _labelled(values: Sequence[Any], where: str) -> dict[str, Any]:
    """Return the table that a list of objectives stands for: each by its name."""
    table: dict[str, Any] = {}
    for value in values:
        label = str(value.get("use") if isinstance(value, Mapping) else getattr(value, "name", value))
        if label in table:
            raise ConfigError(
                f"{where}: found {label!r} twice, allowed each objective once; in a table they have labels"
            )
        table[label] = value
    return table


def _parameter(component: type[Component], name: str, where: str, registry: Registry) -> Parameter:
    known = {p.name: p for p in parameters(component)}
    at = f"{where}.{name}" if where else name
    if name not in known and name in component.renamed:
        new, since = component.renamed[name]
        warn(f"{at} of {registry.name_of(component)!r}", since, repr(new))
        return known[new]
    if name not in known:
        called = registry.name_of(component)
        what = "slot or parameter" if issubclass(component, Planner) else "parameter"
        raise ConfigError(f"{at}: {called!r} has no such {what}; {closest(name, known)}")
    return known[name]


def _member(members: Sequence[Component], name: str, where: str) -> int | None:
    if name.isdigit():
        if int(name) >= len(members):
            raise ConfigError(f"{where}: has {len(members)} members, counted from 0; got {name}")
        return int(name)
    return next((i for i, m in enumerate(members) if m.name == name), None)
