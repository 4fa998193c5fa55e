"""Runs the notebooks of docs/notebooks from the first cell to the last: python3 tests/python/notebooks.py FOLDER."""

import pathlib
import sys

import nbformat
from nbclient import NotebookClient

for file in sorted(pathlib.Path(sys.argv[1]).glob("*.ipynb")):
    notebook = nbformat.read(file, as_version=4)
    NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    pictures = sum("image/png" in output.get("data", {}) for output in outputs)
    if not pictures:
        sys.exit(f"{file.name}: draws no picture")
    print(f"{file.name}: {len(outputs)} outputs, {pictures} pictures")
    if len(sys.argv) > 2:
        nbformat.write(notebook, pathlib.Path(sys.argv[2], file.name))
