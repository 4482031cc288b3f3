"""A studio to speak to, in this process and in one of its own."""

import base64
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

PORT = 8617
TOKEN = "the-token-of-the-tests"
HOME = f"http://127.0.0.1:{PORT}"
SOCKET = f"ws://127.0.0.1:{PORT}/live"
MISSING = "the extra [studio] is not installed here, so that nobody asks the studio anything"


@pytest.fixture(scope="session")
def application() -> Any:
    pytest.importorskip("starlette", reason=MISSING)
    pytest.importorskip("websockets", reason=MISSING)
    from pathloom.studio.app import application

    return application(port=PORT, token=TOKEN)


@pytest.fixture
def stranger(application: Any) -> Iterator[Any]:
    """Somebody who asks without having opened the page."""
    pytest.importorskip("httpx2", reason="httpx2 is not installed here, with which the tests ask the studio's routes")
    from starlette.testclient import TestClient

    with TestClient(application, base_url=HOME) as client:
        yield client


@pytest.fixture
def client(stranger: Any) -> Any:
    """Somebody who has opened the page with its token."""
    assert stranger.get("/", params={"token": TOKEN}).status_code == 200
    return stranger


def scene(occupied: Any = None, **settings: Any) -> dict[str, Any]:
    """Return a scene as the page sends it; by default an empty map of 12 × 12."""
    cells = np.zeros((12, 12), bool) if occupied is None else np.asarray(occupied, bool)
    rows, cols = cells.shape
    drawn = {"rows": rows, "cols": cols, "bits": base64.b64encode(np.packbits(cells).tobytes()).decode()}
    return {"map": drawn, "start": [rows - 1, 0], "goal": [0, cols - 1], **settings}


def wall(size: int = 12, gap: int | None = 0) -> Any:
    """Return a map with a wall down the middle, open in one row."""
    cells = np.zeros((size, size), bool)
    cells[:, size // 2] = True
    if gap is not None:
        cells[gap, size // 2] = False
    return cells


def quick(use: str = "imga", generations: int = 5, **more: Any) -> dict[str, Any]:
    """Return the table of a planner that is done soon."""
    limit = [{"use": "max-generations", "limit": generations}]
    return {"use": use, "population": 20, "sampling": "perturbed-trees", "termination": limit, **more}


Studio = Callable[..., subprocess.Popen[str]]


@pytest.fixture(scope="module")
def studios() -> Iterator[Studio]:
    """Start studios in processes of their own; each says its address first."""
    pytest.importorskip("uvicorn", reason=MISSING)
    started: list[subprocess.Popen[str]] = []

    def start(*options: str) -> subprocess.Popen[str]:
        command = [sys.executable, "-m", "pathloom", "studio", "--port", "0", "--no-browser", *options]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, encoding="utf-8")
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """A Chromium under Playwright's hand; where PATHLOOM_BROWSER is ``required``, tests fail without one."""
    found = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    try:
        from playwright.sync_api import sync_playwright
    except ModuleNotFoundError:
        found = None
    if found is None:
        lacking = "no Chromium or no playwright is installed here, so that nobody looks at the studio in a browser"
        (pytest.fail if os.environ.get("PATHLOOM_BROWSER") == "required" else pytest.skip)(lacking)
    flags = "--no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
    flags += "--disable-component-update --disable-sync"
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=found, args=flags.split())
        yield chromium
        chromium.close()


def write(folder: Path, name: str, text: str) -> Path:
    """Write a file for a test and return its path."""
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def moving_ai(*rows: str) -> str:
    """Return a map in Moving AI's format."""
    return f"type octile\nheight {len(rows)}\nwidth {len(rows[0])}\nmap\n" + "".join(f"{row}\n" for row in rows)
