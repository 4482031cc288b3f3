"""Component: the one shape of everything that a config can name.

A component is a frozen, keyword-only dataclass. Its fields are its parameters;
a field whose type is itself a kind of component is a *slot*. Nothing else is
remembered between calls, so a component can be compared, hashed, pickled,
frozen into a config and rebuilt from it.
"""

import ast
import dataclasses
import inspect
import math
import re
import sys
import types
import typing
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal, Union

import msgspec
import numpy as np

from pathloom.deprecation import Renamed
from pathloom.errors import ConfigError
from pathloom.naming import a


class Unit(str):
    """What a number is measured in: ``Annotated[Positive, Unit("cells")]``."""

    __slots__ = ()


Share = Annotated[float, msgspec.Meta(ge=0.0, le=1.0)]
"""A probability or a fraction."""
MOST = 2**31 - 1
"""The largest whole number that a parameter takes."""
Count = Annotated[int, msgspec.Meta(ge=1, le=MOST)]
"""At least one."""
Whole = Annotated[int, msgspec.Meta(ge=0, le=MOST)]
"""Zero or more."""
NonNegative = Annotated[float, msgspec.Meta(ge=0.0)]
"""A real number, zero or more."""
Positive = Annotated[float, msgspec.Meta(gt=0.0)]
"""A real number above zero."""
Distance = Annotated[float, msgspec.Meta(gt=0.0), Unit("cells")]
"""A distance above zero, in cells."""


def kebab(name: str) -> str:
    """Turn a class name into a component's name: ``MedianInsertion`` into ``median-insertion``."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "-", name).lower()


class Component:
    """Base of all kinds.

    A *kind* is a subclass that sets ``kind``; a component is a dataclass that
    inherits from a kind. Its name is its class name in kebab case unless the
    class sets ``name``.
    """

    kind: ClassVar[str] = ""
    """The kind's name, which is also the usual name of the slot that takes it."""
    name: ClassVar[str] = ""
    """The component's name within its plugin."""
    formerly: ClassVar[Mapping[str, str]] = {}
    """Names that it bore before, each with the version that gave it another one. Configs may still say them."""
    renamed: ClassVar[Mapping[str, Renamed]] = {}
    """Parameters that have got another name, by the old one. Configs may still say them."""
    source: ClassVar[str] = ""
    """Where it comes from: author, year, section or equation."""
    reference: ClassVar[str] = ""
    """The publication that describes it: authors, year, title, DOI. Left empty by a part of its plugin's one paper."""
    bibtex: ClassVar[str] = ""
    """The same as a BibTeX entry."""
    works_on: ClassVar[str] = ""
    """Name of the representation that it needs; empty: any."""
    needs: ClassVar[frozenset[str]] = frozenset()
    """Properties that the individuals must have when they reach it."""
    gives: ClassVar[frozenset[str]] = frozenset()
    """Properties that the individuals which it makes have."""
    breaks: ClassVar[frozenset[str]] = frozenset()
    """Properties that individuals may lose in it."""
    of_the_slot: ClassVar[tuple[str, ...]] = ()
    """Fields that belong to the slot rather than to the operator in it.

    They stay when another operator is put into the slot, so that a study which
    swaps one operator swaps nothing else.
    """
    example: ClassVar[Mapping[str, Any]] = {}
    """Values of parameters, as in a config, with which the contract kit tries a component that has no defaults."""

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        if "name" not in cls.__dict__:
            cls.name = kebab(cls.__name__)

    def __post_init__(self) -> None:
        for parameter in parameters(type(self)):
            value = getattr(self, parameter.name)
            checked = parameter.check(value, f"{self.name}: {parameter.name}")
            if checked is not value:
                object.__setattr__(self, parameter.name, checked)

    def serving(self, objectives: Any) -> typing.Self:
        """Return the component as it serves a planner with these objectives (`Terms`): with parts that serve it.

        What prices or measures by the planner's objectives takes them over here.
        """
        changes: dict[str, Any] = {}
        for parameter in parameters(type(self)):
            value = getattr(self, parameter.name)
            parts = value if isinstance(value, tuple) else (value,)
            served = tuple(part.serving(objectives) if isinstance(part, Component) else part for part in parts)
            if any(new is not old for new, old in zip(served, parts, strict=True)):
                changes[parameter.name] = served if isinstance(value, tuple) else served[0]
        return dataclasses.replace(self, **changes) if changes else self  # type: ignore[type-var]


