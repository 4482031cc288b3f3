"""The command line in this process, where that is enough, and in one of its own, where it is not."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from pathloom.cli import main


@dataclass(frozen=True)
class Outcome:
    """What a command left behind."""

    code: int
    out: str
    err: str

    @property
    def document(self) -> dict[str, Any]:
        """The one JSON document on standard output; NaN and Infinity are no JSON."""
        assert self.out, self.err
        return json.loads(self.out, parse_constant=pytest.fail)


Cli = Callable[..., Outcome]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, in which the command runs."""
    work = tmp_path / "work"
    work.mkdir()
    monkeypatch.chdir(work)
    return work


@pytest.fixture
def cli(folder: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Cli:
    """Run a command in this process."""

    def run(*args: object) -> Outcome:
        monkeypatch.setattr(sys, "argv", ["pathloom", *map(str, args)])
        capfd.readouterr()
        with pytest.raises(SystemExit) as left:
            main()
        out, err = capfd.readouterr()
        return Outcome(int(left.value.code or 0), out, err)

    return run


@pytest.fixture
def process(folder: Path) -> Cli:
    """Run a command in a process of its own; ``env`` adds to the environment."""

    def run(*args: object, env: dict[str, str] | None = None) -> Outcome:
        done = subprocess.run(
            [sys.executable, "-m", "pathloom", *map(str, args)],
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=120,
            check=False,
            env={**os.environ, **(env or {})},
        )
        return Outcome(done.returncode, done.stdout, done.stderr)

    return run


def listing(folder: Path) -> dict[str, bytes | None]:
    """Return all that is in a folder, with its content."""
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None for p in folder.rglob("*")}


def one_line(outcome: Outcome, code: int) -> str:
    """Return the only thing that the command said, which is one line on standard error."""
    assert outcome.code == code, outcome
    assert outcome.out == ""
    assert outcome.err.startswith("pathloom: ")
    assert outcome.err.endswith("\n")
    assert outcome.err.count("\n") == 1, outcome.err
    assert "Traceback" not in outcome.err
    return outcome.err.removeprefix("pathloom: ").rstrip("\n")


@pytest.fixture
def refused(cli: Cli, folder: Path) -> Callable[..., str]:
    """Run a command that has to fail for bad input, and return its message."""

    def run(*args: object) -> str:
        before = listing(folder)
        message = one_line(cli(*args), code=2)
        assert listing(folder) == before
        return message

    return run


def write(path: Path, content: str | bytes) -> Path:
    """Write a file for a test and return its path."""
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def moving_ai(*rows: str) -> str:
    """Return a map in Moving AI's format."""
    return f"type octile\nheight {len(rows)}\nwidth {len(rows[0])}\nmap\n" + "".join(f"{row}\n" for row in rows)


@pytest.fixture
def ring(folder: Path) -> str:
    """A file with 3 × 3 cells around an obstacle in the middle."""
    return write(folder / "ring.map", moving_ai("...", ".@.", "...")).name


@pytest.fixture
def wall(folder: Path) -> str:
    """A file with a wall between left and right."""
    return write(folder / "wall.map", moving_ai(".@.", ".@.", ".@.")).name


def timeless(document: dict[str, Any]) -> dict[str, Any]:
    """Return a document of ``plan`` without what a clock says."""
    budget = {k: v for k, v in document["budget"].items() if k != "phases" and not k.startswith("seconds")}
    return {**document, "budget": budget}
