"""What the pages for those who come from elsewhere show works as shown, and so do the blocks of the pages of plugins."""

import os
import subprocess
import sys
from pathlib import Path

import pages
import pytest

ROOT = Path(__file__).parent.parent
GUIDES = sorted((ROOT / "docs").glob("from-*.md"))
PLUGINS = [page for page in sorted((ROOT / "plugins").glob("*/README.md")) if pages.blocks_of(page)]
LEFT = {
    "from-nav2": {"path.csv", "path.json", "curve.json", "dense.json"},
    "from-pymoo": set(),
    "from-python-motion-planning": {"hall.csv", "hall.png"},
}
"""The files that each guide says it writes."""


@pytest.mark.parametrize("page", [*GUIDES, *PLUGINS], ids=lambda page: page.relative_to(ROOT).as_posix())
def test_files_commands_and_scripts_of_a_page_work(page, tmp_path):
    blocks = pages.blocks_of(page)
    pages.write_files(blocks, tmp_path)
    pages.run(blocks, tmp_path)
    assert LEFT.get(page.stem, set()) <= {path.name for path in tmp_path.iterdir()}
    if shell := "".join(text for language, text in blocks if language == "sh"):
        env = {**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
        done = subprocess.run(
            ["bash", "-euc", shell], cwd=tmp_path, env=env, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr


def test_there_are_the_three_guides_and_each_has_something_to_run():
    assert {page.stem for page in GUIDES} == LEFT.keys()
    for page in GUIDES:
        assert {"console", "python"} <= {language for language, _ in pages.blocks_of(page)}