@dataclasses.dataclass(frozen=True)
class Parameter:
    """One field of a component, as its class declares it."""

    name: str
    hint: Any
    """The field's type, with its range (``Annotated``)."""
    default: Any
    """The default, or ``dataclasses.MISSING``."""

    @property
    def required(self) -> bool:
        """Whether the component cannot be built without it."""
        return self.default is dataclasses.MISSING

    @property
    def optional(self) -> bool:
        """Whether ``None`` is allowed."""
        return type(None) in alternatives(self.hint)

    @property
    def slot(self) -> type[Component] | None:
        """The kind that the field takes, if it takes one component."""
        return next((h for h in alternatives(self.hint) if _is_kind(h)), None)

    @property
    def slots(self) -> type[Component] | None:
        """The kind that the field takes, if it takes a list of components."""
        if typing.get_origin(self.hint) is tuple:
            inner = typing.get_args(self.hint)
            if len(inner) == 2 and inner[1] is Ellipsis and _is_kind(inner[0]):
                return typing.cast("type[Component]", inner[0])
        return None

    @property
    def own_type(self) -> Any:
        """The type that the field takes if that is one which checks its values itself: a table of objectives."""
        return next((h for h in alternatives(self.hint) if hasattr(h, "__checked__")), None)

    @property
    def unit(self) -> str:
        """What the number is measured in; empty where it is a mere number, or none."""
        for hint in alternatives(self.hint):
            found = [str(m) for m in getattr(hint, "__metadata__", ()) if isinstance(m, Unit)]
            if found:
                return found[-1]
        return ""

    @property
    def allowed(self) -> str:
        """The values allowed, in words."""
        return describe(self.hint)

    def check(self, value: Any, where: str) -> Any:
        """Return the value, converted where that loses nothing.

        Raises
        ------
        ConfigError
            If the value's type or range is not what the field declares.
        """
        if kind := self.slot or self.slots:
            many = self.slots is not None
            if many and isinstance(value, list):
                value = tuple(value)
            found = (value if isinstance(value, tuple) else (value,)) if many else (value,)
            if not (value is None and self.optional) and not all(isinstance(v, kind) for v in found):
                raise ConfigError(f"{where} takes {self.allowed}; got {value!r}")
            return value
        if self.own_type is not None:
            return None if value is None and self.optional else self.own_type.__checked__(value, where)
        if isinstance(value, np.generic):
            value = value.item()
        try:
            checked = msgspec.convert(value, self.hint, strict=True)
        except (msgspec.ValidationError, TypeError) as error:
            raise ConfigError(f"{where} is {self.allowed}; got {value!r}") from error
        if isinstance(checked, float) and math.isnan(checked):
            raise ConfigError(f"{where} is {self.allowed}; got {value!r}")
        return checked


_known: dict[type, tuple[Parameter, ...]] = {}


def parameters(component: type) -> tuple[Parameter, ...]:
    """Return the parameters of a component class, in the order of its fields."""
    if component in _known:
        return _known[component]
    hints = typing.get_type_hints(component, include_extras=True)
    found = []
    for field in dataclasses.fields(component):
        default = field.default
        if field.default_factory is not dataclasses.MISSING:
            default = field.default_factory()
        found.append(Parameter(field.name, hints[field.name], default))
    _known[component] = tuple(found)
    return _known[component]


