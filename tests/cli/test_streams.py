"""Standard output, standard error, colour, pipes and signals."""

import errno
import json
import os
import pty
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import Outcome
from .distributions import distribution

ENDLESS = (
    *("plan", "--map", "iga-map1", "--corners", "allow"),
    *("--set", "termination=max-generations", "--set", "termination.max-generations.limit=1000000"),
)


def test_a_pipe_gets_neither_colour_nor_any_other_escape(process) -> None:
    done = process("plan", "--optimum", env={"TERM": "xterm-256color"})
    assert done.code == 0
    assert "\x1b" not in done.out + done.err


@pytest.mark.parametrize("words", [("plan",), ("maps", "list"), ("plugins", "list"), ("plugins", "show", "imga/imga")])
def test_nothing_is_said_on_standard_error_when_all_is_well(cli, words) -> None:
    assert cli(*words).err == ""


def on_a_terminal(*args: str, **env: str) -> str:
    """Run a command on a terminal and return what it showed there."""
    ours, theirs = pty.openpty()
    environment = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "FORCE_COLOR")}
    environment |= {"TERM": "xterm-256color", **env}
    command = [sys.executable, "-m", "pathloom", *args]
    child = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs, env=environment)
    os.close(theirs)
    shown = b""
    try:
        while piece := os.read(ours, 65536):
            shown += piece
    except OSError:  # how Linux says that the other end is closed
        pass
    os.close(ours)
    assert child.wait(timeout=60) == 0
    return shown.decode()


COLOUR = re.compile(r"\x1b\[[0-9;]*(?:3[0-7]|4[0-7]|9[0-7]|[34]8;)[0-9;]*m")


def test_a_terminal_gets_colour_unless_no_color_forbids_it(folder) -> None:
    assert COLOUR.search(on_a_terminal("plan"))
    assert not COLOUR.search(on_a_terminal("plan", NO_COLOR="1"))


@pytest.mark.parametrize(
    "words", [("plan",), ("plan", "--json"), ("plan", "--freeze"), ("maps", "list"), ("maps", "make", "random")]
)
def test_a_reader_who_has_gone_away_is_no_fault(folder: Path, words) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as out:
        done = subprocess.run(
            [sys.executable, "-m", "pathloom", *words], stdout=out, stderr=subprocess.PIPE, check=False, timeout=60
        )
    assert done.stderr == b""
    assert done.returncode == 0


def test_a_closed_standard_output_is_no_fault(folder: Path) -> None:
    command = f'"{sys.executable}" -m pathloom plan --out a.json >&-'
    done = subprocess.run(command, shell=True, stderr=subprocess.PIPE, check=False, timeout=60)
    assert (done.returncode, done.stderr) == (0, b"")
    assert json.loads((folder / "a.json").read_text())["status"] == "found"


FULL = """
import errno, io, os, sys

class Full(io.RawIOBase):
    "Standard output on a disk without room."

    def writable(self):
        return True

    def fileno(self):
        return 1

    def write(self, data):
        if os.path.samestat(os.fstat(1), os.stat(os.devnull)):
            return len(data)  # somebody has sent it there
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

sys.stdout = io.TextIOWrapper(io.BufferedWriter(Full(), {buffer}))
sys.argv = ["pathloom", "maps", "list"]
from pathloom.cli import main
main()
"""


@pytest.mark.parametrize("buffer", [1, 1 << 20], ids=["at-once", "when-flushed"])
def test_a_full_disk_is_told_in_one_line(folder: Path, buffer: int) -> None:
    command = [sys.executable, "-c", FULL.format(buffer=buffer)]
    done = subprocess.run(command, capture_output=True, check=False, timeout=60)
    assert done.returncode == 2
    assert done.stderr.decode().strip() == f"pathloom: output: {os.strerror(errno.ENOSPC)}"


def test_an_output_that_knows_ascii_only_gets_the_picture_as_far_as_it_goes(process) -> None:
    done = process("plan", env={"PYTHONIOENCODING": "ascii"})
    assert (done.code, done.err) == (0, "")
    assert "planner     loom" in done.out


@pytest.mark.parametrize("planner", ["loom", "imga"])
def test_a_time_limit_ends_the_run_with_the_best_path_so_far(cli, planner) -> None:
    document = cli(*ENDLESS, "--planner", planner, "--time-limit", 0.05, "--json").document
    assert document["status"] == "found"
    assert document["budget"]["generations"] < 1_000_000
    assert document["config"]["run"]["time_limit"] == 0.05


WATCHER = '''
import sys
from dataclasses import dataclass

import pathloom as pl


@dataclass(frozen=True, kw_only=True)
class Crier(pl.Observer):
    """Say when the twentieth generation is reached."""

    def observe(self, state):
        if state.generation == 20:
            print("under way", file=sys.stderr, flush=True)


@pl.hookimpl
def register(add):
    add(Crier)
'''


@pytest.fixture
def interrupted(folder: Path, tmp_path: Path):
    """Run without end until it is under way, and press Ctrl-C."""
    site = tmp_path / "site"
    distribution(site, "town-crier", points={"town": "town_crier"}, modules={"town_crier": WATCHER})

    def run(*options: str) -> Outcome:
        with subprocess.Popen(
            [sys.executable, "-m", "pathloom", *ENDLESS, "--set", 'observers=["town/crier"]', *options],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONPATH": str(site)},
        ) as child:
            assert child.stderr is not None
            assert child.stderr.readline() == "under way\n"
            child.send_signal(signal.SIGINT)
            out, err = child.communicate(timeout=60)
            return Outcome(child.returncode, out, err)

    return run


def test_ctrl_c_ends_a_run_with_the_best_path_so_far(interrupted) -> None:
    done = interrupted("--json")
    assert done.code == 130
    assert done.document["status"] == "found"
    assert done.document["interrupted"] is True
    assert 20 <= done.document["budget"]["generations"] < 1_000_000
    assert done.err == "pathloom: interrupted; this is the best so far\n"


def test_a_run_leaves_the_handling_of_signals_as_it_found_it(cli) -> None:
    before = signal.getsignal(signal.SIGINT)
    cli("plan")
    assert signal.getsignal(signal.SIGINT) is before


def test_ctrl_c_still_writes_the_files_that_were_asked_for(interrupted, folder: Path) -> None:
    assert interrupted("--out", "a.json", "--export", "a.csv", "--quiet").err == ""
    assert json.loads((folder / "a.json").read_text())["path"][-1] == [0, 9]
    assert (folder / "a.csv").read_text().splitlines()[-1] == "0,9"
