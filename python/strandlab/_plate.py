"""Plates: mats in three dimensions, tested as they lie."""

from __future__ import annotations

from . import _core as core
from ._case import Case
from ._formed import Formed
from ._tables import Table, as_table


class Plate(Formed):
    """A mat in 3D, read from the mat file of its case or formed (mat.width_mm): plate()."""

    _core: core.FormedPlate

    @property
    def width_mm(self) -> float:
        """Of the window, along y."""
        return self._core.width_mm

    @property
    def strands(self) -> Table:
        """strand, layer (both from 0), kind, x_mm and y_mm of the middle, length_mm, width_mm of every strand."""
        return as_table(self._core.strands())

    def test(self) -> TestedPlate:
        """Its moduli, which follow from the sides of its mat (docs/panels3d.md). Ctrl-C ends it between two solutions of equations."""
        return TestedPlate(core.test_plate(self._core))

    def __repr__(self) -> str:
        return f"<strandlab.Plate {self.length_mm:g} x {self.width_mm:g} x {self.thickness_mm:.4g} mm>"


class TestedPlate:
    """Virtual tests of a plate."""

    def __init__(self, tested: core.TestedPlate) -> None:
        self._core = tested
        self.warnings: list[str] = tested.warnings

    @property
    def moduli(self) -> Table:
        """The columns of moduli.csv."""
        return as_table(self._core.moduli())

    @property
    def abd(self) -> Table:
        """The columns of abd.csv: the plate stiffness of a periodic mat, a row for each glue; no rows for a cut one."""
        return as_table(self._core.abd())

    def __repr__(self) -> str:
        return f"<strandlab.TestedPlate {len(self._core.moduli()['modulus_MPa'])} moduli>"


def plate(case: Case) -> Plate:
    """The plate of a case whose mat.file is in 3D or that has mat.width_mm, with press.compactions = [0]."""
    return Plate(core.form_plate(case._core), case.copy())
