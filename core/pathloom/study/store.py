"""Store: the one file of a study. Every finished run is in it before the next is waited for."""

import hashlib
import json
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import msgspec
import numpy as np

from pathloom.errors import PathloomError
from pathloom.files import one_line
from pathloom.grid import OccupancyGrid
from pathloom.kernel.compose import compose, freeze
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry
from pathloom.paths.problem import PathProblem
from pathloom.study.design import Variant
from pathloom.study.errors import StudyError
from pathloom.study.instances import Instance
from pathloom.study.row import NAMES, Row
from pathloom.study.schema import APPLICATION, MIGRATIONS, VERSION

MEMORY = ":memory:"

MEASURES = (
    "status", "length", "fitness", "turns", "turn_angle", "min_clearance", "unsafe_nodes", "nodes", "gap_grid",
    "gap_any_angle", "gap_bound", "hypervolume", "hypervolume_ratio", "evaluations", "evaluations_to_first",
    "evaluations_to_one_percent", "generations", "seconds", "error", "phases", "objectives", "counts", "attempts",
)  # fmt: skip
"""Columns of ``runs`` that are measured."""


class Key(NamedTuple):
    """Which run: ids of its instance and variant, and its seed."""

    instance: int
    seed: int
    variant: int


@dataclass(frozen=True)
class Finished:
    """A run that is over, as it is written down."""

    key: Key
    measures: Mapping[str, Any]
    """Some of `MEASURES`."""
    history: bytes | None = None
    path: bytes | None = None
    front: bytes | None = None


@dataclass(frozen=True)
class References:
    """What is known of an instance, whoever solves it."""

    reachable: bool | None = None
    grid: float | None = None
    any_angle: float | None = None
    any_angle_bound: float | None = None
    exact_front: bytes | None = None
    """Values (n, m) of the exact front of the study's objectives, packed."""
    note: str = ""


def packed(value: Any) -> bytes:
    """Return a value as compressed JSON; numbers that JSON cannot say become null."""
    return zlib.compress(msgspec.json.encode(value), 6)


def unpacked(blob: bytes) -> Any:
    """Return the value in compressed JSON."""
    return msgspec.json.decode(zlib.decompress(blob))


