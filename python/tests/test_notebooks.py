"""Each notebook is executed: its cells have assertions, and what one raises is the test's failure."""

from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def test_there_are_notebooks():
    assert len(NOTEBOOKS) >= 7


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_cell_that_only_draws_is_collapsed_in_the_book(path):
    for cell in nbformat.read(path, as_version=4).cells:
        draws = cell.cell_type == "code" and "plt.subplots(" in cell.source
        only = draws and not any(word in cell.source for word in ("shadowstep.", "compete(", "assert "))
        assert only == ("hide-input" in cell.metadata.get("tags", [])), cell.source


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_makes_its_pictures(path):
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert not any(cell.outputs or cell.execution_count for cell in code), "notebooks are kept without outputs"
    assert any("assert " in cell.source for cell in code)
    # the limit only ends a cell that hangs
    nbclient.NotebookClient(notebook, timeout=1800, kernel_name="python3", resources={"metadata": {"path": str(FOLDER)}}).execute()
    pictures = sum("image/png" in output.get("data", {}) for cell in code for output in cell.outputs)
    drawn = sum("plt.subplots(" in cell.source for cell in code)
    assert pictures == drawn > 0
    warned = [output.text for cell in code for output in cell.outputs if output.output_type == "stream" and "Warning" in output.text]
    assert not warned
