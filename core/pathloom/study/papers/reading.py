"""Reading: a study that a TOML file describes.

``question`` and ``source`` say what it is about. ``[planners.NAME]`` are planners to
compare; or ``[base]`` is one whose parts ``[swap]`` and ``without`` change, one at a
time. ``maps``, ``runs``, ``seed``, ``budget``, ``time_limit`` and ``[problem]`` are as on the command
line. ``[quick]`` has what is less in a run of minutes: ``maps`` and ``runs``.
"""

import tomllib
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from pathloom.config import ProblemSpec
from pathloom.errors import ConfigError, PathloomError
from pathloom.files import reason
from pathloom.naming import closest
from pathloom.study.budget import Budget
from pathloom.study.design import Design, ablation, comparison
from pathloom.study.instances import instances_of

KEYS = ("question", "source", "maps", "runs", "seed", "budget", "time_limit", "problem", "quick", "planners", "base",
        "swap", "without", "factorial")  # fmt: skip
QUICK = ("maps", "runs")
PROBLEM = ("start", "goal", "corners", "radius")


def names() -> dict[str, tuple[str, str]]:
    """Return question and source of the studies that come with pathloom, by name."""
    folder = files("pathloom.study.papers")
    found = sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml"))
    tables = {name: tomllib.loads((folder / f"{name}.toml").read_text("utf-8")) for name in found}
    return {name: (table["question"], table["source"]) for name, table in tables.items()}


def read(asked: str, *, full: bool = False, changes: Mapping[str, Any] | None = None) -> Design:
    """Return the study of a name, or of a file.

    Parameters
    ----------
    asked
        One of `names`, or a file in TOML; maps that it names are relative to it.
    full
        All maps and runs, not only those of ``[quick]``.
    changes
        Values in the place of the file's.

    Raises
    ------
    ConfigError
        If there is none, or something in it is unknown or cannot be used.
    """
    text, folder = _text(asked)
    try:
        table = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise ConfigError(f"{asked}: no TOML: {' '.join(str(error).split())}") from error
    try:
        _known("", table, KEYS)
        quick, problem = (_table(table, name) for name in ("quick", "problem"))
        _known("quick.", quick, QUICK)
        _known("problem.", problem, PROBLEM)
        return _design({**table, **({} if full else quick), **(changes or {})}, problem, folder)
    except PathloomError as error:
        raise type(error)(f"{asked}: {error}") from error


def _text(asked: str) -> tuple[str, Path | None]:
    known = names()
    if asked in known:
        return (files("pathloom.study.papers") / f"{asked}.toml").read_text("utf-8"), None
    if not asked.endswith(".toml"):
        raise ConfigError(
            f"found {asked!r}, allowed a file in TOML or one of the papers' studies; {closest(asked, known)}"
        )
    try:
        return Path(asked).read_text("utf-8"), Path(asked).parent
    except FileNotFoundError:
        raise ConfigError(f"{asked}: found no such file, allowed a study in TOML") from None
    except (OSError, UnicodeDecodeError) as error:
        why = reason(error) if isinstance(error, OSError) else "no UTF-8"
        raise ConfigError(f"{asked}: found an unreadable file ({why}), allowed a study in TOML") from error


def _design(table: Mapping[str, Any], problem: Mapping[str, Any], folder: Path | None) -> Design:
    budget = Budget.parse(table.get("budget", "evaluations"))
    base, planners = _table(table, "base"), _table(table, "planners")
    if bool(base) == bool(planners):
        raise ConfigError("found both base and planners, or neither; allowed one of them")
    notes = tuple(f"{key}: {table[key]}" for key in ("question", "source") if key in table)
    if planners:
        variants, kind = comparison(planners), "compare"
    else:
        variants, said = ablation(
            base, swap=_table(table, "swap"), without=table.get("without", ()),
            factorial=bool(table.get("factorial", False)), budget=budget,
        )  # fmt: skip
        notes, kind = (*notes, *said), "ablate"
    maps = table.get("maps", [])
    if not isinstance(maps, list) or not all(isinstance(name, str) for name in maps):
        raise ConfigError(f"maps: found {maps!r}, allowed a list of names and files")
    listed = [str(folder / name) if folder is not None and (folder / name).is_file() else name for name in maps]
    places = instances_of(listed, spec=ProblemSpec(**problem))
    limit = table.get("time_limit")
    return Design(kind, variants, places, table.get("runs", 30), table.get("seed", 0), budget, limit, notes)


def _table(table: Mapping[str, Any], name: str) -> dict[str, Any]:
    value = table.get(name, {})
    if not isinstance(value, dict):
        raise ConfigError(f"{name}: found {value!r}, allowed a table")
    return value


def _known(where: str, table: Mapping[str, Any], allowed: tuple[str, ...]) -> None:
    for key in table:
        if key not in allowed:
            raise ConfigError(f"{where}{key}: no such key; {closest(key, allowed)}")
