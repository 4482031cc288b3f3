"""Lock: one process at a time adds runs to a study."""

import contextlib
import json
import os
import platform
from pathlib import Path
from types import TracebackType
from typing import IO, Self

from pathloom.study.errors import StudyError

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]


class Lock:
    """A lock on a file, held by a file beside it. The system gives it back when its holder dies, however it dies.

    The study's own file cannot serve: whoever opens and closes it would undo
    SQLite's locks on it.
    """

    def __init__(self, study: Path) -> None:
        self.study = study
        self.path = study.with_name(f"{study.name}-lock")
        self._file: IO[str] | None = None

    def __enter__(self) -> Self:
        while True:
            file = self.path.open("a+")
            try:
                _hold(file)
            except OSError:
                file.seek(0)
                holder = file.read(200)
                file.close()
                raise StudyError(f"{self.study}: {_who(holder)} is adding runs to it; wait until it is done") from None
            if self._is_in_place(file):
                break
            file.close()  # its holder took it away just now
        file.truncate(0)
        json.dump({"pid": os.getpid(), "host": platform.node()}, file)
        file.flush()
        self._file = file
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        assert self._file is not None, "entered before it is left"
        with contextlib.suppress(OSError):
            self.path.unlink()  # while it is held, so that nobody else loses theirs
        self._file.close()
        self._file = None

    def _is_in_place(self, file: IO[str]) -> bool:
        try:
            return os.path.samestat(os.fstat(file.fileno()), self.path.stat())
        except OSError:
            return False


def _hold(file: IO[str]) -> None:
    """Lock a file, or raise an OSError at once."""
    if fcntl is not None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return
    import msvcrt

    file.seek(1 << 16)  # beyond what is written, so that others can read who holds it
    msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)


def _who(holder: str) -> str:
    try:
        said = json.loads(holder)
        return f"process {said['pid']} on {said['host']}"
    except (ValueError, KeyError, TypeError):
        return "another process"
