"""The lines of docs/files.md for ParaView's Python, run on a small panel; skipped without pvpython, or a display to draw on."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from program import DONE, NO_PICTURES, SMALL_CASE, SOURCE, check, finish, scratch, strandlab

if not shutil.which("pvpython"):
    print("skipped: no pvpython (Debian: paraview)")
    sys.exit(77)
display = [] if os.environ.get("DISPLAY") else [shutil.which("xvfb-run"), "-a"]
if None in display:
    print("skipped: neither a display nor xvfb-run (Debian: xvfb, xauth)")
    sys.exit(77)

page = (SOURCE / "docs" / "files.md").read_text(encoding="utf-8")
lines = re.search(r"^In ParaView's Python.*?^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)[1]
with scratch():
    pathlib.Path("panel.toml").write_text(SMALL_CASE + NO_PICTURES, encoding="utf-8")
    check(strandlab("run", "panel.toml").returncode == DONE, "run")
    pathlib.Path("look.py").write_text(lines.replace("panel.png", "panel.bmp"), encoding="utf-8")  # pixels as they are
    picture = pathlib.Path("panel.bmp")
    for _ in range(3):  # a display that was just started is not always there yet
        looked = subprocess.run([*display, "pvpython", "look.py"], capture_output=True, text=True, timeout=240, check=False)
        if picture.exists():
            break
    check(looked.returncode == 0 and picture.exists(), f"ParaView draws the panel: {looked.stderr[-500:]}")
    pixels = picture.read_bytes()[-2400 * 900 * 3:]
    colours = {pixels[i:i + 3] for i in range(0, len(pixels), 3)}
    check(len(colours) > 50, f"the panel in the colours of its density: {len(colours)} colours")
finish()
