"""What users hand over."""

from __future__ import annotations

from typing import Callable

OnProgress = Callable[[str, float, str], object]  # step, fraction of it, detail for people