class Store:
    """A study's file, or its memory. One process writes; any number may read."""

    def __init__(self, path: str | Path, *, create: bool = False) -> None:
        """Open a store.

        Raises
        ------
        StudyError
            If there is none and none is to be made, or the file is no study, is
            damaged, or was written by a newer pathloom.
        """
        self.name = str(path)
        self._where = MEMORY if self.name == MEMORY else Path(path)
        self._environment: int | None = None
        self._identities: dict[tuple[int, int], str] = {}
        if isinstance(self._where, Path):
            if not self._where.is_file() and not create:
                raise StudyError(f"{self.name}: found no such file, allowed a study")
            if self._where.is_dir() or not self._where.parent.is_dir():
                raise StudyError(f"{self.name}: found a folder or no folder to write to, allowed a file")
        with self._told():
            self._db = sqlite3.connect(str(self._where), isolation_level=None, timeout=30.0, check_same_thread=False)
            try:
                self._prepare(new=create and self._is_empty())
            except BaseException:
                self._db.close()
                raise

    def _is_empty(self) -> bool:
        return not self._db.execute("SELECT 1 FROM sqlite_master LIMIT 1").fetchone()

    def _prepare(self, *, new: bool) -> None:
        self._db.execute("PRAGMA foreign_keys = ON")
        self._db.execute("PRAGMA synchronous = FULL")  # what is written outlives the machine
        if not new:
            marked, version = (self._pragma(name) for name in ("application_id", "user_version"))
            if marked != APPLICATION:
                raise StudyError(f"{self.name}: found a database that is no study, allowed a study")
            if version > VERSION:
                raise StudyError(
                    f"{self.name}: found a study of version {version}, allowed up to {VERSION}: "
                    "it was written by a newer pathloom"
                )
        else:
            version = 0
        if version < VERSION:
            self._db.execute("PRAGMA journal_mode = WAL")
            for number in range(version, VERSION):
                self._db.executescript(
                    f"BEGIN IMMEDIATE; {MIGRATIONS[number]}; PRAGMA application_id = {APPLICATION}; "
                    f"PRAGMA user_version = {number + 1}; COMMIT;"
                )

    def _pragma(self, name: str) -> int:
        return int(self._db.execute(f"PRAGMA {name}").fetchone()[0])

    def close(self) -> None:
        """Close the file; what was written is in it, in one piece."""
        self._db.close()

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Say in one line what is wrong with the file."""
        try:
            yield
        except sqlite3.Error as error:
            raise StudyError(f"{self.name}: {_in_words(error)}") from error

    @contextmanager
    def writing(self) -> Iterator[sqlite3.Connection]:
        """Do everything within, or nothing: a full disk or a kill leaves the file as it was before."""
        with self._told():
            self._db.execute("BEGIN IMMEDIATE")
            try:
                yield self._db
                self._db.execute("COMMIT")
            except BaseException:
                if self._db.in_transaction:
                    self._db.execute("ROLLBACK")
                raise

    def reading(self, statement: str, *values: Any) -> Iterator[tuple[Any, ...]]:
        """Yield the rows that a statement selects."""
        with self._told():
            for row in self._db.execute(statement, values):  # noqa: UP028 - a reader who stops leaves no cursor behind
                yield row

    def check(self) -> None:
        """Raise a `StudyError` if the file is damaged."""
        for (found,) in self.reading("PRAGMA quick_check(1)"):
            if found != "ok":
                raise StudyError(f"{self.name}: the file is damaged: {one_line(str(found))}")

    # What the study is.

    def facts(self) -> dict[str, Any]:
        """Return what is written down about the study as a whole."""
        return {name: json.loads(value) for name, value in self.reading("SELECT name, value FROM study")}

    def set_facts(self, facts: Mapping[str, Any]) -> None:
        """Write down something about the study as a whole."""
        with self.writing() as db:
            db.executemany("INSERT OR REPLACE INTO study VALUES (?, ?)", [(k, json.dumps(v)) for k, v in facts.items()])

    def add(self, variants: Sequence[Variant], instances: Sequence[Instance], facts: Mapping[str, Any]) -> None:
        """Add variants and instances that are not there yet, all of them or, if anything fails, none."""
        known_variants, known_instances = self.variant_ids(), self.instance_ids()
        with self.writing() as db:
            db.executemany("INSERT OR REPLACE INTO study VALUES (?, ?)", [(k, json.dumps(v)) for k, v in facts.items()])
            for variant in variants:
                if variant.name not in known_variants:
                    config = json.dumps(freeze(variant.planner), ensure_ascii=False)  # objectives keep their order
                    name = default_registry().name_of(type(variant.planner)).rpartition("/")[2]
                    db.execute(
                        "INSERT INTO variants (name, planner, config, sha256, changes) VALUES (?, ?, ?, ?, ?)",
                        (variant.name, name, config, _sha(config), json.dumps(dict(variant.changes))),
                    )
            for instance in instances:
                if instance.name not in known_instances:
                    self._add_instance(db, instance)

    @staticmethod
    def _add_instance(db: sqlite3.Connection, instance: Instance) -> None:
        it, grid = instance.problem, instance.problem.grid
        cells = zlib.compress(np.packbits(grid.occupied).tobytes(), 6)
        db.execute("INSERT OR IGNORE INTO maps VALUES (?, ?, ?, ?)", (grid.sha256, grid.height, grid.width, cells))
        db.execute(
            "INSERT INTO instances (name, map, map_sha256, resolution, origin, start_row, start_col, goal_row, "
            "goal_col, corners, radius, stated_optimum) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
            (
                *(instance.name, instance.map, grid.sha256, grid.resolution),
                *(None if grid.origin is None else json.dumps(grid.origin), *it.ends[0], *it.ends[1]),
                *(it.corners, it.radius, instance.stated),
            ),
        )

    def variant_ids(self) -> dict[str, int]:
        """Return the ids of the variants by name, in order."""
        return {name: number for number, name in self.reading("SELECT id, name FROM variants ORDER BY id")}

    def instance_ids(self) -> dict[str, int]:
        """Return the ids of the instances by name, in order."""
        return {name: number for number, name in self.reading("SELECT id, name FROM instances ORDER BY id")}

    def configs(self) -> dict[str, dict[str, Any]]:
        """Return the complete configs of the variants by name."""
        return {
            name: json.loads(config) for name, config in self.reading("SELECT name, config FROM variants ORDER BY id")
        }

    def changes(self) -> dict[str, dict[str, str]]:
        """Return what each variant changes of the base, by slot."""
        return {name: json.loads(what) for name, what in self.reading("SELECT name, changes FROM variants ORDER BY id")}

    def planner(self, variant: str) -> Planner:
        """Return the planner of a variant.

        Raises
        ------
        StudyError
            If a part of it is not installed here.
        """
        try:
            return compose(self.configs()[variant])
        except PathloomError as error:
            raise StudyError(f"{self.name}: variant {variant!r} cannot be built here: {error}") from error

    def problem(self, instance: str) -> PathProblem:
        """Return the problem of an instance, as it was, whatever has become of the map's file."""
        query = (
            "SELECT i.map, m.height, m.width, m.cells, i.resolution, i.origin, i.start_row, i.start_col, i.goal_row, "
            "i.goal_col, i.radius, i.corners FROM instances i JOIN maps m ON m.sha256 = i.map_sha256 WHERE i.name = ?"
        )
        found = next(self.reading(query, instance), None)
        if found is None:
            raise StudyError(f"{self.name}: no instance is called {instance!r}")
        name, height, width, cells, resolution, origin, r0, c0, r1, c1, radius, corners = found
        grid = _grid(name, height, width, cells, resolution, origin)
        return PathProblem(grid, start=(r0, c0), goal=(r1, c1), radius=radius, corners=corners)

    # What is known of instances.

    def unmeasured(self) -> list[str]:
        """Return the names of the instances whose optima were not looked for yet."""
        return [name for (name,) in self.reading("SELECT name FROM instances WHERE NOT measured ORDER BY id")]

    def set_references(self, instance: str, found: References) -> None:
        """Write down what is known of an instance."""
        with self.writing() as db:
            db.execute(
                "UPDATE instances SET measured = 1, reachable = ?, optimum_grid = ?, optimum_any_angle = ?, "
                "any_angle_bound = ?, exact_front = ?, note = ? WHERE name = ?",
                (
                    *(found.reachable, found.grid, found.any_angle, found.any_angle_bound),
                    *(found.exact_front, found.note or None, instance),
                ),
            )

    def references(self, instance: int) -> References:
        """Return what is known of an instance."""
        query = (
            "SELECT reachable, optimum_grid, optimum_any_angle, any_angle_bound, exact_front, note "
            "FROM instances WHERE id = ?"
        )
        reachable, grid, any_angle, bound, front, note = next(self.reading(query, instance))
        return References(None if reachable is None else bool(reachable), grid, any_angle, bound, front, note or "")

    # Runs.

    def environment(self, versions: Mapping[str, Any]) -> None:
        """Say with which versions the runs are made that are written from now on."""
        text = json.dumps(versions, sort_keys=True)
        with self.writing() as db:
            db.execute("INSERT OR IGNORE INTO environments (versions) VALUES (?)", (text,))
            self._environment = db.execute("SELECT id FROM environments WHERE versions = ?", (text,)).fetchone()[0]
        self._identities.clear()

    def environments(self) -> list[dict[str, Any]]:
        """Return the versions with which runs were made."""
        query = (
            "SELECT versions FROM environments WHERE EXISTS (SELECT 1 FROM runs WHERE environment = environments.id) "
            "ORDER BY id"
        )
        return [json.loads(versions) for (versions,) in self.reading(query)]

    def done(self, instance: int) -> set[tuple[int, int]]:
        """Return seed and variant of the runs on an instance that are over."""
        return set(self.reading("SELECT seed, variant FROM runs WHERE instance = ?", instance))

    def write(self, finished: Iterable[Finished]) -> None:
        """Write runs down, all of them or, if anything fails, none. A run that is there already stays as it is."""
        with self.writing() as db:
            for one in finished:
                self._write(db, one)

    def _write(self, db: sqlite3.Connection, one: Finished) -> None:
        row = db.execute(_INSERT, (
            self._hash_of(one.key), one.key.variant, one.key.instance, one.key.seed, self._environment,
            *(one.measures.get(name) for name in MEASURES),
        )).fetchone()  # fmt: skip
        if row is not None and (one.history, one.path, one.front) != (None, None, None):
            db.execute("INSERT INTO traces VALUES (?, ?, ?, ?)", (row[0], one.history, one.path, one.front))

    def _hash_of(self, key: Key) -> str:
        """Return what tells a run from all others, whichever study it is part of."""
        where = key.instance, key.variant
        if where not in self._identities:
            query = (
                "SELECT v.config, i.map_sha256, i.resolution, i.start_row, i.start_col, i.goal_row, i.goal_col, "
                "i.corners, i.radius, e.versions FROM instances i, variants v, environments e "
                "WHERE i.id = ? AND v.id = ? AND e.id = ?"
            )
            found = self._db.execute(query, (*where, self._environment)).fetchone()
            if len(self._identities) > 1024:
                self._identities.clear()
            self._identities[where] = json.dumps(found)
        return _sha(f"{self._identities[where]}{key.seed}")

    def count(self) -> int:
        """Return how many runs are over."""
        return int(next(self.reading("SELECT count(*) FROM runs"))[0])

    def statuses(self) -> dict[str, dict[str, int]]:
        """Return how many runs of each variant ended how."""
        found: dict[str, dict[str, int]] = {name: {} for name in self.variant_ids()}
        query = (
            "SELECT v.name, r.status, count(*) FROM runs r JOIN variants v ON v.id = r.variant "
            "GROUP BY v.id, r.status ORDER BY v.id, r.status"
        )
        for variant, status, number in self.reading(query):
            found[variant][status] = number
        return found

    def rows(self) -> Iterator[Row]:
        """Yield all runs, by instance, seed and variant, whatever order they finished in."""
        columns = [name for name in NAMES if name not in ("variant", "planner", "map")]
        variants = {n: (name, planner) for n, name, planner in self.reading("SELECT id, name, planner FROM variants")}
        instances = {number: name for name, number in self.instance_ids().items()}
        order = "ORDER BY instance, seed, variant"
        for variant, instance, seed, status, *rest in self.reading(
            f"SELECT variant, instance, {', '.join(columns)} FROM runs {order}"  # noqa: S608 - names of ours
        ):
            yield Row(*variants[variant], instances[instance], seed, _SAME.get(status, status), *rest)

    def trace(self, variant: str, instance: str, seed: int) -> tuple[bytes | None, bytes | None, bytes | None]:
        """Return history, path and front of a run, packed, as far as there are any."""
        query = (
            "SELECT history, path, front FROM traces WHERE run = (SELECT r.id FROM runs r "
            "JOIN variants v ON v.id = r.variant JOIN instances i ON i.id = r.instance "
            "WHERE v.name = ? AND i.name = ? AND r.seed = ?)"
        )
        return next(self.reading(query, variant, instance, seed), (None, None, None))

    # Fronts, which can be measured when all are there.

    def fronts(self, instance: int) -> Iterator[tuple[int, bytes]]:
        """Yield the runs of an instance that found a front, with it."""
        query = (
            "SELECT r.id, t.front FROM runs r JOIN traces t ON t.run = r.id "
            "WHERE r.instance = ? AND t.front IS NOT NULL ORDER BY r.seed, r.variant"
        )
        yield from self.reading(query, instance)

    def set_hypervolumes(
        self, instance: int, reference: Sequence[float], values: Mapping[int, tuple[float, float | None]]
    ) -> None:
        """Write down the reference point of an instance, and hypervolume and ratio of its runs."""
        with self.writing() as db:
            db.execute("UPDATE instances SET reference_point = ? WHERE id = ?", (json.dumps(list(reference)), instance))
            db.executemany(
                "UPDATE runs SET hypervolume = ?, hypervolume_ratio = ? WHERE id = ?",
                [(volume, ratio, number) for number, (volume, ratio) in values.items()],
            )


