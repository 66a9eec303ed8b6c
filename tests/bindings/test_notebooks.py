"""The notebooks run from top to bottom without an error or a warning, and what is stored in them is what they give.

usage: test_notebooks.py ROOT            `--store` keeps the outputs in the notebooks. Look at them.
"""
import contextlib
import os
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

ROOT = Path(sys.argv.pop(1)).resolve()
STORE = "--store" in sys.argv and not sys.argv.remove("--store")
FOLDER = ROOT / "examples" / "notebooks"
TASKS = {"first_packing", "ensemble"}
LARGEST = 250_000  # bytes of a notebook with its outputs
# Warnings are errors in what the user runs. The kernel's own start is not.
STRICT = "import warnings; warnings.simplefilter('error')"

try:
    import nbformat
    from nbclient import NotebookClient
except ImportError:
    print("nbclient is not installed (Debian: python3-nbclient, python3-ipykernel): no notebook was run")
    sys.exit(77)


def kinds(cell):
    """What a cell gives: streams by name, results by their richest kinds. A page, which the program writes anew, is not stored."""
    return [o.get("name") or sorted(set(o.get("data", {"error": 0})) - ({"text/html"} if page_of(o) else set())) for o in cell.get("outputs", [])]


def page_of(output):
    """The page of a packing, "" where an output is none."""
    html = output.get("data", {}).get("text/html", "")
    return html if "<iframe srcdoc=" in html else ""


class Notebooks(unittest.TestCase):
    def test_all_tasks_are_there(self):
        self.assertEqual({p.stem for p in FOLDER.glob("*.ipynb")}, TASKS)

    def run_notebook(self, name):
        path = FOLDER / f"{name}.ipynb"
        stored = nbformat.read(path, as_version=4)
        self.assertLess(path.stat().st_size, LARGEST)
        book = nbformat.read(path, as_version=4)
        for cell in book.cells:
            if cell.cell_type == "code":
                cell.outputs = []
        book.cells.insert(0, nbformat.v4.new_code_cell(STRICT))
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the client's own libraries
            NotebookClient(book, timeout=200, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
        del book.cells[0]
        pages = [page_of(o) for c in book.cells for o in c.get("outputs", []) if page_of(o)]
        if STORE:
            for count, cell in enumerate((c for c in book.cells if c.cell_type == "code"), 1):
                cell.execution_count, cell.metadata = count, {}
                for output in cell.outputs:
                    if page_of(output):
                        del output["data"]["text/html"]
                    if "execution_count" in output:
                        output["execution_count"] = count
            nbformat.write(book, path)
            stored = book
        for mine, theirs in zip(book.cells, stored.cells):
            self.assertEqual(kinds(mine), kinds(theirs), mine.source)
            self.assertNotIn("stderr", kinds(mine), mine.source)
        self.assertEqual(len(pages), name == "first_packing")
        for page in pages:  # the small one, with a title for readers of screens
            self.assertLess(len(page), 100_000)
            self.assertIn("title=", page)


for task in TASKS:
    setattr(Notebooks, f"test_{task}_runs", lambda self, task=task: self.run_notebook(task))


if __name__ == "__main__":
    with contextlib.suppress(KeyError):
        del os.environ["MPLBACKEND"]  # the kernel's own draws into the notebook
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # or the kernel speaks of its debugger
    unittest.main()
