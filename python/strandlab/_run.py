"""The steps of a run, and what they answer."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Callable, Iterator, Sequence, overload

from . import _core as core
from ._case import Case
from ._formed import Formed
from ._panel import Panel
from ._tables import Table, as_table, read_table
from ._types import OnProgress

OnState = Callable[[Panel], object]


class Mat(Formed):
    """A mat as formed, ready to press: form()."""

    _core: core.Formed

    @property
    def compactions(self) -> list[float]:
        """Compactions at which the panel will be kept, solved for this mat's weight."""
        return self._core.compactions

    @property
    def strands(self) -> Table:
        """row (0 at the bottom), kind, x0_mm, x1_mm, bottom_mm, thickness_mm of every strand."""
        return as_table(self._core.strands())

    @property
    def panel(self) -> Panel:
        """The panel before pressing."""
        return Panel(self._core.panel(), self._core, self.case, 0.0)

    def write(self, file: str | os.PathLike[str]) -> None:
        """Writes a mat file, for mat.file."""
        Path(file).write_text(self._core.text(), encoding="utf-8")

    def __repr__(self) -> str:
        return f"<strandlab.Mat {self.length_mm:g} x {self.thickness_mm:.4g} mm, {self.kg_per_m2:.3g} kg/m2>"


class Pressed:
    """A pressing: panels at the compactions of its case, and what the platens felt."""

    def __init__(self, pressed: core.Pressed, mat: Mat) -> None:
        self._core = pressed
        self.mat = mat
        self.case = mat.case
        self.panels = [Panel(panel, mat._core, mat.case, compaction) for panel, compaction in zip(pressed.panels, mat.compactions)]
        self.warnings: list[str] = pressed.warnings

    @property
    def record(self) -> Table:
        """The columns of press.csv."""
        return as_table(self._core.record())

    def __getitem__(self, number: int) -> Panel:
        return self.panels[number]

    def __len__(self) -> int:
        return len(self.panels)

    def __iter__(self) -> Iterator[Panel]:
        return iter(self.panels)

    def __repr__(self) -> str:
        return f"<strandlab.Pressed at compactions {', '.join(f'{panel.compaction:g}' for panel in self.panels)}>"


class Tested:
    """Virtual tests of panels."""

    def __init__(self, states: list[core.TestedPanel], moduli: dict[str, Any], panels: Sequence[Panel]) -> None:
        self._states = states
        self._moduli = moduli
        self._panels = panels
        self.warnings: list[str] = [warning for state in states for warning in state.warnings]

    @property
    def moduli(self) -> Table:
        """The columns of moduli.csv; a panel that cannot be tested has no rows."""
        return as_table(self._moduli)

    @property
    def not_testable(self) -> dict[float, str]:
        """Why, by compaction, for panels without moduli."""
        return {panel.compaction: state.not_testable for panel, state in zip(self._panels, self._states) if state.not_testable}

    def slips(self, number: int = -1) -> Table:
        """How far the glue points of a panel slide in tension with the softest glue, per unit of strain."""
        return as_table(self._states[number].slips())

    def __repr__(self) -> str:
        return f"<strandlab.Tested {len(self._moduli['modulus_MPa'])} moduli>"

    def _repr_html_(self) -> str:
        table = self.moduli
        return str(table._repr_html_()) if hasattr(table, "_repr_html_") else repr(self)


class Run:
    """A whole run in memory."""

    def __init__(self, pressed: Pressed, tested: Tested) -> None:
        self.case = pressed.case
        self.mat = pressed.mat
        self.pressed = pressed
        self.tested = tested

    @property
    def panels(self) -> list[Panel]:
        return self.pressed.panels

    @property
    def moduli(self) -> Table:
        """The columns of moduli.csv."""
        return self.tested.moduli

    @property
    def press(self) -> Table:
        """The columns of press.csv."""
        return self.pressed.record

    @property
    def warnings(self) -> list[str]:
        return self.pressed.warnings + self.tested.warnings

    def __repr__(self) -> str:
        return f"<strandlab.Run of {self.case.name}: {self.tested!r}>"

    def _repr_html_(self) -> str:
        return self.tested._repr_html_()


