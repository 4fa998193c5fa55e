"""init | check, --set, and a small run from the mat to the moduli, killed at any moment and on any number of threads."""

import csv
import json
import pathlib
import random
import re
import subprocess
import time

from program import DONE, FAILED, PROGRAM, SMALL_CASE, SOURCE, check, expect_bad_input, files, finish, scratch, strandlab

CASE = SMALL_CASE + """[run]
checkpoint_interval_s = 0.05
"""

# What must not depend on kills and threads, to the last bit.
RESULTS = ("mat.json", "press.csv", "moduli.csv", "morphology.csv", "histograms.csv", "profile.csv")


def results(folder):
    kept = {name: pathlib.Path(folder, name).read_bytes() for name in RESULTS}
    kept.update({p.name: p.read_bytes() for p in pathlib.Path(folder, "paraview").iterdir()})
    kept.update({p.name: p.read_bytes() for p in pathlib.Path(folder, "panels").iterdir()})
    kept.update({p.name: p.read_bytes() for p in pathlib.Path(folder, "frames").iterdir()})
    kept.update({p.name: p.read_bytes() for p in pathlib.Path(folder, "glue_lines").iterdir()})
    return kept


def init_and_check():
    for name in ("osb", "rathi20_vtc"):
        made = strandlab("init", name)
        check(made.returncode == DONE, f"init {name}")
        check((SOURCE / "cases" / f"{name}.toml").read_text(encoding="utf-8") == made.stdout, f"cases/{name}.toml is init {name}")
        pathlib.Path("a.toml").write_text(made.stdout, encoding="utf-8")
        first = strandlab("check", "a.toml")
        pathlib.Path("b.toml").write_text(first.stdout, encoding="utf-8")
        check(first.returncode == DONE, f"check of init {name}: {first.stderr}")
        check(strandlab("check", "b.toml").stdout == first.stdout, f"check of check of {name}")
        for word in ("particles:", "cells:", "steps:", "memory:", "run time"):
            check(word in first.stdout, f"check {name} says {word}")
    page = (SOURCE / "docs" / "cases.md").read_text(encoding="utf-8")
    check(strandlab("init", "--reference").stdout == page, "docs/cases.md is init --reference")


def overrides():
    pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
    shown = strandlab("check", "a.toml", "--set", "press.speed_m_s=2", "--set", "press.compactions=[0]", "--set", "press.sides=free",
                      "--set", "test.kinds=[tension]", "--set", "run.threads=1", "--set", "glue.compliance_n_mm_per_MPa=1e-3").stdout
    for line in ("speed_m_s = 2\n", "compactions = [0]\n", "sides = \"free\"\n", "kinds = [\"tension\"]\n", "threads = 1\n",
                 "compliance_n_mm_per_MPa = 0.001\n"):
        check(line in shown, f"--set gives {line!r}")
    mat = SOURCE / "tests" / "data" / "reference" / "lvl.json"
    shown = strandlab("check", "a.toml", "--set", f"mat.file={mat}").stdout
    check(f"file = \"{mat}\"" in shown, "--set mat.file")


def single_steps():
    """mat, press and test one by one end with the same bits as run; an existing result is never replaced unasked."""
    pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
    for command in ("mat", "press", "test"):
        result = strandlab(command, "a.toml", "-o", "steps")
        check(result.returncode == DONE, f"{command}: {result.stderr}")
    result = strandlab("run", "a.toml")
    check(result.returncode == DONE, f"run: {result.stderr}")
    check("\r" not in result.stdout, "plain lines where stdout is not a terminal")
    check(results("steps") == results("runs/a"), "mat, press, test give the bits of run")
    before = files("runs/a")
    again = strandlab("run", "a.toml")
    check(again.returncode == DONE and "finished" in again.stdout, "a finished run says so")
    check({k: v for k, v in files("runs/a").items() if not k.endswith("run.json")} ==
          {k: v for k, v in before.items() if not k.endswith("run.json")}, "a finished run is left alone")
    forced = strandlab("test", "a.toml", "--set", "glue.compliance_t_mm_per_MPa=[0.0105]", "--force")
    check(forced.returncode == DONE, f"test --force: {forced.stderr}")
    check(len(read_csv("runs/a/moduli.csv")) == 3 * 2, "test --force with other glue keeps the pressed panels")


