"""Values for parameters, made of what their types declare: some that are allowed, and some that are not."""

import math
import typing
from collections.abc import Iterator
from typing import Annotated, Any, Literal

import msgspec

from pathloom.kernel.component import Component, alternatives

TEXT = "no such value"


def within(hint: Any) -> Iterator[Any]:
    """Yield values that a type allows: in the middle, and on the borders as far as these belong to it."""
    for one in alternatives(hint):
        if typing.get_origin(one) is Literal:
            yield from typing.get_args(one)
        elif one is bool:
            yield from (True, False)
        elif one is str:
            yield "text"
        elif one is type(None):
            yield None
        elif (number := _number(one)) is not None:
            yield from _numbers(*number)


def beside(value: Any, hint: Any) -> Iterator[Any]:
    """Yield the numbers next to one that a component has: where parameters depend on each other these still fit.

    Of a text it is that text itself: which ones are allowed, its type does not say.
    """
    for one in alternatives(hint):
        if isinstance(value, bool | None):
            continue
        if one is str and isinstance(value, str):
            yield value
        elif (number := _number(one)) is not None and isinstance(value, int | float):
            kind, limits = number
            low, high = _borders(limits)
            for near in (value - 1, value + 1) if kind is int else (value * 0.99, value * 1.01):
                if (low is None or near > low) and (high is None or near < high):
                    yield kind(near)


def outside(hint: Any) -> Iterator[Any]:
    """Yield values that a type does not allow: just beyond its borders, and of other types."""
    many = alternatives(hint)
    if not all(map(_known, many)):
        return
    numbers = [number for one in many if (number := _number(one)) is not None]
    if len(many) == 1 and numbers:
        yield from _beyond(*numbers[0])
    if numbers:
        yield math.nan
    if type(None) not in many:
        yield None
    if str not in many:
        yield TEXT
    elif not numbers:
        yield 5
    yield Unfit()


class Unfit:
    """Nothing that any parameter takes."""

    def __repr__(self) -> str:
        return "an object of another class"


def _known(hint: Any) -> bool:
    """Say whether it is known which values a type allows."""
    origin: Any = typing.get_origin(hint)
    plain = hint in (bool, str, type(None)) or origin is Literal
    return plain or _number(hint) is not None or (isinstance(hint, type) and issubclass(hint, Component))


def _number(hint: Any) -> tuple[type, msgspec.Meta] | None:
    """Return whether a type is one of integers or real numbers, and its limits."""
    if hint in (int, float):
        return hint, msgspec.Meta()
    origin: Any = typing.get_origin(hint)
    inner = typing.get_args(hint)
    if origin is Annotated and inner[0] in (int, float):
        return inner[0], next((m for m in inner[1:] if isinstance(m, msgspec.Meta)), msgspec.Meta())
    return None


def _numbers(kind: type, limits: msgspec.Meta) -> Iterator[Any]:
    low, high = _borders(limits)
    step = 1 if kind is int else 0.5
    near = low if low is not None else high - step if high is not None else kind(1)
    inside = near + step if high is None or near + step < high else (near + high) / 2
    yield kind(inside)
    for border, open_, inwards in ((low, limits.gt is not None, step), (high, limits.lt is not None, -step)):
        if border is not None and not (open_ and kind is float):
            yield kind(border + (inwards if open_ else 0))


def _beyond(kind: type, limits: msgspec.Meta) -> Iterator[Any]:
    low, high = _borders(limits)
    step = 1 if kind is int else 0.5
    if low is not None:
        yield kind(low if limits.gt is not None else low - step)
    if high is not None:
        yield kind(high if limits.lt is not None else high + step)
    if kind is int:
        yield 1.5


def _borders(limits: msgspec.Meta) -> tuple[Any, Any]:
    low = limits.ge if limits.ge is not None else limits.gt
    high = limits.le if limits.le is not None else limits.lt
    return low, high
