"""report.html in headless Chromium (web/test/report.mjs), with names that are meant well and with hostile ones."""

import json
import pathlib
import shutil
import subprocess

from program import DONE, SMALL_CASE, SOURCE, check, finish, scratch, strandlab
from report import HOSTILE, data_of

MARK = '<script type="application/json" id="data">'


def hostile_page(page):
    """The page with such names wherever a name of the user can stand; markup in data is escaped as the program does."""
    data = data_of(page)
    run = data["run"]
    run["record"]["case_name"] = HOSTILE
    run["record"]["machine"]["host"] = HOSTILE
    run["findings"] = [{"level": "warning", "text": HOSTILE}]
    run["case_text"] = HOSTILE
    for material in run["case"]["materials"]:
        material["name"] = HOSTILE
    for kind in run["case"]["kinds"]:
        kind["material"] = HOSTILE
        if kind["name"] == "surface":
            kind["name"] = HOSTILE
    for layer in run["mat"]["layers"]:
        layer["role"] = HOSTILE if layer["role"] == "surface" else layer["role"]
    for strand in run["frames"]["strands"]:
        strand["kind"] = HOSTILE if strand["kind"] == "surface" else strand["kind"]
    for table in ("moduli.csv", "theory.csv"):
        quoted = '"' + HOSTILE.replace('"', '""') + '"'
        run["tables"][table] = run["tables"][table].replace("tension", quoted).replace("rule of mixtures", quoted)
    text = pathlib.Path(page).read_text(encoding="utf-8")
    begin = text.index(MARK) + len(MARK)
    return text[:begin] + json.dumps(data).replace("<", "\\u003c") + text[text.index("</script>", begin):]


if __name__ == "__main__":
    with scratch():
        pathlib.Path("a.toml").write_text(SMALL_CASE, encoding="utf-8")
        check(strandlab("mat", "a.toml", "-o", "formed").returncode == DONE, "mat")
        # The mat of a file: its length, 5 mm, is not the case's.
        result = strandlab("run", "a.toml", "-o", "out", "--set", "mat.file=formed/mat.json", "--set", "mat.length_mm=100")
        check(result.returncode == DONE, f"run: {result.stderr}")
        pathlib.Path("hostile.html").write_text(hostile_page("out/report.html"), encoding="utf-8")
        node = subprocess.run([shutil.which("node"), SOURCE / "web" / "test" / "report.mjs", "out", "hostile.html"],
                              capture_output=True, text=True, timeout=240, check=False)
        print(node.stdout, node.stderr)
        check(node.returncode == 0, "the report in the browser")
    finish()
