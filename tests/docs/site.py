"""Makes the site of the documentation, and looks at it as a reader without a network does: site.py DOCS SITE [CHROMIUM]"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

DOCS, SITE, *CHROMIUM = sys.argv[1:]
site = pathlib.Path(SITE)

made = subprocess.run([DOCS, SITE], check=False)  # fails on warnings and on links that lead nowhere
if made.returncode != 0:
    sys.exit(made.returncode)

with_module = any(pathlib.Path(os.environ["STRANDLAB_MODULE"], "strandlab").glob("_core*.so"))
if with_module and 'id="strandlab.study"' not in (site / "python-reference.html").read_text(encoding="utf-8"):
    sys.exit("FAILED: the Python reference lacks study()")
if with_module and "<img" not in (site / "notebooks" / "1_a_panel_in_ten_lines.html").read_text(encoding="utf-8"):
    sys.exit("FAILED: the notebooks have no pictures")

if CHROMIUM and not CHROMIUM[0].endswith("NOTFOUND"):
    with tempfile.TemporaryDirectory() as profile:
        page = subprocess.run([CHROMIUM[0], "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}", "--virtual-time-budget=8000",
                               "--dump-dom", f"file://{site}/search.html?q=springback"], capture_output=True, text=True, timeout=120, check=False).stdout
    found = re.search(r"found (\d+) page", page)
    if not found or not re.search(r'href="hotpress.html[^"]*"', page[page.find('id="search-results"'):]):
        sys.exit(f"FAILED: searching for springback finds {found and found[0]}, and not docs/hotpress.md")
    print(f"search from the disk: {found[0]}s")
