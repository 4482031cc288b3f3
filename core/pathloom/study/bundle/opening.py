"""Opening: what a stranger's bundle may be before anything of it is used.

Nothing is unpacked under a name that the bundle gives, nothing is unpickled, and
of its database only tables are read that are made just as ours.
"""

import hashlib
import json
import sqlite3
import stat
import tempfile
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import AbstractContextManager, closing, contextmanager, nullcontext
from pathlib import Path, PurePosixPath
from typing import IO, Any

import numpy as np

from pathloom.files import LARGEST_MAP, FilePath, one_line, reason, shown
from pathloom.grid import OccupancyGrid
from pathloom.study.bundle.packing import DESIGN, STORE, SUMS, described
from pathloom.study.errors import StudyError
from pathloom.study.schema import APPLICATION, MIGRATIONS, VERSION
from pathloom.zips import UNREADABLE

MOST_MEMBERS = 20_000
LARGEST = 2 << 30
"""Bytes of all members, unpacked."""
LARGEST_TEXT = 64 << 20
"""Bytes of a member that is read as a whole."""
LARGEST_BLOB = 256 << 20
"""Bytes of a blob of the database, unpacked."""
PIECE = 1 << 20
FACTS: dict[str, Any] = {
    "kind": str, "runs": int, "seed": int, "time_limit": int | float | None, "budget": dict, "notes": list,
    "versions": dict, "created": str,
}  # fmt: skip
"""What is written down about a study as a whole, and of which kind it is."""
TABLES = (("variants", "config"), ("variants", "changes"), ("environments", "versions"))
"""Columns that hold a table in JSON."""


@contextmanager
def opened(path: FilePath) -> Iterator[tuple[Path, dict[str, Any]]]:
    """Check a bundle, and give the study's file in it, in a folder of ours, and what ``study.json`` says.

    Raises
    ------
    StudyError
        If it is no bundle, too large, damaged, or holds what no bundle holds.
    """
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / STORE
        design = _unpacked(path, store)
        yield store, design


def _unpacked(path: FilePath, store: Path) -> dict[str, Any]:
    """Check a bundle, write the study's file to where it is told, and return what ``study.json`` says."""
    try:
        with zipfile.ZipFile(path) as archive:
            _check_members(path, archive)
            _check_sums(path, archive, store)
            design = _design(path, archive)
    except UNREADABLE as error:
        raise StudyError(f"{path}: found no whole zip file ({one_line(str(error))}), allowed a bundle") from error
    except FileNotFoundError as error:
        raise StudyError(f"{path}: found no such file, allowed a bundle") from error
    except OSError as error:
        raise StudyError(f"{path}: found an unreadable file ({reason(error)}), allowed a bundle") from error
    _check_store(path, store)
    return design


def unzipped(blob: Any, most: int = LARGEST_BLOB) -> bytes:
    """Return the content of a blob of a database.

    Raises
    ------
    ValueError
        If it is none, or larger than allowed.
    """
    if not isinstance(blob, bytes):
        raise ValueError(f"found {shown(blob)}, allowed a blob")  # noqa: TRY004 - a fault of the file's
    unpacker = zlib.decompressobj()
    try:
        data = unpacker.decompress(blob, most)
    except zlib.error as error:
        raise ValueError(f"found a damaged blob: {error}") from error
    if not unpacker.eof:
        raise ValueError(f"found a blob that is cut off or larger than {most} bytes")
    return data


def _check_members(path: FilePath, archive: zipfile.ZipFile) -> None:
    members = archive.infolist()
    if len(members) > MOST_MEMBERS:
        raise StudyError(f"{path}: found {len(members)} files, allowed at most {MOST_MEMBERS}")
    total, seen = 0, set()
    for member in members:
        name, parts = member.filename, PurePosixPath(member.filename).parts
        kind = stat.S_IFMT(member.external_attr >> 16)
        if (
            not parts or name.startswith("/") or ".." in parts or "\\" in name or ":" in name or not name.isprintable()
        ):  # no such name is ever written to, but a bundle of ours has none
            raise StudyError(f"{path}: found a file called {shown(name)}, allowed names within the bundle")
        if kind not in (0, stat.S_IFREG) or member.is_dir() or member.flag_bits & 1:
            raise StudyError(f"{path}: {shown(name)}: found a link, a folder or a locked file, allowed plain files")
        if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise StudyError(
                f"{path}: {shown(name)}: found compression {member.compress_type}, allowed 0 or 8 (deflate)"
            )
        if name in seen:
            raise StudyError(f"{path}: found {shown(name)} twice, allowed once")
        seen.add(name)
        total += member.file_size
    if total > LARGEST:
        raise StudyError(f"{path}: found {total} bytes, allowed at most {LARGEST}")
    for name in (STORE, SUMS, DESIGN):
        if name not in seen:
            raise StudyError(f"{path}: found no {name}, allowed what pathloom study bundle writes")


def _pieces(path: FilePath, stream: IO[bytes], size: int) -> Iterator[bytes]:
    """Yield a member's content; what it is beyond the size that it states is refused."""
    left = size
    while piece := stream.read(PIECE):
        left -= len(piece)
        if left < 0:
            raise StudyError(f"{path}: found a file larger than it states")
        yield piece


