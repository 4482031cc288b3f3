"""Kernels give the same compiled and as plain Python; loading them tells how far it is."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from compiled import every_kernel
from pathloom import compiled
from pathloom.compiled import jit


@pytest.fixture(scope="module")
def plain() -> dict[str, list]:
    """Return the results of a process in which numba compiles nothing."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore:overflow:RuntimeWarning", every_kernel.__file__],
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        cwd=Path(__file__).parents[2],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_every_kernel_gives_the_same_as_plain_python(plain: dict[str, list]) -> None:
    compiled_here = json.loads(json.dumps(every_kernel.results()))
    assert plain.keys() == compiled_here.keys()
    assert [name for name, value in plain.items() if value != compiled_here[name]] == []


def test_there_are_no_other_families() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'kernels'"):
        _ = compiled.kernels


def compile_something_new() -> float:
    """Compile a function without a file, for which there can be no cache."""
    namespace = {}
    exec("def hypotenuse(a, b):\n    return (a * a + b * b) ** 0.5", namespace)
    return jit.kernel("f8(f8, f8)")(namespace["hypotenuse"])(3.0, 4.0)


def test_who_listens_hears_of_a_kernel_that_had_to_be_compiled() -> None:
    heard = []
    with jit.listening(lambda done, of: heard.append(of - done)), jit.loading("walks"):
        assert compile_something_new() == 5.0
    assert len(heard) == 1


def test_who_no_longer_listens_hears_nothing() -> None:
    heard = []
    with jit.listening(lambda done, of: heard.append(done)):
        pass
    compile_something_new()
    assert heard == []
