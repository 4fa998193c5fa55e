"""Studies: many panels by one plan."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Any, Mapping

from . import _core as core
from ._case import Case, _toml
from ._tables import Table, read_table
from ._types import OnProgress

_HERE = os.fspath(Path(__file__).parent.parent)


def _inline(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(key)} = {_inline(item)}" for key, item in value.items()) + "}"
    return _toml(value)


def _plan_text(plan: Mapping[str, Any]) -> str:
    """A plan file, of tables and lists of tables after the plain keys."""
    plain, tables = [], []
    for name, value in plan.items():
        if isinstance(value, Mapping):
            tables.append((f"[{name}]", value))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(item, Mapping) for item in value):
            tables.extend((f"[[{name}]]", item) for item in value)
        else:
            plain.append(f"{name} = {_toml(value)}")
    for title, table in tables:
        plain += ["", title, *(f"{json.dumps(key)} = {_inline(value)}" for key, value in table.items())]
    return "\n".join(plain) + "\n"


class Study:
    """A study's folder, as `strandlab study run` leaves it: study(), open_study()."""

    def __init__(self, folder: str | os.PathLike[str], warnings: list[str] | None = None) -> None:
        self.folder = Path(folder)
        if not (self.folder / "plan.toml").is_file():
            raise core.InputError(f"{self.folder}: this folder holds no study (no plan.toml)")
        self.warnings: list[str] = warnings or []

    def table(self, name: str) -> Table:
        """A CSV file of the folder by its name: "results", "summary"..."""
        return read_table(self.folder, name)

    @property
    def plan(self) -> Table:
        """plan.csv: every item, its seed, its values of the keys that vary."""
        return self.table("plan")

    @property
    def results(self) -> Table:
        """results.csv: the modulus of every item, state, test and glue."""
        return self.table("results")

    @property
    def summary(self) -> Table:
        """summary.csv: per cell n, mean, sd and 95 % interval, then the plan's contrasts, paired."""
        return self.table("summary")

    @property
    def effects(self) -> Table:
        """effects.csv: what each factor of the plan does."""
        return self.table("effects")

    @property
    def profiles(self) -> Table:
        """profiles.csv: density through the thickness of every item."""
        return self.table("profiles")

    @property
    def press(self) -> Table:
        """press.csv: the pressing of every item."""
        return self.table("press")

    def __repr__(self) -> str:
        return f"<strandlab.Study {self.folder}>"

    def _repr_html_(self) -> str:
        summary = self.summary
        return str(summary._repr_html_()) if hasattr(summary, "_repr_html_") else repr(self)


def study(plan: str | os.PathLike[str] | Mapping[str, Any], folder: str | os.PathLike[str] | None = None, *, workers: int = 0,
          memory_MB: float = 0, keep: str = "panels", on_progress: OnProgress | None = None) -> Study:
    """Runs all panels of a plan that its folder lacks, several at a time, and collects: the same files as `strandlab study run`.

    plan: a plan file (docs/studies.md), or its keys and tables as a dictionary, whose base may be a Case; a dictionary needs a folder.
    workers: items at a time, 0 for one per core; memory_MB: that all of them may take, 0 for what is free; keep: "panels" or "moduli".
    The workers are processes of their own. Ctrl-C, or what on_progress raises, ends them; the next call goes on where they were.
    """
    if keep not in ("panels", "moduli"):
        raise core.InputError(f"study: keep = {keep!r}: must be \"panels\" or \"moduli\"")
    if isinstance(plan, Mapping):
        if folder is None:
            raise core.InputError("study: a plan that is no file needs a folder for its results")
        with tempfile.TemporaryDirectory(prefix="strandlab_plan_") as here:
            keys = dict(plan)
            base = keys.get("base")
            if isinstance(base, Case):
                Path(here, "base.toml").write_text(base.to_toml(), encoding="utf-8")
                keys["base"] = "base.toml"
            elif isinstance(base, (str, os.PathLike)) and os.fspath(base) not in core.ready_cases():
                keys["base"] = os.path.abspath(base)
            file = Path(here, "plan.toml")
            file.write_text(_plan_text(keys), encoding="utf-8")
            return study(file, folder, workers=workers, memory_MB=memory_MB, keep=keep, on_progress=on_progress)
    where = Path(folder) if folder is not None else Path("runs", Path(plan).stem)
    asked = {"plan": os.fspath(plan), "folder": os.fspath(where), "workers": workers, "memory_bytes": 1e6 * memory_MB,
             "keep_panels": keep == "panels"}
    # One thread: its workers are forked, which a process beside whose threads NumPy's run must not do.
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_THREAD_LIMIT": "1", "PYTHONPATH": _HERE}
    child = subprocess.Popen([sys.executable, "-c", "from strandlab._study import _work; _work()", json.dumps(asked)], env=environment,
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, encoding="utf-8", start_new_session=True)
    warnings: list[str] = []
    try:
        assert child.stdout is not None
        for line in child.stdout:
            kind, *told = json.loads(line)
            if kind == "progress" and on_progress is not None:
                on_progress(*told)
            elif kind == "warning":
                warnings.append(told[0])
            elif kind in ("InputError", "RunError"):
                raise getattr(core, kind)(told[0])
        if child.wait() != 0:
            raise core.RunError(f"study: its process ended with exit code {child.returncode}; the next call goes on where it was")
    finally:
        child.kill()  # its workers end with it
        child.wait()
        if child.stdout is not None:
            child.stdout.close()
    return Study(where, warnings)


def _work() -> None:
    """The process of a study: tells on its standard output, a line of JSON each."""
    def tell(*told: Any) -> None:
        print(json.dumps(told), flush=True)

    try:
        core.run_study(**json.loads(sys.argv[1]), on_progress=partial(tell, "progress"), on_warning=partial(tell, "warning"))
    except (core.InputError, core.RunError) as error:
        tell(type(error).__name__, str(error))


def open_study(folder: str | os.PathLike[str]) -> Study:
    """Results of study() or `strandlab study run`."""
    return Study(folder)
