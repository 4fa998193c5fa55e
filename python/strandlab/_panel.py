"""Panels and their strands."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterator

from . import _core as core

if TYPE_CHECKING:
    import numpy as np

    from ._case import Case

# Strands by the angle of their grain: along the panel, at 45 degrees, across.
_WOODS = ("#d9a441", "#b5732a", "#7a4a1f")


class Strand:
    """A strand: material points on a lattice of counts[0] along x counts[1] through it, numbered along first.

    Its fields are read-only views of the library's memory, without a copy, that keep their panel alive:

        strand["position_mm"]           (points, 2)     mm: along the panel, height
        strand["velocity_mm_s"]         (points, 2)     mm/s
        strand["deformation_gradient"]  (points, 2, 2)  1: F[:, i, j] = dx_i/dX_j since formation
        strand["kirchhoff_stress_MPa"]  (points, 6)     MPa, in the strand's axes: 11 22 33 23 13 12
        strand["plastic_strain"]        (points,)       1

    and what else Strand.units() names, one value per point. The mesh, corners_mm() and cells(), is not stored but follows from them: it is
    computed at the first call, and kept.
    """

    def __init__(self, strand: core.Strand) -> None:
        self._core = strand
        self._fields = strand.fields
        self._corners: np.ndarray[Any, Any] | None = None
        self._cells: np.ndarray[Any, Any] | None = None

    @staticmethod
    def units() -> dict[str, tuple[str, str]]:
        """Unit and meaning of each field."""
        return core.field_units()

    @property
    def kind(self) -> str:
        """Name of the kind of strand, as in [kinds.NAME]."""
        return self._core.kind

    @property
    def row(self) -> int:
        """Row of the mat, 0 at the bottom."""
        return self._core.row

    @property
    def angle_deg(self) -> float:
        """Grain against the section."""
        return self._core.angle_deg

    @property
    def counts(self) -> tuple[int, int]:
        """Points along the strand and through its thickness."""
        return self._core.counts

    @property
    def spacing_mm(self) -> tuple[float, float]:
        """Distance of the points as formed, along and through."""
        return self._core.spacing_mm

    @property
    def fields(self) -> dict[str, np.ndarray[Any, Any]]:
        """All fields by name."""
        return dict(self._fields)

    def corners_mm(self) -> np.ndarray[Any, Any]:
        """Positions of the corners of the points' cells, (corners, 2), mm; one more than the points on each axis. Read-only."""
        if self._corners is None:
            self._corners = self._core.corners()
        return self._corners

    def cells(self) -> np.ndarray[Any, Any]:
        """Numbers of the four corners of each point's cell, (points, 4), counter-clockwise. Read-only."""
        if self._cells is None:
            self._cells = self._core.cells()
        return self._cells

    def __getitem__(self, field: str) -> np.ndarray[Any, Any]:
        return self._fields[field]

    def __len__(self) -> int:
        return len(self._core)

    def __repr__(self) -> str:
        return f"<strandlab.Strand {self.kind}, row {self.row}, {self.counts[0]} x {self.counts[1]} points>"


class Panel:
    """A panel at one compaction: strands between two platens, a section 1 mm deep."""

    def __init__(self, panel: core.Panel, formed: core.Formed | None, case: Case, compaction: float) -> None:
        self._core = panel
        self._formed = formed
        self.case = case
        self.compaction = compaction  # that was asked for; the pressing stopped within a time step of it
        self.strands: list[Strand] = [Strand(strand) for strand in panel.strands]
        self._joined: dict[str, np.ndarray[Any, Any]] = {}  # fields of all points, where they were asked for

    @property
    def length_mm(self) -> float:
        return self._core.length_mm

    @property
    def thickness_mm(self) -> float:
        """Distance of the platens."""
        return self._core.thickness_mm

    @property
    def points(self) -> int:
        """Number of material points."""
        return sum(len(strand) for strand in self.strands)

    @property
    def fields(self) -> dict[str, np.ndarray[Any, Any]]:
        """The fields of all points, strand after strand, with shapes and units as Strand has them. Each strand has memory of its own, so
        they are copies, where its own fields are views; they are made at the first call and kept. Read-only."""
        return {field: self[field] for field in self.strands[0].fields}

    def __getitem__(self, field: str) -> np.ndarray[Any, Any]:
        import numpy as np

        if field not in self.strands[0].fields:
            raise KeyError(f"the points of this panel have no field {field}; they have {', '.join(self.strands[0].fields)}")
        if field not in self._joined:
            joined = np.concatenate([strand[field] for strand in self.strands])
            joined.setflags(write=False)
            self._joined[field] = joined
        return self._joined[field]

    def to_vtk(self, file: str | os.PathLike[str]) -> None:
        """Writes a .vtu file for ParaView."""
        self._core.to_vtk(os.fspath(file))

    def plot(self, field: str | None = None, ax: Any = None, **style: Any) -> Any:
        """Draws the section with matplotlib and returns its axes: strands by the angle of their grain, or a scalar field of points.

        `style` goes to matplotlib's PolyCollection.
        """
        import matplotlib.pyplot as plt
        import numpy as np
        from matplotlib.collections import PolyCollection

        if ax is None:
            _, ax = plt.subplots(figsize=(9, 2 + 9 * self.thickness_mm / self.length_mm))
        polygons: list[np.ndarray[Any, Any]] = []
        if field is None:
            for strand in self.strands:
                nx, ny = (count + 1 for count in strand.counts)
                grid = strand.corners_mm().reshape(ny, nx, 2)
                polygons.append(np.concatenate([grid[0], grid[1:, -1], grid[-1, -2::-1], grid[-2:0:-1, 0]]))
            colours = [_WOODS[int(round(min(abs(strand.angle_deg), 90) / 45))] for strand in self.strands]
            drawn = PolyCollection(polygons, **{"facecolors": colours, "edgecolors": "#3a2412", "linewidths": 0.3, **style})
        else:
            for strand in self.strands:
                polygons.extend(strand.corners_mm()[strand.cells()])
            drawn = PolyCollection(polygons, array=self[field], **{"edgecolors": "face", "linewidths": 0.1, **style})
            unit = Strand.units()[field][0]
            ax.figure.colorbar(drawn, ax=ax, label=field if unit == "1" else f"{field} ({unit})", orientation="horizontal", aspect=40)
        ax.add_collection(drawn)
        ax.autoscale_view()
        ax.set_aspect("equal")
        ax.set_xlabel("along the panel, mm")
        ax.set_ylabel("mm")
        return ax

    def __iter__(self) -> Iterator[Strand]:
        return iter(self.strands)

    def __repr__(self) -> str:
        return (f"<strandlab.Panel {self.length_mm:g} x {self.thickness_mm:.4g} mm, {len(self.strands)} strands, {self.points} points, "
                f"compaction {self.compaction:g}>")

    def _repr_html_(self) -> str:
        import base64
        import html
        import io

        import matplotlib.pyplot as plt
        figure, ax = plt.subplots(figsize=(9, 2 + 9 * self.thickness_mm / self.length_mm))
        self.plot(ax=ax)
        picture = io.BytesIO()
        figure.savefig(picture, format="png", dpi=100, bbox_inches="tight")
        plt.close(figure)
        return f'{html.escape(repr(self))}<br><img src="data:image/png;base64,{base64.b64encode(picture.getvalue()).decode()}" alt="section">'
