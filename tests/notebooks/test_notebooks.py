"""Every notebook runs from its first cell to its last, and is committed without outputs."""

from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

FOLDER = Path(__file__).parents[2] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
REDUCED = {"papers": 'papers = ["imga"]', "maps": 'maps = ["random-20:75:s0", "random-20:75:s1"]', "runs": "runs = 2"}
"""What a test plans less of: by variable, the line that sets it."""


def reduced(source: str) -> str:
    """Return a cell with the lines that say how much is to be run replaced by a small number."""
    lines = [REDUCED.get(line.partition(" = ")[0], line) for line in source.splitlines()]
    return "\n".join(lines)


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