def members(component: Component) -> Iterator[tuple[str, Component]]:
    """Yield the components in the slots of a component, with the slot's name."""
    for parameter in parameters(type(component)):
        value = getattr(component, parameter.name)
        for one in value if isinstance(value, tuple) else (value,):
            if isinstance(one, Component):
                yield parameter.name, one


def meanings(component: type) -> dict[str, str]:
    """Return the docstrings that stand below the fields of a class and its bases, each as one line."""
    docs: dict[str, str] = {}
    for base in reversed(component.__mro__):
        if dataclasses.is_dataclass(base):
            docs |= _documented(base.__module__).get(base.__qualname__, {})
    return docs


@cache
def _documented(module: str) -> dict[str, dict[str, str]]:
    """Return the docstrings of the fields of all classes of a module, by class; empty without its source."""
    try:
        tree = ast.parse(inspect.getsource(sys.modules[module]))
    except (KeyError, OSError, TypeError, SyntaxError):
        return {}
    found: dict[str, dict[str, str]] = {}
    pending: list[tuple[str, ast.AST]] = [("", tree)]
    while pending:
        prefix, node = pending.pop()
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.ClassDef):
                found[prefix + child.name] = _documented_in(child.body)
                pending.append((f"{prefix}{child.name}.", child))
            elif isinstance(child, (ast.FunctionDef, ast.If)):
                inner = f"{prefix}{child.name}.<locals>." if isinstance(child, ast.FunctionDef) else prefix
                pending.append((inner, child))
    return found


def _documented_in(body: list[ast.stmt]) -> dict[str, str]:
    return {
        statement.target.id: " ".join(str(text.value.value).split())
        for statement, text in pairwise(body)
        if isinstance(statement, ast.AnnAssign) and isinstance(statement.target, ast.Name)
        if isinstance(text, ast.Expr) and isinstance(text.value, ast.Constant)
    }


def _is_kind(hint: Any) -> bool:
    return isinstance(hint, type) and issubclass(hint, Component)


def alternatives(hint: Any) -> tuple[Any, ...]:
    """Return the types of which a value may be any."""
    if typing.get_origin(hint) in (Union, types.UnionType):
        return typing.get_args(hint)
    return (hint,)


_WORDS = {float: "a number", int: "an integer", bool: "true or false", str: "a text", type(None): "none"}


def describe(hint: Any) -> str:
    """Say in words which values a type allows."""
    many = alternatives(hint)
    if len(many) > 1:
        return " or ".join(describe(one) for one in many)
    origin, inner = typing.get_origin(hint), typing.get_args(hint)
    if origin is Annotated:
        limits = next((m for m in inner[1:] if isinstance(m, msgspec.Meta)), msgspec.Meta())
        words = describe(inner[0])
        low, high = (limits.ge, limits.gt), (limits.le, limits.lt)
        if any(v is not None for v in (*low, *high)):
            left = f"[{limits.ge:g}" if limits.ge is not None else f"({limits.gt if limits.gt is not None else '-inf'}"
            right = (
                f"{limits.le:.10g}]" if limits.le is not None else f"{limits.lt if limits.lt is not None else 'inf'})"
            )
            words += f" in {left}, {right}"
        return words
    if origin is Literal:
        return "one of " + ", ".join(repr(v) for v in inner)
    if origin is tuple:
        of = [i for i in inner if i is not Ellipsis]
        if len(set(of)) > 1:
            return "a list of " + ", ".join(map(describe, of))
        return f"a list of {of[0].kind}s" if _is_kind(of[0]) else f"a list, each {describe(of[0])}"
    if _is_kind(hint):
        return a(hint.kind)
    if origin is not None and isinstance(origin, type) and issubclass(origin, Mapping):
        return "a table"
    return _WORDS.get(hint) or str(getattr(hint, "__words__", getattr(hint, "__name__", hint)))
