"""Tables: pandas.DataFrame where pandas is installed, else a dict of arrays by column."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

from . import _core as core

Table = Any


def as_table(columns: dict[str, Any]) -> Table:
    try:
        import pandas
    except ImportError:
        return columns
    return pandas.DataFrame(columns)


def read_table(folder: Path, name: str) -> Table:
    """NAME.csv of a folder."""
    file = folder / f"{name}.csv"
    if not file.is_file():
        there = ", ".join(sorted(path.stem for path in folder.glob("*.csv"))) or "none"
        raise core.InputError(f"{folder}: no table {name}; there are {there}")
    try:
        import pandas
    except ImportError:
        with file.open(newline="", encoding="utf-8") as stream:
            header, *rows = csv.reader(stream)
        return {column: _numbers([row[i] for row in rows]) for i, column in enumerate(header)}
    return pandas.read_csv(file, float_precision="round_trip")


def _numbers(texts: list[str]) -> Any:
    import numpy as np
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return texts