_INSERT = (
    f"INSERT INTO runs (hash, variant, instance, seed, environment, {', '.join(MEASURES)}) "  # noqa: S608
    f"VALUES (?, ?, ?, ?, ?{', ?' * len(MEASURES)}) ON CONFLICT DO NOTHING RETURNING id"
)
_SAME: dict[str, Any] = {s: s for s in ("found", "not-found", "unreachable", "failed", "timeout", "crashed")}
"""One text for each status, however many rows bear it."""


def _sha(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


@lru_cache(maxsize=16)
def _grid(name: str, height: int, width: int, cells: bytes, resolution: float, origin: str | None) -> OccupancyGrid:
    bits = np.unpackbits(np.frombuffer(zlib.decompress(cells), np.uint8), count=height * width)
    place = None if origin is None else json.loads(origin)
    return OccupancyGrid(bits.reshape(height, width).astype(bool), resolution=resolution, origin=place, name=name)


def _in_words(error: sqlite3.Error) -> str:
    """Return what is wrong with a file, as far as one can guess it from what SQLite says."""
    said = one_line(str(error))
    if "full" in said or "disk I/O" in said:
        return f"no room to write ({said}); the runs so far are kept: make room, and start again"
    if "not a database" in said:
        return "found a file that is no study, allowed a study"
    if "malformed" in said or "no such table" in said or "no such column" in said:
        return f"the file is damaged ({said})"
    if "locked" in said:
        return "another process is writing to it"
    if "readonly" in said:
        return "found a file that cannot be written to"
    if "unable to open" in said:
        return "found a file that cannot be opened"
    return said
