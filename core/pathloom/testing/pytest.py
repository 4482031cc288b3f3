"""A plugin of pytest: one test for each promise of each component of a package.

It costs nothing where nobody asks for it. A package whose tests want it says so in its ``conftest.py``::

    pytest_plugins = ["pathloom.testing.pytest"]

names its plugin in ``pyproject.toml``, or on the command line with ``--pathloom acme``::

    [tool.pytest.ini_options]
    pathloom = "acme"

and has one test, which asks for ``promise``::

    def test_the_contract(promise):
        promise()
"""

from collections.abc import Generator

import pytest

from pathloom.testing.check import Inapplicable
from pathloom.testing.package import promises_of

WORDS = "plugin of pathloom, or package with plugins, whose components the fixture `promise` stands for"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let a package be named."""
    parser.getgroup("pathloom").addoption("--pathloom", metavar="PACKAGE", help=WORDS)
    parser.addini("pathloom", WORDS, default="")


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Make one test of each promise."""
    if "promise" not in metafunc.fixturenames:
        return
    package = metafunc.config.getoption("--pathloom") or metafunc.config.getini("pathloom")
    if not package:
        raise pytest.UsageError(
            "`promise` is asked for: name a package with --pathloom, or as `pathloom` in the ini file"
        )
    promises = list(promises_of(package))
    metafunc.parametrize("promise", promises, ids=map(str, promises))


@pytest.hookimpl(wrapper=True)
def pytest_pyfunc_call() -> Generator[None, object, object]:
    """Skip a test whose promise cannot be tried, and say why."""
    try:
        return (yield)
    except Inapplicable as reason:
        pytest.skip(str(reason))
