"""Check: one promise of the contract, and how it is found out whether a component keeps it."""

from collections.abc import Callable, Iterator
from contextlib import chdir, contextmanager
from dataclasses import dataclass
from tempfile import TemporaryDirectory
from typing import Any

from pathloom.kernel.component import Component


class Broken(AssertionError):  # noqa: N818 - a test that fails, whatever it is called
    """A component breaks a promise; the message says what was expected, and what was found."""


class Inapplicable(Exception):  # noqa: N818 - no error: there is nothing to be tried
    """A promise does not concern this component after all; the message says why."""


@contextmanager
def in_a_folder_of_its_own() -> Iterator[None]:
    """Work in a new folder that is gone afterwards: some components, as observers, write files where they are."""
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder, chdir(folder):
        yield


@dataclass(frozen=True)
class Check:
    """A promise, and the function that raises `Broken` for a component which does not keep it."""

    name: str
    promise: str
    """What the component promises, in one sentence."""
    kinds: tuple[type[Component], ...]
    """Whom it concerns."""
    examine: Callable[[Any], None]
    where: Callable[[Any], bool] = lambda _: True
    """Whom of these kinds it concerns."""

    def concerns(self, component: Component) -> bool:
        """Say whether the promise is one that this component makes."""
        return isinstance(component, self.kinds) and self.where(component)

    def __call__(self, component: Component | type[Component]) -> None:
        """Find out whether a component keeps the promise.

        Raises
        ------
        Broken
            If it does not.
        Inapplicable
            If there is nothing to be tried.
        """
        with in_a_folder_of_its_own():
            self.examine(component)

    def __str__(self) -> str:
        return self.name


def promise(
    name: str, *kinds: type[Component], where: Callable[[Any], bool] = lambda _: True
) -> Callable[[Callable[[Any], None]], Check]:
    """Make a check of a function of one component, whose docstring is the promise; without kinds it concerns all."""

    def check(function: Callable[[Any], None]) -> Check:
        return Check(name, " ".join((function.__doc__ or "").split()), kinds or (Component,), function, where)

    return check


def expect(kept: object, message: str) -> None:
    """Raise `Broken` with a message unless something holds."""
    if not kept:
        raise Broken(message)