class FolderRun:
    """A run folder, as `strandlab run` leaves it: open_run()."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        file = self.folder / "run.json"
        if not file.is_file():
            raise core.InputError(f"{self.folder}: this folder holds no run (no run.json)")
        self.record: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        self.case = Case(_core_case=core.read_run_case(os.fspath(self.folder)))

    def table(self, name: str) -> Table:
        """A CSV file of the folder by its name: "moduli", "press", "morphology"..."""
        return read_table(self.folder, name)

    @property
    def moduli(self) -> Table:
        return self.table("moduli")

    @property
    def press(self) -> Table:
        return self.table("press")

    @property
    def panels(self) -> list[Panel]:
        """Read from panels/, by compaction."""
        files = sorted(self.folder.glob("panels/panel_*.h5"), key=lambda path: float(path.stem.split("_")[1]))
        return [Panel(core.read_panel(str(file)), None, self.case, float(file.stem.split("_")[1])) for file in files]

    def __repr__(self) -> str:
        return f"<strandlab.FolderRun {self.folder}>"


def form(case: Case) -> Mat:
    """Forms the mat of a case at random, or reads it."""
    return Mat(core.form(case._core), case.copy())


def _formed(case_or_mat: Case | Mat) -> Mat:
    return form(case_or_mat) if isinstance(case_or_mat, Case) else case_or_mat


def press(case_or_mat: Case | Mat, on_progress: OnProgress | None = None, on_state: OnState | None = None) -> Pressed:
    """Presses a mat. on_progress(step, fraction, detail) is called a few times a second, on_state(panel) at each state kept; what they
    raise ends the pressing. Ctrl-C raises KeyboardInterrupt within a second."""
    mat = _formed(case_or_mat)

    def tell(panel: core.Panel, number: int) -> None:
        assert on_state is not None
        on_state(Panel(panel, mat._core, mat.case, mat.compactions[number]))

    return Pressed(core.press(mat._core, on_progress, tell if on_state else None), mat)


def _panels(pressed: Panel | Pressed | Sequence[Panel]) -> Sequence[Panel]:
    return [pressed] if isinstance(pressed, Panel) else list(pressed)


def _formed_of(panel: Panel) -> core.Formed:
    if panel._formed is None:  # read from a folder
        panel._formed = core.form(panel.case._core)
    return panel._formed


def test(pressed: Panel | Pressed | Sequence[Panel], case: Case | None = None, on_progress: OnProgress | None = None) -> Tested:
    """Tests panels as their case says, or with the [glue] and [test] keys of another case. on_progress(step, fraction, detail) is called
    before each panel and at the end; what it raises ends the tests. Ctrl-C raises KeyboardInterrupt within a second."""
    panels = _panels(pressed)
    if not panels:
        raise core.InputError("there is no panel to test")
    states = []
    for number, panel in enumerate(panels):
        if on_progress:
            on_progress("test", number / len(panels), f"compaction {panel.compaction:.4g}")
        states.append(core.test((case or panel.case)._core, panel._core, panel.compaction))
    if on_progress:
        on_progress("test", 1.0, f"{len(panels)} panels")
    return Tested(states, core.moduli(_formed_of(panels[0]), states), panels)


def profile(panel: Panel, bins: int | None = None) -> Table:
    """Density through the thickness: height_mm above the bottom face, density_kg_m3; bins of one cell of the press, or so many."""
    if bins is not None and bins < 1:
        raise core.InputError(f"profile: bins = {bins}: must be 1 or more")
    return as_table(core.density_profile(_formed_of(panel), panel._core, panel.compaction, bins or 0))


def cure(panel: Panel) -> Table:
    """Glue points of a panel: strand_a, strand_b (numbers in panel.strands), x_mm, y_mm, length_mm of glue line, gap_mm."""
    return as_table(core.cure(panel.case._core, panel._core))


@overload
def run(case: Case, folder: None = None, on_progress: OnProgress | None = None, force: bool = False) -> Run: ...
@overload
def run(case: Case, folder: str | os.PathLike[str], on_progress: OnProgress | None = None, force: bool = False) -> FolderRun: ...


def run(case: Case, folder: str | os.PathLike[str] | None = None, on_progress: OnProgress | None = None,
        force: bool = False) -> Run | FolderRun:
    """Forms, presses and tests: in memory, or with `folder` as `strandlab run -o FOLDER` does, with all its files. The case of a plate
    goes into a folder only; in memory there is plate()."""
    if folder is not None:
        core.run_in_folder(case._core, os.fspath(folder), force, on_progress)
        return open_run(folder)
    pressed = press(case, on_progress)
    return Run(pressed, test(pressed, on_progress=on_progress))


def open_run(folder: str | os.PathLike[str]) -> FolderRun:
    """Results of `strandlab run`."""
    return FolderRun(folder)


class HotPress:
    """A hot press cycle through the thickness: hotpress()."""

    def __init__(self, answer: dict[str, Any]) -> None:
        self._record = answer["record"]
        self._profiles = answer["profiles"]
        self.answers: dict[str, Any] = answer["answers"]
        self.summary: list[str] = answer["summary"]
        self.notes: list[str] = answer["notes"]

    @property
    def record(self) -> Table:
        """The columns of hotpress.csv, one row per step."""
        return as_table(self._record)

    @property
    def profiles(self) -> Table:
        """The columns of transfer_profiles.csv."""
        return as_table(self._profiles)

    def __repr__(self) -> str:
        return "\n".join(self.summary)


def hotpress(case: Case, on_progress: OnProgress | None = None) -> HotPress:
    """How long to press: the [hotpress] cycle of a case through its mat's thickness, in a second. on_progress(step, fraction, detail) is
    called after each step of the cycle; what it raises, or Ctrl-C, ends it."""
    return HotPress(core.hotpress(case._core, on_progress))


def theory(case: Case) -> Table:
    """Closed-form estimates of the case's panel: model, compaction, density_kg_m3, compliance_t_mm_per_MPa, ..., modulus_MPa."""
    return as_table(core.theory(case._core))


class BondLines:
    """Glue compliances from double-lap-shear tests: bondline()."""

    def __init__(self, answer: dict[str, Any]) -> None:
        self._answer = answer

    @property
    def specimens(self) -> Table:
        return as_table(self._answer["specimens"])

    @property
    def groups(self) -> Table:
        return as_table(self._answer["groups"])

    @property
    def comparisons(self) -> Table:
        return as_table(self._answer["comparisons"])

    def write(self, file: str | os.PathLike[str]) -> None:
        """Writes the result that glue.from_bondline names."""
        Path(file).write_text(self._answer["json"], encoding="utf-8")

    def __repr__(self) -> str:
        return str(self._answer["text"])


def bondline(file: str | os.PathLike[str], group_by: Sequence[str] = ("group",), within: Sequence[str] = ()) -> BondLines:
    """Analyses a table of specimens (docs/bondline.md)."""
    return BondLines(core.bondline(os.fspath(file), list(group_by), list(within)))


def bondline_example(seed: int = 1) -> str:
    """A made-up table of specimens with published means and scatter, to try bondline() on."""
    return core.bondline_example(seed)
