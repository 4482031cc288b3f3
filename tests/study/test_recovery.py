"""Whatever is killed, and whenever: the study ends as if nothing had happened."""

import random
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

import pathloom as pl
from study.conftest import rows_of

psutil = pytest.importorskip("psutil", reason="finds the workers of a driver; of the dev extra")

ASKED = ("ablate", "imga", "--swap", "selection=roulette", "--maps", "random-20:75:x3", "--runs", "6", "--budget",
         "evaluations=20000", "--corners", "allow", "--workers", "2", "--quiet")  # fmt: skip
RUNS = 36
LISTENING = """
import _thread, os, threading
from pathloom.cli import main

threading.Thread(target=lambda: os.read(0, 1) and _thread.interrupt_main(), daemon=True).start()
main()
"""
"""The command, which a sign on its input interrupts: on Windows, Ctrl-C would interrupt the tests as well."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The rows of the study that nobody disturbed."""
    out = tmp_path_factory.mktemp("whole") / "s.db"
    begin(out).wait()
    found = rows_of(out)
    assert len(found) == RUNS
    return found


def begin(out: Path) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-W", "ignore", "-m", "pathloom", *ASKED, "--out", out], stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )  # fmt: skip


def workers_of(driver: int) -> list["psutil.Process"]:
    found = []
    with suppress(psutil.Error):
        for process in psutil.Process(driver).children(recursive=True):
            with suppress(psutil.Error):  # it is gone
                if "spawn_main" in " ".join(process.cmdline()):
                    found.append(process)
    return found


def done(out: Path) -> int:
    try:
        with pl.Study.open(out) as study:
            return len(study)
    except pl.PathloomError:
        return 0


def wait_for(what, seconds=60.0):
    until = time.monotonic() + seconds
    while not (found := what()):
        assert time.monotonic() < until
        time.sleep(0.02)
    return found


def alive(process: "psutil.Process") -> bool:
    try:
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def test_a_driver_that_is_killed_loses_nothing_and_its_workers_leave(tmp_path, whole):
    out = tmp_path / "s.db"
    driver = begin(out)
    wait_for(lambda: done(out))
    time.sleep(random.Random(3).uniform(0.0, 0.2))
    workers = workers_of(driver.pid)
    driver.kill()
    driver.wait()
    wait_for(lambda: not any(map(alive, workers)))
    assert 0 < done(out) < RUNS
    assert begin(out).wait() == 0
    assert rows_of(out) == whole
    assert [path.name for path in tmp_path.iterdir()] == ["s.db"]


def test_workers_that_are_killed_lose_nothing(tmp_path, whole):
    out = tmp_path / "s.db"
    driver = begin(out)
    for killed in range(2):
        wait_for(lambda killed=killed: done(out) > 2 * killed and len(workers_of(driver.pid)) == 2)
        random.Random(killed).choice(workers_of(driver.pid)).kill()
    assert driver.wait(timeout=120) == 0
    assert rows_of(out) == whole


def test_an_interrupted_study_says_what_is_kept_and_ends_with_130(tmp_path, whole):
    out = tmp_path / "s.db"
    driver = subprocess.Popen(
        [sys.executable, "-c", LISTENING, *ASKED[:-1], "--out", out], stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    wait_for(lambda: done(out))
    workers = workers_of(driver.pid)
    if sys.platform == "win32":
        driver.stdin.write("!")
    else:
        driver.send_signal(signal.SIGINT)
    _, said = driver.communicate(timeout=60)
    assert driver.returncode == 130
    kept = done(out)
    assert f"pathloom: interrupted; {kept} of {RUNS} runs are kept in {out}: start again to go on" in said
    assert "Traceback" not in said
    wait_for(lambda: not any(map(alive, workers)))
    with pl.Study.open(out) as study:
        assert len(study.resume(2)) == RUNS
    assert rows_of(out) == whole
