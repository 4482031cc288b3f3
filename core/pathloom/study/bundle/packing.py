"""Packing: maps, configs, seeds, versions and results of a study, as plain files in a zip."""

import hashlib
import io
import json
import re
import sqlite3
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import tomli_w

from pathloom.files import FilePath, replace
from pathloom.grid.movingai import render_movingai
from pathloom.study.errors import StudyError
from pathloom.study.exporting import to_csv
from pathloom.study.store import MEMORY
from pathloom.study.study import Study

SCHEMA = "pathloom.study-bundle/1"
STORE, SUMS, DESIGN = "study.db", "SHA256SUMS", "study.json"
"""Members that a check reads."""
WHEN = (1980, 1, 1, 0, 0, 0)
"""Time of all members: equal studies make equal bundles."""

README = """\
# {name}: a study to be repeated

{kind} of {variants} variants on {maps} maps, {done} runs, made with pathloom {version}.

- `study.db`: the study itself, an SQLite file; `SELECT * FROM results` shows all runs.
- `results.csv`: the same table. Lengths are in cells.
- `study.json`: what ran: variants, maps with start and goal, seeds, budget, versions.
- `configs/`: the complete config of every variant.
- `maps/`: the maps, as `.map` files (Moving AI).
- `SHA256SUMS`: of all other files.

## Repeat it

Install the versions named in `study.json` (`pip install pathloom=={version}` and the plugins listed there), then

    pathloom study verify {file} --sample 20

runs a random sample again and compares paths and metrics byte for byte. One variant on one map:

    pathloom plan {config} --map {map} --start {start} --goal {goal} --corners {corners} --radius {radius} --seed {seed}

Read the results:

    pathloom study summary study.db
    pathloom study report study.db -o report.html
"""


def bundle(study: Study, path: FilePath) -> int:
    """Pack a study into a zip file; return its size in bytes.

    Raises
    ------
    StudyError
        If the study is in memory only.
    MapError
        If the file cannot be written.
    """
    if study.name == MEMORY:
        raise StudyError("found a study in memory, allowed one in a file: begin it with out=FILE")
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        sums = []
        for name, data in _members(study, Path(path).name):
            archive.writestr(_entry(name), data)
            sums.append(f"{hashlib.sha256(data).hexdigest()}  {name}\n")
        archive.writestr(_entry(SUMS), "".join(sums))
    replace(path, content.getvalue())
    return content.tell()


def _entry(name: str) -> zipfile.ZipInfo:
    entry = zipfile.ZipInfo(name, WHEN)
    entry.compress_type = zipfile.ZIP_DEFLATED
    entry.external_attr = 0o644 << 16
    return entry


def _members(study: Study, file: str) -> Iterator[tuple[str, bytes]]:
    configs = {variant: f"configs/{_file(i, variant)}.toml" for i, variant in enumerate(study.variants, 1)}
    maps: dict[str, tuple[str, bytes]] = {}
    places = []
    for name, known in study.instances.items():
        problem = study.problem(name)
        grid = problem.grid
        if grid.sha256 not in maps:
            maps[grid.sha256] = f"maps/{_file(len(maps) + 1, grid.name or name)}.map", render_movingai(grid)
        places.append(
            {
                "name": name,
                "map": maps[grid.sha256][0],
                "map_sha256": grid.sha256,
                "start": list(problem.ends[0]),
                "goal": list(problem.ends[1]),
                "corners": problem.corners,
                "radius": problem.radius,
                "resolution": grid.resolution,
                "origin": grid.origin,
                "reachable": known.reachable,
                "optimum": {"grid": known.grid, "any_angle": known.any_angle, "any_angle_bound": known.any_angle_bound},
            }
        )
    facts, changes = study.facts, study.changes
    design = {
        "schema": SCHEMA,
        **{name: facts[name] for name in ("kind", "created", "runs", "seed", "budget", "time_limit", "notes")},
        "variants": [{"name": n, "config": c, "changes": changes[n]} for n, c in configs.items()],
        "instances": places,
        "versions": study.versions,
    }
    first: dict[str, Any] = places[0]
    version = facts["versions"]["pathloom"]
    yield "README.md", README.format(
        name=Path(study.name).stem, kind={"ablate": "Ablation", "compare": "Comparison"}.get(study.kind, study.kind),
        variants=len(configs), maps=len(places), done=len(study), version=version, file=file,
        config=next(iter(configs.values())), map=first["map"], start=",".join(map(str, first["start"])),
        goal=",".join(map(str, first["goal"])), corners=first["corners"], radius=first["radius"], seed=facts["seed"],
    ).encode()  # fmt: skip
    yield DESIGN, json.dumps(design, indent=1).encode()
    for variant, config in study.variants.items():
        yield configs[variant], tomli_w.dumps({"planner": config}).encode()
    yield from maps.values()
    with tempfile.TemporaryDirectory() as folder:
        table, copy = Path(folder) / "results.csv", Path(folder) / STORE
        to_csv(study.each(), table)
        yield "results.csv", table.read_bytes()
        _snapshot(study.name, copy)
        yield STORE, copy.read_bytes()


def _snapshot(name: str, copy: Path) -> None:
    """Write a copy of a study's file that is whole, whoever writes to it just then."""
    try:
        with closing(sqlite3.connect(name)) as source, closing(sqlite3.connect(copy)) as target:
            source.backup(target)
            target.execute("PRAGMA journal_mode = DELETE")
            target.execute("VACUUM")
    except sqlite3.Error as error:
        raise StudyError(f"{name}: cannot be copied: {error}") from error


def _file(number: int, name: str) -> str:
    """Return a name for a file that every system takes."""
    return f"{number:02d}-{re.sub(r'[^A-Za-z0-9.]+', '-', name).strip('-.')[:60] or 'unnamed'}"


def described(design: Any) -> bool:
    """Return whether something read is the description of a bundle of ours."""
    return isinstance(design, dict) and design.get("schema") == SCHEMA
