"""report.html in headless Chromium (web/test/report.mjs), with names that are meant well and with hostile ones."""

import json
import pathlib
import shutil
import subprocess

from program import DONE, NO_PICTURES, SMALL_CASE, SOURCE, check, finish, scratch, strandlab
from report import HOSTILE, data_of

# Two rows of 4 mm, pressed hot in seconds.
HOT_CASE = """[mat]
length_mm = 4
rows = ["surface", "core"]
[kinds.surface]
length_mm = 0
length_sd_mm = 0
gap_mm = 0
gap_sd_mm = 0
[kinds.core]
length_mm = 0
length_sd_mm = 0
gap_mm = 0
gap_sd_mm = 0
[grid]
cells_through_strand = 2
[hotpress]
cells = 10
schedule = ["close to 50 % in 4 s", "hold until 30 s", "vent 2 s", "open 2 s"]
"""
# Of the case a.toml, shorter.
PLAN = """base = "a.toml"
replicates = 3
[set]
"press.compactions" = [0, 0.02]
[axes]
"press.speed_m_s" = [16, 32]
"kinds.core.law" = ["crushing", "hill"]
"""
MARK = '<script type="application/json" id="data">'


def with_hostile_names(folder):
    """Such names in the record and the mat of a run, from which the program writes the page's head."""
    record = json.loads(pathlib.Path(folder, "run.json").read_text(encoding="utf-8"))
    record["case_name"] = HOSTILE
    record["steps"]["press"]["findings"].append({"level": "warning", "text": HOSTILE, "about": "board", "chart": "stress", "docs": HOSTILE})
    pathlib.Path(folder, "run.json").write_text(json.dumps(record), encoding="utf-8")
    mat = json.loads(pathlib.Path(folder, "mat.json").read_text(encoding="utf-8"))
    for layer in mat["layers"]:
        layer["role"] = HOSTILE if layer["role"] == "surface" else layer["role"]
    pathlib.Path(folder, "mat.json").write_text(json.dumps(mat), encoding="utf-8")


def hostile_page(page):
    """Such names in the data as well, wherever a name of the user can stand; markup in data is escaped as the program does."""
    data = data_of(page)
    run = data["run"]
    run["record"]["machine"]["host"] = HOSTILE
    run["case_text"] = HOSTILE
    for material in run["case"]["materials"]:
        material["name"] = HOSTILE
    for kind in run["case"]["kinds"]:
        kind["material"] = HOSTILE
        if kind["name"] == "surface":
            kind["name"] = HOSTILE
    for strand in run["frames"]["strands"]:
        strand["kind"] = HOSTILE if strand["kind"] == "surface" else strand["kind"]
    for glue in run["words"]["glues"]:
        glue["name"] = HOSTILE
    for table in ("moduli.csv", "theory.csv"):
        quoted = '"' + HOSTILE.replace('"', '""') + '"'
        run["tables"][table] = run["tables"][table].replace("tension", quoted).replace("rule of mixtures", quoted)
    text = pathlib.Path(page).read_text(encoding="utf-8")
    begin = text.index(MARK) + len(MARK)
    return text[:begin] + json.dumps(data).replace("<", "\\u003c") + text[text.index("</script>", begin):]


if __name__ == "__main__":
    with scratch():
        pathlib.Path("a.toml").write_text(SMALL_CASE + NO_PICTURES, encoding="utf-8")
        check(strandlab("mat", "a.toml", "-o", "formed").returncode == DONE, "mat")
        # The mat of a file: its length, 5 mm, is not the case's.
        result = strandlab("run", "a.toml", "-o", "out", "--set", "mat.file=formed/mat.json", "--set", "mat.length_mm=100")
        check(result.returncode == DONE, f"run: {result.stderr}")
        shutil.copytree("out", "hostile")
        with_hostile_names("hostile")
        check(strandlab("report", "hostile").returncode == DONE, "report with hostile names")
        pathlib.Path("hostile.html").write_text(hostile_page("hostile/report.html"), encoding="utf-8")
        pathlib.Path("hot.toml").write_text(HOT_CASE, encoding="utf-8")
        result = strandlab("run", "hot.toml", "-o", "hot")
        check(result.returncode == DONE, f"hot run: {result.stderr}")
        pathlib.Path("plan.toml").write_text(PLAN, encoding="utf-8")
        result = strandlab("study", "run", "plan.toml", "-o", "studied")
        check(result.returncode == DONE, f"study: {result.stderr}")
        node = subprocess.run([shutil.which("node"), SOURCE / "web" / "test" / "report.mjs", "out", "hostile.html", "hot", "studied"],
                              capture_output=True, text=True, timeout=240, check=False)
        print(node.stdout, node.stderr)
        check(node.returncode == 0, "the report in the browser")
    finish()
