"""What the README and the guides show works as shown."""

import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import pages
import pytest

from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry

ROOT = Path(__file__).parent.parent
PAGES = ("README.md", *sorted(str(page.relative_to(ROOT)) for page in ROOT.glob("[dp]*/**/*.md")))


def blocks(page, language):
    return [text for written, text in pages.blocks_of(ROOT / page) if written == language]


def test_the_commands_of_the_first_steps_run_in_this_order(tmp_path):
    lines = [line for block in blocks("README.md", "console") for line in block.splitlines() if line.startswith("$ ")]
    assert len(lines) >= 8
    for line in lines:
        command = shlex.split(line[2:])
        assert command[0] == "pathloom"
        done = subprocess.run(
            [sys.executable, "-m", "pathloom", *command[1:]], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, f"{line}\n{done.stderr}"
    assert {"rooms.png", "random.csv", "path.csv", "result.json"} <= {p.name for p in tmp_path.iterdir()}


def test_the_python_blocks_run():
    found = blocks("README.md", "python")
    assert found
    for number, block in enumerate(found):
        scope = {"__name__": f"shown_{number}"}
        exec(compile(block, f"README.md block {number}", "exec", dont_inherit=True), scope)


def test_the_config_shown_is_planned(tmp_path):
    (block,) = blocks("README.md", "toml")
    (tmp_path / "plan.toml").write_text(block)
    done = subprocess.run(
        [sys.executable, "-m", "pathloom", "plan", "plan.toml", "--json"],
        cwd=tmp_path,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert tomllib.loads(block)["planner"]["population"] == 80


def test_two_commands_do_all_the_set_up():
    shell = blocks("README.md", "sh")
    assert [block.count("\n") for block in shell] == [1, 1]
    assert shell[0].strip().endswith("pathloom plan")
    assert shell[1].strip().endswith("pytest")


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page):
    text = re.sub(r"^```.*?^```", "", (ROOT / page).read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    for target in re.findall(r"\]\(([^)]+)\)|(?:src|srcset)=\"([^\"]+)\"", text):
        name, _, anchor = (target[0] or target[1]).partition("#")
        if not name.startswith("http"):
            file = (ROOT / page).parent / name if name else ROOT / page
            assert file.exists(), name
            assert not anchor or anchor in anchors(file), f"{name}#{anchor}"


def anchors(file):
    """Return the anchors that GitHub gives to the headings of a page."""
    text = re.sub(r"^```.*?^```", "", file.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    heads = re.findall(r"^#+ +(.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.strip().lower()).replace(" ", "-") for head in heads}


def test_the_table_of_planners_names_all_of_them():
    section = (ROOT / "README.md").read_text(encoding="utf-8").split("## Planners")[1].split("\n## ")[0]
    named = set(re.findall(r"`([a-z0-9-]+)`", section))
    ours = {e.component.name for e in default_registry().all_entries(Planner) if e.source.ours}
    assert ours <= named
