"""Pages: the files that they show are written into a folder, their commands and scripts run there in order."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"# ([\w/]+\.(?:py|toml|yaml))\n")
"""The first line of a block that is a file."""

RUN = '''
"""Run commands and scripts one after the other, in one process; a script knows what those before it have named."""

import json, sys
from pathlib import Path

from pathloom.cli import main

known = {"__name__": "script"}
for kind, text in json.loads(Path("steps.json").read_text(encoding="utf-8")):
    if kind == "script":
        exec(compile(text, "script", "exec", dont_inherit=True), known)
        continue
    sys.argv = text
    try:
        main()
    except SystemExit as left:
        assert not left.code, (text, left.code)
    print("done:", *text, flush=True)
'''

Blocks = list[tuple[str, str]]
"""Language and text of each."""


def blocks_of(page: Path) -> Blocks:
    """Return the blocks of a page, in their order."""
    return BLOCK.findall(page.read_text(encoding="utf-8"))


def write_files(blocks: Blocks, folder: Path) -> None:
    """Write the files that blocks show; of two of one name the last one stays."""
    for _, text in blocks:
        if named := FILE.match(text):
            (folder / named[1]).parent.mkdir(exist_ok=True)
            (folder / named[1]).write_text(text, encoding="utf-8")


def steps_of(blocks: Blocks) -> list[tuple[str, str | list[str]]]:
    """Return what is to be run: commands of ``pathloom``, and scripts. What is for a shell is left out."""
    steps: list[tuple[str, str | list[str]]] = []
    for language, text in blocks:
        if language == "console":
            lines = [shlex.split(line.removeprefix("$ ")) for line in text.splitlines()]
            assert all(line[0] == "pathloom" for line in lines), text
            steps += [("command", line) for line in lines]
        elif language != "sh" and not FILE.match(text):
            assert language == "python", text
            steps.append(("script", text))
    return steps


def run(blocks: Blocks, folder: Path, and_then: str = "") -> str:
    """Return what commands and scripts say in a process of their own, which can import from the folder.

    `and_then` is a script that runs after them.
    """
    steps = steps_of(blocks)
    (folder / "steps.json").write_text(json.dumps(steps), encoding="utf-8")
    script = "    ".join((RUN + and_then).splitlines(keepends=True))
    (folder / "run.py").write_text(f"if __name__ == '__main__':\n{script}", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-W", "error", "run.py"], cwd=folder, env={**os.environ, "PYTHONPATH": str(folder)},
        capture_output=True, text=True, encoding="utf-8", check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"\n{done.stdout}".count("\ndone: ") == sum(kind == "command" for kind, _ in steps)
    return done.stdout