def read_csv(name):
    with open(name, encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def run_folder():
    """The files and columns that scripts rely on."""
    pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
    check(strandlab("run", "a.toml", "-o", "out").returncode == DONE, "run -o out")
    press = read_csv("out/press.csv")
    for column in ("compaction", "time_ms", "stress_MPa", "force_top_N", "force_bottom_N", "kinetic_mJ", "internal_mJ", "plastic_mJ"):
        check(column in press[0], f"press.csv has {column}")
    check(abs(float(press[-1]["compaction"]) - 0.04) < 0.002, "press.csv goes to the last compaction")
    moduli = read_csv("out/moduli.csv")
    for column in ("compaction", "test", "compliance_t_mm_per_MPa", "modulus_MPa"):
        check(column in moduli[0], f"moduli.csv has {column}")
    check(len(moduli) == 3 * 2 * 2, f"moduli.csv has a line per compaction, test and compliance: {len(moduli)}")
    # A surface strand (E_L = 9936 MPa) over a gapped core strand: between half of its modulus and all of it.
    tension = [float(m["modulus_MPa"]) for m in moduli if m["test"] == "tension"]
    check(all(2000 < e < 12000 for e in tension), f"tension moduli {tension}")
    theory = read_csv("out/theory.csv")
    check(list(theory[0]) == ["compaction", "model", "test", "compliance_t_mm_per_MPa", "modulus_MPa"], f"theory.csv: {theory[0]}")
    # Per compaction and compliance: tension by two models, bending by one. Surface row 9936 MPa with gaps of 15 between strands
    # of 150 mm, core row 427 MPa with gaps of 1 between 2 mm: their mean, over 1 - C, both stiffened by plane strain: nu_TL = .017.
    check(len(theory) == 3 * 2 * 3, f"theory.csv has a line per modulus and model: {len(theory)}")
    for row in theory:
        if row["model"] == "rule of mixtures":
            expected = (9936 * 150 / 165 + 427 * 2 / 3) / 2 / (1 - float(row["compaction"])) / (1 - 0.017**2 * 9936 / 427)
            check(row["test"] == "tension" and abs(float(row["modulus_MPa"]) / expected - 1) < 1e-9, f"{row}, expected {expected}")
    record = json.loads(pathlib.Path("out/run.json").read_text(encoding="utf-8"))
    for key in ("strandlab", "git", "seed", "machine"):
        check(key in record, f"run.json has {key}")
    for key in ("wall_s", "particle_steps_per_s", "ns_per_particle_step", "ns_per_particle_step_by_phase"):
        check(key in record["steps"]["press"], f"run.json has press {key}")
    for name in ("case.toml", "log.txt", "paraview/panel.pvd", "panels/panel_0.04.h5", "pictures/grain_angle_0.04.png",
                 "pictures/density_0.04.png"):
        check(pathlib.Path("out", name).stat().st_size > 0, f"run folder has {name}")


# Two strands at two heights, a row of air between their faces: nothing connects the ends until a little pressing brings them
# within the curing gap.
APART = """{"length_mm": 5, "layer_thickness_mm": 0.8, "layers": [
  {"role": "surface", "strands": [{"x0": 0, "x1": 3}]},
  {"role": "surface", "strands": [{"x0": 0, "x1": 1}]},
  {"role": "surface", "strands": [{"x0": 2, "x1": 5}]}]}"""


ONE_ROW = """{"length_mm": 5, "layer_thickness_mm": 0.8, "layers": [
  {"role": "surface", "strands": [{"x0": 0, "x1": 2}, {"x0": 3, "x1": 5}]}]}"""


def not_testable():
    """A panel that cannot be tested costs its own moduli only; that none can is an error."""
    pathlib.Path("mat.json").write_text(APART, encoding="utf-8")
    pathlib.Path("a.toml").write_text("[mat]\nfile = \"mat.json\"\n[press]\ncompactions = [0, 0.04]\n[glue]\nmax_gap_mm = 0.78\n",
                                      encoding="utf-8")
    result = strandlab("run", "a.toml")
    check(result.returncode == DONE, f"run: {result.stderr}")
    check("compaction 0: this panel cannot be tested: no strands connect" in result.stdout + result.stderr, result.stdout + result.stderr)
    check({row["compaction"] for row in read_csv("runs/a/moduli.csv")} == {"0.04"}, "moduli of the other state")
    states = json.loads(pathlib.Path("runs/a/run.json").read_text(encoding="utf-8"))["steps"]["test"]["states"]
    check([("not_testable" in s, len(s["moduli"]) > 0) for s in states] == [(True, False), (False, True)], f"run.json: {states}")
    none = strandlab("run", "a.toml", "-o", "none", "--set", "press.compactions=[0]")
    check(none.returncode == 2 and "no panel can be tested" in none.stderr, f"none: {none.returncode} {none.stderr}")


def missing_results():
    """A finished run of which results were deleted makes again what follows from the rest, and says what only pressing can make."""
    pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
    check(strandlab("run", "a.toml", "-o", "out").returncode == DONE, "run")
    before = results("out")
    page = pathlib.Path("out/report.html").read_bytes()
    drawn = [str(p.relative_to("out")) for folder in ("pictures", "plots") for p in sorted(pathlib.Path("out", folder).iterdir())]
    check(len(drawn) == 3 * 2 + 4 + 2 * 2, f"pictures of three panels, plots of the pressing and of two tests: {drawn}")
    everything = {name: pathlib.Path("out", name).read_bytes() for name in drawn}
    for name in drawn:
        pathlib.Path("out", name).unlink()
    result = strandlab("run", "a.toml", "-o", "out")
    check(result.returncode == DONE and "made again" in result.stdout, f"pictures: {result.stdout}{result.stderr}")
    later = strandlab("run", "a.toml", "-o", "later", "--set", "run.pictures=false")
    check(later.returncode == DONE and not any(pathlib.Path("later", folder).exists() for folder in ("pictures", "plots")), "no pictures are asked for")
    check("finished" in strandlab("run", "a.toml", "-o", "later", "--set", "run.pictures=false").stdout, "none are missing then")
    check(results("later") == before, "results without pictures are the same")
    check(strandlab("run", "a.toml", "-o", "later").returncode == DONE, "pictures later")
    for name, data in everything.items():
        check(pathlib.Path("later", name).read_bytes() == data, f"{name} is drawn later")
    for name, data in everything.items():
        check(pathlib.Path("out", name).exists() and pathlib.Path("out", name).read_bytes() == data, f"{name} is drawn again")
    check("finished" in strandlab("run", "a.toml", "-o", "out").stdout, "nothing is missing any more")
    for name in ("mat.json", "press.csv", "profile.csv", "moduli.csv", "theory.csv", "report.html", "plots/tension_against_compliance.png"):
        kept = pathlib.Path("out", name).read_bytes()
        pathlib.Path("out", name).unlink()
        result = strandlab("run", "a.toml", "-o", "out")
        check(result.returncode == DONE and "this run is finished" not in result.stdout or name == "report.html", f"{name}: {result.stdout}")
        check(name in result.stdout and pathlib.Path("out", name).read_bytes() == kept, f"{name} is made again: {result.stdout}{result.stderr}")
    check(results("out") == before and pathlib.Path("out/report.html").read_bytes() == page, "all is as it was")
    moved = pathlib.Path("out/panels/panel_0.02.h5").rename("panel")
    for command in ("run", "press"):
        result = strandlab(command, "a.toml", "-o", "out")
        check(result.returncode == 2 and "panels/panel_0.02.h5" in result.stderr and "--force" in result.stderr, f"{command}: {result.stderr}")
    result = strandlab("test", "a.toml", "-o", "out", "--force")
    check(result.returncode == 2 and "panels/panel_0.02.h5" in result.stderr and "put it back" in result.stderr, f"test: {result.stderr}")
    moved.rename("out/panels/panel_0.02.h5")
    for name in ("press.csv", "checkpoint.h5", "checkpoint.previous.h5"):
        pathlib.Path("out", name).unlink()
    result = strandlab("run", "a.toml", "-o", "out")
    check(result.returncode == 2 and "press.csv" in result.stderr and "--force" in result.stderr, f"no checkpoint: {result.stderr}")


def nothing_to_test():
    """A mat whose ends nothing can connect is refused before hours of pressing, not after; it can be pressed all the same."""
    pathlib.Path("mat.json").write_text(ONE_ROW, encoding="utf-8")
    pathlib.Path("a.toml").write_text("[mat]\nfile = \"mat.json\"\n[press]\ncompactions = [0, 0.02]\n", encoding="utf-8")
    for command in ("run", "check"):
        expect_bad_input([command, "a.toml"], ["nothing to test in this mat", "x = 5 mm", "strandlab press"])
    check(strandlab("press", "a.toml").returncode == DONE, "press alone")
    check(strandlab("test", "a.toml").returncode == 2, "test")


# The same by densities.
BY_DENSITY = CASE.replace("compactions = [0, 0.02, 0.04]", "densities_kg_m3 = [300, 310]")


def densities():
    """Densities are solved for the weight of the mat; from then on the folder is that of any other run."""
    pathlib.Path("a.toml").write_text(BY_DENSITY, encoding="utf-8")
    shown = strandlab("check", "a.toml").stdout
    formed = float(re.search(r"# as formed: ([0-9.]+) kg/m3", shown).group(1))
    result = strandlab("run", "a.toml", "-o", "out")
    check(result.returncode == DONE, f"run: {result.stderr}")
    states = json.loads(pathlib.Path("out/run.json").read_text(encoding="utf-8"))["states"]
    for state, asked in zip(states, (300, 310), strict=True):
        check(abs(state["density_kg_m3"] - asked) < 0.1, f"density: {state}")
        check(abs(state["compaction"] - (1 - formed / asked)) < 2e-4, f"compaction of {asked} from {formed}: {state}")
        check(f"# kept at compaction {state['compaction']}: " in shown, f"check says {state['compaction']}")
        check(pathlib.Path(f"out/panels/panel_{state['compaction']}.h5").exists(), f"panel at {state['compaction']}")
    moduli = read_csv("out/moduli.csv")
    check({m["compaction"] for m in moduli} == {str(s["compaction"]) for s in states}, "moduli.csv names the states")
    check(all(abs(float(m["density_kg_m3"]) - 300) < 0.1 for m in moduli if m["compaction"] == str(states[0]["compaction"])),
          "moduli.csv has their densities")
    check("finished" in strandlab("run", "out/case.toml", "-o", "out").stdout, "case.toml is the same case")
    expect_bad_input(["run", "a.toml", "-o", "out", "--set", "press.densities_kg_m3=[300, 320]"], ["another case", "densities_kg_m3"])
    expect_bad_input(["check", "a.toml", "--set", "press.densities_kg_m3=[200, 320]"], ["entry 1, 200 kg/m3, is below the mat as formed"])
    for command in (("report", "out"), ("profile", "out", "-o", "profile")):
        result = strandlab(*command)
        check(result.returncode == DONE, f"{command[0]}: {result.stderr}")


def threads():
    pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
    for count in (1, 2, 3):
        result = strandlab("run", "a.toml", "-o", f"t{count}", "--set", f"run.threads={count}")
        check(result.returncode == DONE, f"{count} threads: {result.stderr}")
        check(results(f"t{count}") == results("t1"), f"the bits of {count} threads are those of one")


def killed():
    """kill -9 at random moments of the whole run, again and again, then to the end."""
    pathlib.Path("a.toml").write_text(BY_DENSITY, encoding="utf-8")
    begin = time.monotonic()
    check(strandlab("run", "a.toml", "-o", "whole").returncode == DONE, "whole run")
    whole_s = time.monotonic() - begin
    chance = random.Random(1)
    resumed = 0
    for _ in range(6):
        with subprocess.Popen([PROGRAM, "run", "a.toml", "-o", "killed"], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            time.sleep(chance.uniform(0.05, 0.8) * whole_s)
            process.kill()
            out, _ = process.communicate()
            resumed += b"going on" in out
    result = strandlab("run", "a.toml", "-o", "killed")
    check(result.returncode == DONE, f"run after kills: {result.stderr}")
    check(resumed + ("going on" in result.stdout) > 0, "some run went on from a checkpoint")
    check(results("killed") == results("whole"), "the bits after kills are those of an undisturbed run")


def failing():
    """A press faster than the waves it makes throws particles out: exit code 3, what happened where, the last good state kept."""
    pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
    result = strandlab("press", "a.toml", "--set", "press.speed_m_s=1000", "--set", "press.compactions=[0.97]",
                       "--set", "press.ramp_time_fraction=0", "--set", "grid.courant=0.9")
    check(result.returncode == FAILED, f"exit code {result.returncode}, expected 3")
    for word in ("step", "time", "strand", "mm"):
        check(word in result.stderr, f"the message says the {word}: {result.stderr}")
    check(pathlib.Path("runs/a/checkpoint.h5").stat().st_size > 0, "the last good state is kept")
    check(result.stderr.split(": ", 1)[1].strip() in pathlib.Path("runs/a/log.txt").read_text(encoding="utf-8"), "the log has the error")


for test in (init_and_check, overrides, single_steps, run_folder, missing_results, not_testable, nothing_to_test, densities, threads, killed, failing):
    with scratch():
        test()
finish()
