"""Makes the README's pictures anew, in light and dark: ``python tests/pictures.py``. Those of the studio want Chromium."""

import io
import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image
from playwright.sync_api import expect, sync_playwright

SIZE = {"width": 1280, "height": 890}
GENERATION = 7
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"]
FOLDER = Path(__file__).parents[1] / "docs"


def plan() -> None:
    """Write ``plan.png`` and ``plan-dark.png``."""
    for name, more in (("plan.png", []), ("plan-dark.png", ["--dark"])):
        command = ["plan", "--optimum", "--quiet", "--plot", str(FOLDER / name), *more]
        subprocess.run([sys.executable, "-m", "pathloom", *command], check=True, stdout=subprocess.DEVNULL)


def studio() -> None:
    """Write ``studio.png`` and ``studio-dark.png``."""
    command = [sys.executable, "-m", "pathloom", "studio", "--port", "0", "--no-browser"]
    with (
        subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server,
        sync_playwright() as playwright,
        playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS) as browser,
    ):
        assert server.stdout is not None
        address = server.stdout.readline().strip()
        for name, scheme in (("studio.png", "light"), ("studio-dark.png", "dark")):
            page = browser.new_page(viewport=SIZE, color_scheme=scheme)
            page.goto(address)
            page.wait_for_selector("html[data-ready]")
            page.check("#compare")
            for number in range(GENERATION + 1):
                page.click("#step")
                expect(page.locator("#generation")).to_contain_text(f"generation {number} ", timeout=60_000)
            page.mouse.move(0, 0)
            page.locator("#step").blur()
            shot = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
            shot.save(FOLDER / name, optimize=True)
            page.close()
        server.terminate()


if __name__ == "__main__":
    plan()
    studio()
