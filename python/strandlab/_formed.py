"""What mats of sections and of plates have in common."""

from __future__ import annotations

from . import _core as core
from ._case import Case


class Formed:
    def __init__(self, formed: core.Formed | core.FormedPlate, case: Case) -> None:
        self._core = formed
        self.case = case

    @property
    def length_mm(self) -> float:
        """Of the window, along x."""
        return self._core.length_mm

    @property
    def thickness_mm(self) -> float:
        """Distance of the platens from each other."""
        return self._core.thickness_mm

    @property
    def kg_per_m2(self) -> float:
        """Weight per area of panel."""
        return self._core.kg_per_m2
