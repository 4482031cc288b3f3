"""Read and replace files so that whatever is wrong with one becomes a single line."""

import contextlib
import os
import re
import reprlib
import secrets
import stat
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path

from pathloom.errors import MapError
from pathloom.naming import meant

LARGEST_FILE = 1 << 29
"""Bytes (512 MiB) beyond which a file is refused unread; no map in use comes near."""

LARGEST_MAP = 1 << 26
"""Cells (67 million, 8192 x 8192) beyond which a map is refused undecoded."""

MOST_NAMES = 10_000
"""Names of a folder that are looked at for a hint."""

FilePath = str | os.PathLike[str]
"""How a caller may name a file; messages show it as given."""


def refusal(path: FilePath, where: str, found: str, allowed: str, hint: str = "") -> MapError:
    """Return the error that says where in which file what was found, in one line.

    Parameters
    ----------
    path
        The file as the user named it; it is shown that way.
    where
        Line, column or key; empty when it is the file as a whole.
    found, allowed
        What stands there, what may stand there.
    hint
        What was probably meant, from `meant`; may be empty.
    """
    place = f"{where}: " if where else ""
    ending = f"; {hint}" if hint else ""
    return MapError(one_line(f"{os.fspath(path)}: {place}found {found}, allowed {allowed}{ending}"))


def one_line(text: str) -> str:
    """Return `text` with line ends as single blanks and other unprintable signs as `?`."""
    joined = re.sub(r"\s*[\r\n]+\s*", " ", text)
    return "".join(sign if sign.isprintable() else "?" for sign in joined)


def shown(value: object) -> str:
    """Return a short quotation of something found, however long or deep it is."""
    try:
        return reprlib.repr(value)
    except ValueError:  # an integer with more digits than Python is willing to print
        return f"a huge {type(value).__name__}"


def neighbour(path: FilePath, suffix: str = "") -> str:
    """Return a hint to the file of the same folder, with that suffix, named most like `path`."""
    sought = Path(path)
    try:
        with os.scandir(sought.parent) as entries:
            names = [entry.name for entry in islice(entries, MOST_NAMES) if entry.name.endswith(suffix)]
    except (OSError, ValueError):
        return ""
    return meant(sought.name, names)


def content(path: FilePath, first: int = -1) -> bytes:
    """Return the bytes of a regular file, or as many of its first ones.

    Raises
    ------
    MapError
        If there is no such file, if it is a folder, a device or a pipe, if it is
        larger than `LARGEST_FILE`, empty, or cannot be read.
    """
    file = _nameable(path)
    try:
        status = file.stat()
        if not stat.S_ISREG(status.st_mode):  # reading a pipe or a terminal could wait forever
            found = "a folder" if stat.S_ISDIR(status.st_mode) else "a device or a pipe"
            raise refusal(path, "", found, "a file")
        if status.st_size > LARGEST_FILE:
            raise refusal(path, "", f"{status.st_size} bytes", f"at most {LARGEST_FILE}")
        with file.open("rb") as stream:
            data = stream.read(first)
    except FileNotFoundError:
        raise refusal(path, "", "no such file", "an existing one", neighbour(path)) from None
    except OSError as error:
        raise refusal(path, "", f"an unreadable file ({reason(error)})", "a readable one") from error
    if not data:
        raise refusal(path, "", "an empty file", "one with content")
    return data


def _nameable(path: FilePath) -> Path:
    """Return a path that the system can at least be asked for."""
    try:
        name = os.fsencode(path)
    except UnicodeEncodeError:
        name = b"\0"
    if b"\0" in name:
        raise refusal(path, "", "a name that no file can have", "the name of a file")
    return Path(path)


def reason(error: OSError) -> str:
    """Return what the system says about a failure, without number and file name."""
    return error.strerror or str(error) or type(error).__name__


def text(path: FilePath) -> str:
    """Return a file as text: UTF-8, of which ASCII is a part, with or without a byte order mark.

    Raises
    ------
    MapError
        As `content`, or if the bytes are not UTF-8.
    """
    data = content(path)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        found = f"the byte 0x{data[error.start]:02x}, which is not text in UTF-8"
        raise refusal(path, f"line {line}", found, "a text file") from error


def lines(path: FilePath) -> list[str]:
    """Return the lines of a text file without LF or CRLF, blank ones at the end left out.

    Only LF ends a line: `str.splitlines` would also break at signs that belong to the text.

    Raises
    ------
    MapError
        As `text`, or if no line is left.
    """
    found = [line.removesuffix("\r") for line in text(path).split("\n")]
    while found and not found[-1].strip():
        found.pop()
    if not found:
        raise refusal(path, "", "nothing but blank lines", "one with content")
    return found


def make_folder(path: FilePath) -> Path:
    """Return a folder, which is made unless it is there, in an existing one.

    Raises
    ------
    MapError
        If it cannot be made.
    """
    folder = _nameable(path)
    try:
        folder.mkdir(exist_ok=True)
    except FileNotFoundError as error:
        raise refusal(path, "", "no such folder", "a new folder in an existing one") from error
    except FileExistsError as error:
        raise refusal(path, "", "a file", "a folder") from error
    except OSError as error:
        raise refusal(path, "", f"a place not writable ({reason(error)})", "a writable folder") from error
    return folder


@contextlib.contextmanager
def appending(path: FilePath) -> Iterator[Callable[[str], None]]:
    """Give a function that adds text to a file, begun anew, which others can read while it grows.

    Raises
    ------
    MapError
        If the folder is missing or not writable, or `path` is a folder.
    """
    target = _nameable(path)
    try:
        if target.is_dir():
            raise refusal(path, "", "a folder", "a file to write")
        stream = target.open("w", encoding="utf-8", newline="\n")
    except FileNotFoundError as error:
        raise refusal(path, "", "no such folder", "a file in an existing folder") from error
    except OSError as error:
        raise refusal(path, "", f"a place not writable ({reason(error)})", "a writable folder") from error

    def write(text: str) -> None:
        try:
            stream.write(text)
            stream.flush()
        except OSError as error:
            raise refusal(path, "", f"a place not writable ({reason(error)})", "a disk with room") from error

    with contextlib.closing(stream):
        yield write


def replace(path: FilePath, data: bytes) -> None:
    """Write a file as a whole: readers see the old content or the new one, never a part.

    Raises
    ------
    MapError
        If the folder is missing or not writable, or `path` is a folder or a device.
    """
    target = _nameable(path)
    draft = target.with_name(f".{target.name}.{secrets.token_hex(4)}.part")
    try:
        if target.exists() and not target.is_file():  # a rename would take a device's place
            raise refusal(path, "", "a folder or a device", "a file to write")
        with draft.open("xb") as stream:
            stream.write(data)
        draft.replace(target)
    except FileNotFoundError as error:
        raise refusal(path, "", "no such folder", "a file in an existing folder") from error
    except OSError as error:
        raise refusal(path, "", f"a place not writable ({reason(error)})", "a writable folder") from error
    finally:
        with contextlib.suppress(OSError):
            draft.unlink(missing_ok=True)
