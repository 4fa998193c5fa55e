"""Runs the notebooks of docs/notebooks from the first cell to the last: python3 tests/python/notebooks.py FOLDER [EXECUTED], and leaves them with
their outputs in the folder EXECUTED, for scripts/docs. One kernel runs them all, which saves seconds for each; it forgets all names in between."""

import os
import pathlib
import sys

import nbformat
from nbclient import NotebookClient

os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # a debugger's remark
files = sorted(pathlib.Path(sys.argv[1]).glob("*.ipynb"))
notebooks = [nbformat.read(file, as_version=4) for file in files]
together = nbformat.v4.new_notebook()
for notebook in notebooks:
    together.cells += [nbformat.v4.new_code_cell("%reset -f"), *notebook.cells]
NotebookClient(together, timeout=120, kernel_name="python3").execute()
for file, notebook in zip(files, notebooks, strict=True):
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    pictures = sum("image/png" in output.get("data", {}) for output in outputs)
    if not pictures:
        sys.exit(f"{file.name}: draws no picture")
    print(f"{file.name}: {len(outputs)} outputs, {pictures} pictures")
    if len(sys.argv) > 2:
        pathlib.Path(sys.argv[2]).mkdir(parents=True, exist_ok=True)
        nbformat.write(notebook, pathlib.Path(sys.argv[2], file.name))
