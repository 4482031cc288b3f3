"""Work that would keep the server from answering, done in threads beside it."""

import asyncio
import threading
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

T = TypeVar("T")


class Workers:
    """So many threads at once; whoever comes later waits.

    A step of a planner cannot be broken off, so that work that nobody waits for
    any more still counts until it ends. The threads are daemons: the server ends
    without waiting for them.
    """

    def __init__(self, most: int = 4) -> None:
        self._free = asyncio.Semaphore(most)

    async def do(self, work: Callable[[], T]) -> T:
        """Return what ``work`` returns, or raise what it raises."""
        await self._free.acquire()
        loop = asyncio.get_running_loop()
        future: asyncio.Future[T] = loop.create_future()

        def settle(value: T | None, error: BaseException | None) -> None:
            self._free.release()
            if future.cancelled():
                return
            if error is not None:
                future.set_exception(error)
            else:
                future.set_result(value)  # type: ignore[arg-type]  # None only where T is

        def run() -> None:
            value, error = None, None
            try:
                value = work()
            except BaseException as raised:
                error = raised
            with suppress(RuntimeError):  # the server has ended meanwhile
                loop.call_soon_threadsafe(settle, value, error)

        threading.Thread(target=run, name="pathloom studio", daemon=True).start()
        return await future