def _check_sums(path: FilePath, archive: zipfile.ZipFile, store: Path) -> None:
    """Check the content of all members, and write the study's file to where it is told."""
    lines = _text(path, archive, SUMS).splitlines()
    stated = {name: digest for digest, _, name in (line.partition("  ") for line in lines)}
    for member in archive.infolist():
        if member.filename == SUMS:
            continue
        digest = hashlib.sha256()
        target: AbstractContextManager[IO[bytes] | None] = (
            store.open("wb") if member.filename == STORE else nullcontext()
        )
        with archive.open(member) as stream, target as file:
            for piece in _pieces(path, stream, member.file_size):
                digest.update(piece)
                if file is not None:
                    file.write(piece)
        if stated.get(member.filename) != digest.hexdigest():
            raise StudyError(f"{path}: {shown(member.filename)} is not what {SUMS} says")
    missing = stated.keys() - {member.filename for member in archive.infolist()}
    if missing:
        raise StudyError(f"{path}: found no {shown(min(missing))}, which {SUMS} names")


def _text(path: FilePath, archive: zipfile.ZipFile, name: str) -> str:
    member = archive.getinfo(name)
    if member.file_size > LARGEST_TEXT:
        raise StudyError(f"{path}: {name}: found {member.file_size} bytes, allowed at most {LARGEST_TEXT}")
    with archive.open(member) as stream:
        data = b"".join(_pieces(path, stream, member.file_size))
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise StudyError(f"{path}: {name}: found no UTF-8") from error


def _design(path: FilePath, archive: zipfile.ZipFile) -> dict[str, Any]:
    try:
        design = json.loads(_text(path, archive, DESIGN))
    except (ValueError, RecursionError) as error:
        raise StudyError(f"{path}: {DESIGN}: found no JSON") from error
    if not described(design):
        raise StudyError(f"{path}: {DESIGN}: found no description of a bundle that this pathloom knows")
    return dict(design)


def _check_store(path: FilePath, store: Path) -> None:
    """Check that a database is a study, made of our tables and of nothing else, and that its maps are maps."""
    try:
        with closing(sqlite3.connect(f"{store.as_uri()}?mode=ro", uri=True)) as db:
            db.execute("PRAGMA trusted_schema = OFF")
            db.execute("PRAGMA cell_size_check = ON")
            marked, version = (
                db.execute(f"PRAGMA {name}").fetchone()[0] for name in ("application_id", "user_version")
            )
            if marked != APPLICATION:
                raise StudyError(f"{path}: {STORE}: found a database that is no study, allowed a study")
            if not 0 < version <= VERSION:
                raise StudyError(
                    f"{path}: {STORE}: found a study of version {version}, allowed up to {VERSION}: "
                    "it was written by a newer pathloom"
                )
            if _schema(db) != _ours(version):
                raise StudyError(f"{path}: {STORE}: found tables, views or triggers other than a study's")
            if db.execute("PRAGMA integrity_check(1)").fetchone()[0] != "ok":
                raise StudyError(f"{path}: {STORE}: the file is damaged")
            _check_texts(path, db)
            for sha256, *map_ in db.execute("SELECT sha256, height, width, cells FROM maps"):
                _check_map(path, sha256, *map_)
    except sqlite3.Error as error:
        raise StudyError(f"{path}: {STORE}: the file is damaged ({one_line(str(error))})") from error


def _check_texts(path: FilePath, db: sqlite3.Connection) -> None:
    """Check that what should be JSON of some kind is, and that runs are numbered."""
    facts = db.execute("SELECT name, value FROM study").fetchall()
    if not FACTS.keys() <= {name for name, _ in facts}:
        raise StudyError(f"{path}: {STORE}: found a study that never began, allowed one with a design")
    tables = [("study", name, FACTS.get(name, object), value) for name, value in facts]
    tables += [(t, c, dict, v) for t, c in TABLES for (v,) in db.execute(f"SELECT {c} FROM {t}")]  # noqa: S608 - ours
    for table, name, kind, text in tables:
        try:
            fits = isinstance(text, str) and len(text) <= LARGEST_TEXT and isinstance(json.loads(text), kind)
        except (ValueError, RecursionError):
            fits = False
        if not fits:
            raise StudyError(f"{path}: {STORE}: {table}: {shown(name)}: found {shown(text)}, which no study holds")
    if db.execute("SELECT 1 FROM runs WHERE typeof(seed) <> 'integer' OR seed < 0 LIMIT 1").fetchone():
        raise StudyError(f"{path}: {STORE}: found a run without a seed")


def _schema(db: sqlite3.Connection) -> set[tuple[str, ...]]:
    """Return what a database is made of, but for the indices that SQLite makes by itself."""
    return set(db.execute("SELECT type, name, tbl_name, sql FROM sqlite_master WHERE sql IS NOT NULL"))


def _ours(version: int) -> set[tuple[str, ...]]:
    with closing(sqlite3.connect(":memory:")) as db:
        for number in range(version):
            db.executescript(MIGRATIONS[number])
        return _schema(db)


def _check_map(path: FilePath, sha256: Any, height: Any, width: Any, cells: Any) -> None:
    where = f"{path}: {STORE}: map {shown(sha256)}"
    if not (isinstance(height, int) and isinstance(width, int) and height > 0 and width > 0):
        raise StudyError(f"{where}: found no size")
    if height * width > LARGEST_MAP:
        raise StudyError(f"{where}: found {height} x {width} cells, allowed at most {LARGEST_MAP}")
    size = -(-height * width // 8)
    try:
        data = unzipped(cells, size)
    except ValueError as error:
        raise StudyError(f"{where}: {error}") from error
    if len(data) != size:
        raise StudyError(f"{where}: found {len(data)} bytes of cells, allowed {size}")
    bits = np.unpackbits(np.frombuffer(data, np.uint8), count=height * width)
    if OccupancyGrid(bits.reshape(height, width).astype(bool)).sha256 != sha256:
        raise StudyError(f"{where}: its cells are others than its hash says")
