"""A user's program as mypy reads it; it is never run. A mark `type: ignore` is a mistake that mypy must see: it complains of marks without need."""

from typing import Any

import numpy as np

import strandlab

case = strandlab.Case.ready("osb")
mat: strandlab.Mat = strandlab.form(case)
pressed: strandlab.Pressed = strandlab.press(mat, on_progress=lambda step, fraction, detail: print(step, 100 * fraction, detail))
for panel in pressed:
    position: "np.ndarray[Any, Any]" = panel["position_mm"]
    across: float = panel.thickness_mm + panel.strands[0].spacing_mm[1]
in_memory: strandlab.Run = strandlab.run(case)
in_a_folder: strandlab.FolderRun = strandlab.run(case, folder="runs/a")
study: strandlab.Study = strandlab.study({"base": case, "axes": {"press.speed_m_s": [8, 16]}}, "speed", workers=2)

strandlab.form("osb")  # type: ignore[arg-type]
strandlab.press(case, on_progress=3)  # type: ignore[arg-type]
strandlab.press(case, on_progress=lambda step: None)  # type: ignore[misc, arg-type]
strandlab.profile(pressed)  # type: ignore[arg-type]
strandlab.study(3, "speed")  # type: ignore[arg-type]
strandlab.run(case, force="yes")  # type: ignore[call-overload]
pressed.panel  # type: ignore[attr-defined]
case.to_toml() + 1  # type: ignore[operator]
