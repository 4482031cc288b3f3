"""Lanes: where orders are sent. All of it is `concurrent.futures.Executor`.

Locally each worker is an executor of one process. So it is known which order a
lost process had in its hands, the others lose nothing, and a run that does not
stop can be ended with its process. A Dask cluster is one lane of many threads:
its scheduler sends what a lost worker had to another one by itself.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Mapping
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import suppress
from multiprocessing import active_children, get_context
from typing import Any

from pathloom.errors import ConfigError
from pathloom.study.errors import StudyError
from pathloom.study.worker import Order, Reply, hello, perform, prepare

FALSE_STARTS = 3
"""Workers that may die one after the other before they have said hello."""


class Lane(ABC):
    """Takes orders, at most as many at a time as it has room for."""

    room: int
    """Orders that may be under way: two for each worker, so that none waits for the driver."""
    tells_the_culprit = False
    """Whether the oldest order under way is the one that a lost worker had in its hands."""
    ends_by_force = False
    """Whether a run that does not stop can be ended from outside."""

    def __init__(self) -> None:
        self.flying: dict[Future[Any], Order] = {}

    @abstractmethod
    def executor(self) -> Executor:
        """Return what orders are submitted to."""

    def send(self, order: Order) -> Future[Reply]:
        """Send an order."""
        future = self.executor().submit(perform, order)
        self.flying[future] = order
        return future

    @abstractmethod
    def renew(self) -> None:
        """Begin again after a worker was lost; what was under way is forgotten."""

    @abstractmethod
    def stop(self) -> None:
        """End everything at once; what is under way is lost."""

    def began(self) -> bool:
        """Say whether a worker came as far as to take an order."""
        return True

    def overdue(self, patience: float) -> bool:
        """Say whether the oldest order has been under way for longer than this, in seconds."""
        return False

    def answered(self, future: Future[Any]) -> None:
        """Note that an order is done."""
        del self.flying[future]


class LocalLane(Lane):
    """One process of this machine."""

    room = 2
    tells_the_culprit = True
    ends_by_force = True

    def __init__(self, memory: int | None = None) -> None:
        super().__init__()
        self.memory = memory
        self._executor: ProcessPoolExecutor | None = None
        self._hello: Future[tuple[int, dict[str, Any]]] | None = None
        self._pid: int | None = None
        self._since = 0.0
        self._false_starts = 0

    def executor(self) -> Executor:
        if self._executor is None:
            self._executor = ProcessPoolExecutor(
                1, mp_context=get_context("spawn"), initializer=prepare, initargs=(self.memory,)
            )
            self._hello = self._executor.submit(hello)
            self._pid = None
        return self._executor

    @property
    def pid(self) -> int | None:
        """The worker's process, once it has said hello."""
        if self._pid is None and self._hello is not None and self._hello.done():
            with suppress(Exception):
                self._pid = self._hello.result()[0]
                self._false_starts = 0
                self._since = time.monotonic()
        return self._pid

    def send(self, order: Order) -> Future[Reply]:
        if not self.flying:
            self._since = time.monotonic()
        return super().send(order)

    def answered(self, future: Future[Any]) -> None:
        super().answered(future)
        self._since = time.monotonic()  # the next one begins now

    def overdue(self, patience: float) -> bool:
        return bool(self.flying) and self.pid is not None and time.monotonic() - self._since > patience

    def began(self) -> bool:
        return self.pid is not None

    def renew(self) -> None:
        if not self.began():
            self._false_starts += 1
            if self._false_starts >= FALSE_STARTS:
                raise StudyError(
                    "worker processes end before they have begun; a script that begins a study needs "
                    "`if __name__ == '__main__':` around it"
                )
        self.stop()

    def stop(self) -> None:
        executor, pid = self._executor, self.pid
        self._executor = self._hello = self._pid = None
        self.flying.clear()
        if executor is None:
            return
        started = getattr(executor, "_processes", None) or {}  # they are no secret, but one cannot ask for them either
        for process in list(started.values()) or [child for child in active_children() if child.pid == pid]:
            with suppress(Exception):
                process.kill()
        executor.shutdown(wait=False, cancel_futures=True)


class DaskLane(Lane):
    """An existing Dask cluster.

    How many workers a run may lose there, the scheduler decides (``distributed.scheduler.allowed-failures``).
    """

    def __init__(self, address: str, expected: Mapping[str, Any]) -> None:
        super().__init__()
        self.address = address
        try:
            from distributed import Client as AnyClient
        except ImportError:
            raise ConfigError("--dask: needs the package distributed: pip install 'pathloom[dask]'") from None
        try:
            client: Any = AnyClient  # it is not typed
            self._client = client(address, timeout=10, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            cause = " ".join(str(error).split()) or type(error).__name__
            raise StudyError(f"--dask {address}: no Dask scheduler answers there ({cause[:200]})") from error
        try:
            self._check_workers(expected)
        except BaseException:
            self.stop()
            raise
        self._pool = self._client.get_executor(pure=False)

    def _check_workers(self, expected: Mapping[str, Any]) -> None:
        """Make sure that all workers are there, and the same as the driver in all that results depend on."""
        threads = self._client.nthreads()
        if not threads:
            raise StudyError(f"--dask {self.address}: the cluster has no workers")
        self.room = 2 * sum(threads.values())
        try:
            said = self._client.run(hello)
        except Exception as error:
            cause = " ".join(f"{type(error).__name__}: {error}".split())
            raise StudyError(f"--dask {self.address}: pathloom does not run on the workers ({cause[:200]})") from error
        for worker, (_, found) in said.items():
            for name in ("pathloom", "python", "numpy", "numba"):
                if found[name] != expected[name]:
                    there = f"found {name} {found[name]} on {worker}"
                    raise StudyError(f"--dask {self.address}: {there}, allowed {expected[name]} as here")
            for plugin, version in expected["plugins"].items():
                if found["plugins"].get(plugin) != version:
                    there = f"found {found['plugins'].get(plugin, 'nothing')} as plugin {plugin!r} on {worker}"
                    raise StudyError(f"--dask {self.address}: {there}, allowed {version} as here")

    def executor(self) -> Executor:
        return self._pool  # type: ignore[no-any-return]

    def renew(self) -> None:
        raise StudyError(f"--dask {self.address}: the cluster is gone; the runs so far are kept: start again to go on")

    def stop(self) -> None:
        self.flying.clear()
        with suppress(Exception):
            self._client.close(timeout=2)
