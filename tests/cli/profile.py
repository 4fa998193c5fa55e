"""strandlab profile as a user meets it: what a run leaves, replicates, measured profiles, and what bad input is told."""

import csv
import json
import pathlib
import shutil

from program import SOURCE, DONE, check, expect_bad_input, finish, scratch, strandlab

MEASURED = SOURCE / "tests" / "data" / "profile" / "densitometer.csv"
# Four rows of 5 mm pressed to 10 %: a second of work.
CASE = """[mat]
length_mm = 5
rows = ["surface", "core*2", "surface"]
[kinds.core]
length_mm = 2
length_sd_mm = 0.2
gap_mm = 0.5
gap_sd_mm = 0.1
[grid]
cells_through_strand = 2
[press]
compactions = [0, 0.1]
"""


def rows(file):
    with open(file, encoding="utf-8") as text:
        return list(csv.DictReader(text))


def integral(table, compaction):
    return sum((float(r["to_mm"]) - float(r["from_mm"])) * float(r["density_kg_m3"]) for r in table if r["compaction"] == compaction)


def of_a_run():
    pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
    for seed in (1, 2, 3):
        done = strandlab("press", "a.toml", "--set", f"run.seed={seed}", "-o", f"run{seed}")
        check(done.returncode == DONE, f"press: {done.stderr}")
    table = rows("run1/profile.csv")
    check(list(table[0]) == ["compaction", "from_mm", "to_mm", "relative_height", "density_kg_m3"], "columns of profile.csv")
    check(len(table) == 16, "two compactions of four rows of two cells")
    # Density of poplar times the strands' length and thickness over the window: mass per area, before and after.
    mat = json.loads(pathlib.Path("run1/mat.json").read_text(encoding="utf-8"))
    wood = sum(s["x1"] - s["x0"] for layer in mat["layers"] for s in layer["strands"]) * mat["layer_thickness_mm"] / mat["length_mm"]
    for compaction in ("0", "0.1"):
        check(abs(integral(table, compaction) / (350 * wood) - 1) < 1e-12, f"mass at compaction {compaction}")
    summary = rows("run1/profile_summary.csv")
    kept = json.loads(pathlib.Path("run1/run.json").read_text(encoding="utf-8"))["steps"]["press"]["density_profiles"]
    check([float(r["core_kg_m3"]) for r in summary] == [s["core_kg_m3"] for s in kept], "run.json holds the summary")
    check(pathlib.Path("run1/pictures/density_profile.png").read_bytes()[:4] == b"\x89PNG", "plot of a run")


def replicates():
    done = strandlab("profile", "run1", "run2", "run3", "-o", "out", "--bins", "10", "--measured", MEASURED)
    check(done.returncode == DONE, f"profile: {done.stderr}")
    mean = rows("out/profile_mean.csv")
    check(len(mean) == 20 and mean[0]["replicates"] == "3", "mean of three replicates")
    single = [r for r in rows("out/profile.csv") if r["compaction"] == "0.1"]
    last = sum(float(r["density_kg_m3"]) for r in single if r["relative_height"] == "0.95") / 3
    check(abs(float(mean[-1]["density_kg_m3"]) / last - 1) < 1e-12, "the mean is that of the replicates")
    check(float(mean[-1]["low_kg_m3"]) < last < float(mean[-1]["high_kg_m3"]), "the band holds the mean")
    names = [r["replicate"] for r in rows("out/profile_summary.csv")]
    check(names == 2 * ["run1", "run2", "run3", "mean", "low", "high"], "rows of profile_summary.csv")
    # Specimens A and B of 6.35 mm, 1 lb/ft3 = 16.018463 kg/m3; means by the trapezoidal rule 33.94 and 33.80 lb/ft3.
    measured = rows("out/measured.csv")
    check({r["specimen"] for r in measured} == {"A", "B"} and abs(float(measured[5]["position_mm"]) - 6.35) < 1e-9, "inches")
    compared = rows("out/comparison.csv")
    check(abs(float(compared[0]["measured_mean_kg_m3"]) - 16.018463 * (33.94 + 33.80) / 2) < .01, "mean of the specimens")
    check(all(float(r["rms_difference_kg_m3"]) > 0 for r in compared), "rms difference")
    for name in ("profile", "against_compaction", "measured"):
        check(pathlib.Path(f"out/{name}.png").read_bytes()[:4] == b"\x89PNG", f"{name}.png")
    check("rms difference" in done.stdout, "the rms difference is shown")
    shutil.copytree("run2", "elsewhere/run1")
    done = strandlab("profile", "run1", "elsewhere/run1", "-o", "namesakes")
    names = {r["replicate"] for r in rows("namesakes/profile_summary.csv")}
    check(done.returncode == DONE and names >= {"run1", "elsewhere/run1"}, "folders of one name keep their paths")
    alone = strandlab("profile", "run1")
    check(alone.returncode == DONE and pathlib.Path("runs/run1-profile/profile.csv").exists(), f"one run: {alone.stderr}")


def bad_input():
    expect_bad_input(["profile", "run1", "-o", "out"], ["out", "--force"])
    expect_bad_input(["profile", "nowhere", "-o", "new"], ["nowhere", "case.toml"])
    other = strandlab("press", "a.toml", "--set", "press.speed_m_s=20", "-o", "fast")
    check(other.returncode == DONE, other.stderr)
    expect_bad_input(["profile", "run1", "fast", "-o", "new"], ["run1 and fast", "press.speed_m_s = 16", "press.speed_m_s = 20"])
    # Mat files may differ in their rows: a cell is no common bin then.
    for rows_of in (2, 3):
        layers = [{"role": "surface", "strands": [{"x0": 0, "x1": 5}]}] * rows_of
        pathlib.Path(f"m{rows_of}.json").write_text(json.dumps({"length_mm": 5, "layer_thickness_mm": 0.8, "layers": layers}), encoding="utf-8")
        done = strandlab("press", "a.toml", "--set", f"mat.file=m{rows_of}.json", "--set", "press.compactions=[0]", "-o", f"rows{rows_of}")
        check(done.returncode == DONE, done.stderr)
    expect_bad_input(["profile", "rows2", "rows3", "-o", "new"], ["rows2 and rows3 have 4 and 6 bins", "--bins"])
    check(strandlab("profile", "rows2", "rows3", "-o", "new", "--bins", "5").returncode == DONE, "--bins makes them alike")
    shutil.rmtree("new")
    # The same panel twice would have a band of no width.
    expect_bad_input(["profile", "run1", "run2", "run1", "-o", "new"], ["run1 and run1", "same panel", "run.seed = 1"])
    pathlib.Path("bad.csv").write_text("position_mm,density_kg_m3\n0,600\n0.5,x\n", encoding="utf-8")
    expect_bad_input(["profile", "run1", "-o", "new", "--measured", "bad.csv"], ["bad.csv:3", "'x' is not a number"])
    expect_bad_input(["profile", "run1", "-o", "new", "--measured", MEASURED, "--density-unit", "kg/m3"],
                     ["densitometer.csv:4", "Density A", "not kg/m3"])
    expect_bad_input(["profile", "run1", "-o", "new", "--measured", MEASURED, "--compaction", "0.3"],
                     ["--compaction 0.3", "nearest is 0.1"])
    for folder in ("run1", "run2"):
        pathlib.Path(folder, "panels", "panel_0.1.h5").unlink()
    expect_bad_input(["profile", "run1", "-o", "new"], ["run1", "compaction 0.1", "strandlab press"])


with scratch():
    of_a_run()
    replicates()
    bad_input()
finish()
