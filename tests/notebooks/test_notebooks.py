"""Every notebook runs from its first cell to its last, and is committed without outputs."""

import re
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

FOLDER = Path(__file__).parents[2] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
REDUCED = {
    r"^papers = \[.*\]$": 'papers = ["imga"]',
    r"^maps = \[.*\]$": 'maps = ["random-20:75:s0", "random-20:75:s1"]',
    r"^runs = \d+$": "runs = 2",
}
"""What a test plans less of: lines that say how much, and what they say here."""


def reduced(source: str) -> str:
    """Return a cell in which the lines that say how much is to be run ask for little."""
    for line, little in REDUCED.items():
        source = re.sub(line, little, source, flags=re.MULTILINE)
    return source


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(notebook, tmp_path, monkeypatch) -> None:
    monkeypatch.delenv("PATHLOOM_DATA", raising=False)  # a reader has none
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    monkeypatch.setenv("JUPYTER_PLATFORM_DIRS", "1")
    page = nbformat.read(notebook, as_version=4)
    for cell in page.cells:
        if cell.cell_type == "code":
            cell.source = reduced(cell.source)
    nbclient.NotebookClient(
        page, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    ).execute()
    code = [cell for cell in page.cells if cell.cell_type == "code"]
    assert any("image/svg+xml" in out.get("data", {}) or "image/png" in out.get("data", {}) or "text/plain" in
               out.get("data", {}) for cell in code for out in cell.outputs)  # fmt: skip
    assert not [out for cell in code for out in cell.outputs if out.get("name") == "stderr"], "a cell warns"


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_committed_without_outputs(notebook) -> None:
    page = nbformat.read(notebook, as_version=4)
    nbformat.validate(page)
    for cell in page.cells:
        if cell.cell_type == "code":
            assert cell.outputs == []
            assert cell.execution_count is None


def test_there_are_the_seven_notebooks() -> None:
    assert [path.name[0] for path in NOTEBOOKS] == list("1234567")
