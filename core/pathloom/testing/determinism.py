"""Determinism: what a component gives depends on parameters, inputs and the generator handed in, on nothing else."""

import atexit
import multiprocessing
import os
import pickle
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from tempfile import gettempdir

from pathloom.kernel.component import Component
from pathloom.testing.calls import called
from pathloom.testing.check import Broken, Inapplicable, expect, in_a_folder_of_its_own, promise
from pathloom.testing.plain import Plain, plain
from pathloom.testing.trial import carried_out, finished, outcome, some, trials


@promise("repeatable", where=called)
def repeatable(component: Component) -> None:
    """The same inputs and the same seed give the same bytes, however often it was called before."""
    again = {call.what for call in some(component)}
    for trial in finished(component):
        if trial.call.what not in again:
            continue
        second = carried_out(component, trial.call)
        expect(
            plain(second.output) == plain(trial.output),
            f"expected the same twice of one seed {trial.call.what}; found\n{trial.output}\nand then\n{second.output}",
        )


@promise("own-generator", where=called)
def own_generator(component: Component) -> None:
    """It draws from the generator that it is handed, and leaves the global ones alone."""
    for trial in trials(component):
        expect(
            not trial.drew, f"expected nothing drawn from global generators; found {trial.drew} used {trial.call.what}"
        )


@promise("other-process", where=called)
def other_process(component: Component) -> None:
    """Another process finds the same: nothing depends on hashes of texts, on ids or on the process."""
    try:
        frozen = pickle.dumps(component)
    except Exception as error:
        raise Inapplicable(f"it cannot be sent to another process: {error}") from error
    there = _pool().submit(_outcomes, frozen).result()
    if isinstance(there, str):
        raise Inapplicable(f"another process cannot take it up: {there}")
    for trial, elsewhere in zip(trials(component), there, strict=False):
        if outcome(trial) != elsewhere:
            raise Broken(f"expected {outcome(trial)} in another process too {trial.call.what}; found {elsewhere}")


def _outcomes(frozen: bytes) -> str | list[Plain]:
    try:
        component = pickle.loads(frozen)  # noqa: S301 - sent by the process that started this one
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    with in_a_folder_of_its_own():
        return [outcome(carried_out(component, call)) for call in some(component)]


@cache
def _pool() -> ProcessPoolExecutor:
    """Return the other process, one for all components. The folder in which it begins will be gone: it leaves it."""
    spawn = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(1, mp_context=spawn, initializer=os.chdir, initargs=(gettempdir(),))
    atexit.register(pool.shutdown)
    return pool


CHECKS = (repeatable, own_generator, other_process)
