"""strandlab hotpress as a user meets it: files, answers, logs, and what bad input is told."""

import csv
import json
import pathlib

from program import BAD_INPUT, DONE, check, expect_bad_input, finish, scratch, strandlab

# The column's mat of the check values: 20 full rows of poplar, .8 mm x 350 kg/m3 each, pressed from 16 to 9 mm.
CASE = """[mat]
rows = ["surface*5", "core*10", "surface*5"]
[kinds.surface]
law = "crushing"
length_mm = 0
length_sd_mm = 0
gap_mm = 0
gap_sd_mm = 0
[kinds.core]
law = "crushing"
length_mm = 0
length_sd_mm = 0
gap_mm = 0
gap_sd_mm = 0
[hotpress]
cells = 20
step_s = 0.5
schedule = ["close to 9 mm in 25 s", "hold until 150 s", "vent 10 s", "open 20 s"]
"""


def write(name, text):
    pathlib.Path(name).write_text(text, encoding="utf-8")


def rows(file):
    with open(file, encoding="utf-8") as text:
        return list(csv.DictReader(text))


def press(*arguments):
    done = strandlab("hotpress", *arguments)
    check(done.returncode == DONE, f"hotpress {arguments}: {done.stderr}")
    return done


def a_cycle():
    write("hot.toml", CASE)
    done = press("hot.toml", "-o", "hot")
    for word in ("press time to cure", "core at 100 C", "peak pressure", "peak gas", "blow risk", "densest", "s/mm"):
        check(word in done.stdout, f"{word} is printed")
    record = rows("hot/hotpress.csv")
    for name in ("time_s", "gap_mm", "pressure_MPa", "T_face_C", "T_core_C", "M_face", "M_core", "gas_core_kPa", "cure_core"):
        check(name in record[0], f"column {name}")
    last = record[-1]
    check(abs(float(last["time_s"]) - 180) < 1e-6 and float(last["pressure_MPa"]) == 0, "opened at the end")
    closed = [r for r in record if r["phase"] == "close"][-1]
    check(abs(float(closed["gap_mm"]) - 9) < 1e-6 and abs(float(closed["time_s"]) - 25) < 1e-6, "closed to 9 mm in 25 s")
    vented = [float(r["pressure_MPa"]) for r in record if r["phase"] == "vent"]
    check(all(a >= b for a, b in zip(vented, vented[1:])), "pressure falls while venting")
    hot = json.loads(pathlib.Path("hot/run.json").read_text(encoding="utf-8"))["hotpress"]
    check(abs(hot["thickness_closed_mm"] - 9) < 1e-6 and hot["thickness_opened_mm"] > 9, "thickness in run.json")
    check(abs(hot["dry_mass_kg_m2"] - 5.6) < 1e-9, "20 rows of .8 mm, 350 kg/m3")
    check(hot["gas_core_peak_kPa_K_times_3"] < hot["gas_core_peak_kPa"] < hot["gas_core_peak_kPa_K_over_3"], "band of gas")
    check(max(hot[f"balance_error_{what}"] for what in ("water", "air", "energy")) < 1e-9, "balances are closed")
    first = [float(r["time_s"]) for r in record if float(r["cure_core"]) >= 0.9][0]
    core = [r for r in hot["resins"] if r["layers"] == "core"][0]
    check(0 <= first - core["cured_s"] <= 2, "cure of the core in both files")
    profiles = rows("hot/transfer_profiles.csv")
    for state in ("closed", "held", "opened"):
        at = [r for r in profiles if r["state"] == state]
        check(len(at) == 20, f"one profile {state}")
        depths = [float(r["depth_mm"]) for r in at]
        check(depths == sorted(depths) and 0 < depths[0] < 1, "depths from the top face")
    resolved = strandlab("check", "hot/case.toml")
    check("[hotpress.softening]" in resolved.stdout, "the resolved case has the keys of the hot press")


def several_columns():
    """A panel of .3 m, its ends open: a file of the whole section, symmetric, less gas at the ends; one column later leaves none."""
    press("hot.toml", "-o", "wide", "--set", "hotpress.columns=5", "--set", "press.sides=free", "--set", "mat.length_mm=300")
    held = [r for r in rows("wide/transfer_section.csv") if r["state"] == "held"]
    check(len(held) == 5 * 20, "a line for each cell when held")
    middles = sorted({float(r["x_mm"]) for r in held})
    check([round(x, 9) for x in middles] == [30, 90, 150, 210, 270], f"middles of five columns of 60 mm: {middles}")
    core = [max(float(r["gas_kPa"]) for r in held if float(r["x_mm"]) == x) for x in middles]
    check(core[0] < core[1] < core[2] and abs(core[0] - core[4]) < 1e-3 * core[2], f"gas along the section {core}")
    profile = [float(r["gas_kPa"]) for r in rows("wide/transfer_profiles.csv") if r["state"] == "held"]
    check(max(profile) == core[2], "the profiles are those of the middle column")
    press("hot.toml", "-o", "wide", "--force")
    check(not pathlib.Path("wide/transfer_section.csv").exists(), "one column has no section")
    expect_bad_input(["hotpress", "hot.toml", "--set", "hotpress.columns=0"], ["hotpress.columns = 0: must be from 1 to 200"])


def results_are_kept():
    expect_bad_input(["hotpress", "hot.toml", "-o", "hot"], ["has results already; --force replaces them"])
    press("hot.toml", "-o", "hot", "--force")
    pathlib.Path("mine").mkdir()
    write("mine/case.toml", CASE)
    expect_bad_input(["hotpress", "mine/case.toml", "-o", "mine"], ["has results already"])
    pathlib.Path("cold").mkdir()
    write("cold/run.json", '{"strandlab": "0", "case": [], "steps": {}}')
    expect_bad_input(["hotpress", "hot.toml", "-o", "cold", "--force"], ["holds the panels of strandlab run"])
    pathlib.Path("deep").mkdir()
    write("deep/run.json", '{"hotpress": ' + "[" * 60000 + "]" * 60000 + "}")  # ended by a signal: a call for every level
    expect_bad_input(["hotpress", "hot.toml", "-o", "deep", "--force"], ["deep/run.json", "more than 100 deep"])
    write("file", "")
    expect_bad_input(["hotpress", "hot.toml", "-o", "file"], ["this is a file, not a folder"])


def a_case_without_hotpress():
    write("plain.toml", CASE[: CASE.index("[hotpress]")])
    done = press("plain.toml")
    check("no [hotpress]: the default cycle" in done.stderr, "the default cycle is named")
    hot = json.loads(pathlib.Path("runs/plain_hotpress/run.json").read_text(encoding="utf-8"))["hotpress"]
    check(abs(hot["density_mean_kg_m3"] - 640) < 0.01, "pressed to 640 kg/m3")
    check("[hotpress" not in strandlab("check", "plain.toml").stdout, "a case without [hotpress] is resolved without it")
    hill = press("plain.toml", "--set", "kinds.core.law=hill", "-o", "hill")
    check('kinds.core has law = "hill"' in hill.stderr, "Hill's law is warned of")


def a_cold_run_says_so():
    small = ["mat.length_mm=4", 'mat.rows=["surface*2"]', "press.compactions=[0, 0.02]", "grid.cells_through_strand=1",
             "kinds.core.law=hill", "kinds.surface.law=hill", "hotpress.mechanics=column"]
    done = strandlab("press", "hot.toml", "-o", "cold_run", *(part for s in small for part in ("--set", s)))
    check(done.returncode == DONE and "this pressing is cold" in done.stderr + done.stdout, f"cold: {done.stderr}{done.stdout}")


# Four rows of 4 mm, pressed strand by strand: what `strandlab run` makes of a case with [hotpress].
def a_hot_run():
    small = ["mat.length_mm=4", 'mat.rows=["surface", "core*2", "surface"]', "grid.cells_through_strand=2", "run.threads=1", "run.pictures=false",
             'hotpress.schedule=["close to 55 % in 4 s", "hold until 40 s", "vent 2 s", "open 2 s"]']
    settings = [part for s in small for part in ("--set", s)]
    done = strandlab("run", "hot.toml", "-o", "strands", *settings)
    check(done.returncode == DONE, f"run: {done.stderr}{done.stdout}")
    check("press time to cure" in done.stdout + done.stderr, "the answers are told")
    record = rows("strands/hotpress.csv")
    for name in ("time_s", "gap_mm", "pressure_MPa", "T_face_C", "T_core_C", "M_face", "M_core", "gas_core_kPa", "cure_core"):
        check(name in record[0], f"column {name}")
    closed = [r for r in record if r["phase"] == "close"][-1]
    check(abs(float(closed["gap_mm"]) - 0.45 * 3.2) < 1e-3 and abs(float(closed["time_s"]) - 4) < 1e-6, "closed to 55 % in 4 s")
    check(abs(float(record[-1]["time_s"]) - 44) < 1e-6 and float(record[-1]["gap_mm"]) > 0.45 * 3.2, "opened, thicker than closed")
    written = json.loads(pathlib.Path("strands/run.json").read_text(encoding="utf-8"))
    hot = written["hotpress"]
    check(hot["mechanics"] == "strands" and hot["core_100C_s"] is not None, "answers in run.json")
    check(hot["gas_core_peak_kPa_K_times_3"] < hot["gas_core_peak_kPa"] < hot["gas_core_peak_kPa_K_over_3"], "band of gas")
    press_csv = rows("strands/press.csv")
    check(float(press_csv[-1]["softening_mJ"]) > 0 and float(press_csv[-1]["damping_mJ"]) >= 0, "energies of the hot press")
    moduli = rows("strands/moduli.csv")
    check(len(moduli) > 0 and all(0 < float(m["modulus_MPa"]) < 12000 for m in moduli), "moduli of the panel as opened")
    check(len(list(pathlib.Path("strands/panels").glob("*.h5"))) == 1, "one panel is kept")
    vtu = next(pathlib.Path("strands/paraview").glob("*.vtu")).read_text(encoding="utf-8", errors="replace")
    for name in ("temperature_C", "moisture_content", "gas_pressure_kPa", "degree_of_cure", "bond_quality"):
        check(f'Name="{name}"' in vtu, f"{name} in ParaView's file")
    check("transfer_profiles.csv" in pathlib.Path("strands/report.html").read_text(encoding="utf-8"), "the page has the cycle")
    two = strandlab("press", "hot.toml", "-o", "two", *settings, "--set", "run.threads=2")
    check(two.returncode == DONE, f"two threads: {two.stderr}")
    check(pathlib.Path("two/hotpress.csv").read_bytes() == pathlib.Path("strands/hotpress.csv").read_bytes(), "same bits with two threads")
    other = strandlab("run", "hot.toml", "-o", "strands", *settings, "--set", "hotpress.moisture_face=0.1")
    check(other.returncode == BAD_INPUT, "another cycle is another case")
    expect_bad_input(["hotpress", "hot.toml", "-o", "strands"], ["holds the panels of strandlab run"])
    write("pressure.csv", "Time (s),Pressure (MPa)\n0,0\n10,3\n60,0\n")
    write("pressure.toml", CASE + '[hotpress.log]\nfile = "pressure.csv"\n')
    expect_bad_input(["run", "pressure.toml", "-o", "by_pressure"], ["pressure.csv", "without positions", 'hotpress.mechanics = "column"'])


def logs():
    write("plc.csv", "Time (s),Position (mm),Top (C)\n0,30,190\n10,16,190\n35,9,188\n150,9,187\n152,20,187\n")
    write("log.toml", CASE + '[hotpress.log]\nfile = "plc.csv"\n')
    press("log.toml", "-o", "log")
    record = rows("log/hotpress.csv")
    hot = json.loads(pathlib.Path("log/run.json").read_text(encoding="utf-8"))["hotpress"]
    check(abs(hot["log_first_contact_s"] - 10) < 1e-6, "first contact at 16 mm")
    check(abs(float(record[-1]["time_s"]) - 142) < 1e-6, "to the end of the log")
    check(abs(min(float(r["gap_mm"]) for r in record) - 9) < 1e-6, "closed to 9 mm")
    check(abs(hot["opening_s"] - 140) < 1e-6, "opens where the gap last is smallest")
    write("pressure.csv", "t [s];P [bar]\n0;0\n10;45\n60;45\n80;20\n150;20\n155;0\n")
    by_pressure = press("log.toml", "--set", "hotpress.log.file=pressure.csv", "--set", "hotpress.log.pressure=P", "-o", "log_p")
    check("peak pressure        4.50 MPa" in by_pressure.stdout, f"45 bar: {by_pressure.stdout}")
    write("back.csv", "time_s,gap_mm\n0,16\n10,9\n9,9\n")
    expect_bad_input(["hotpress", "log.toml", "--set", "hotpress.log.file=back.csv"], ["back.csv:4: time 9 s after 10 s"])
    write("wide.csv", "time_s,gap_mm\n0,30\n10,20\n")
    expect_bad_input(["hotpress", "log.toml", "--set", "hotpress.log.file=wide.csv"], ["smallest gap is 20 mm; this mat is 16 mm"])
    expect_bad_input(["hotpress", "log.toml", "--set", "hotpress.log.file=none.csv"], ["none.csv"])


def bad_schedules():
    def told(setting, *words):
        expect_bad_input(["hotpress", "hot.toml", "--set", setting, "-o", "bad"], words)

    told('hotpress.schedule=["close to 9 mm in 25 s", "hold until 20 s"]', "hotpress.schedule", "phases overlap")
    told('hotpress.schedule=["close to 17 mm in 25 s", "hold 9 s"]', "17 mm is never reached by closing: the mat is 16 mm")
    told('hotpress.schedule=["close to 3 mm in 25 s"]', "3 mm is never reached: the cell walls")
    told('hotpress.schedule=["hold 25 s"]', "a schedule begins with closing")
    told("hotpress.moisture_face=0.4", "hotpress.moisture_face = 0.4 kg/kg", "from 0 to 0.3")
    told("hotpress.platen_C=400", "hotpress.platen_C = 400 C", "from 20 to 300")
    told("hotpress.resin.face=glue", '"glue" is not one of pf, pmdi')
    told('hotpress.resin.face_kinds=["faces"]', "hotpress.resin.face_kinds", '"faces" is no kind of strand of this case', '"surface"')
    told("hotpress.platen_program=warm", "hotpress.platen_program", "must be pairs of numbers")
    told("hotpress.permeability.table=\"400 0\"", "hotpress.permeability.table", "must be greater than 0")
    told("hotpress.sof=1", "unknown key hotpress.sof")
    told("hotpress.softening.rr=1", "unknown key hotpress.softening.rr", "kappa_dry")
    write("resin.toml", CASE + '[hotpress.resin]\nface = "mine"\n[resins.mine]\nE_kJ_mol = 80\n')
    expect_bad_input(["hotpress", "resin.toml", "-o", "bad"], ['resin "mine" has no constants: [resins.mine] must give E_kJ_mol and A_1_s'])
    press("resin.toml", "--set", "resins.mine.A_1_s=2e9", "-o", "own_resin")
    write("pf.toml", CASE + "[resins.pf]\nE_kJ_mol = 80\n")
    expect_bad_input(["hotpress", "pf.toml"], ["a built-in resin has this name"])


def warnings():
    def warned(words, *settings):
        done = press("hot.toml", "--force", "-o", "warned", *(part for s in settings for part in ("--set", s)))
        check(words in done.stderr, f"{words} in: {done.stderr}")

    warned("platens of 230 C: above 220 C", "hotpress.platen_C=230")
    warned("above 0.25 sorption is extrapolated", "hotpress.moisture_face=0.26")
    warned("never reached its target", 'hotpress.schedule=["close at 2 MPa to 9 mm within 20 s", "hold 30 s", "open 5 s"]')
    warned("is cured to", 'hotpress.schedule=["close to 9 mm in 25 s", "hold 10 s", "open 5 s"]')
    warned("precure: pf has gelled in", 'hotpress.schedule=["close to 9 mm in 90 s", "hold 60 s"]')
    warned("gas pressure of", "hotpress.permeability.K400_m2=5e-14")


with scratch():
    for test in (a_cycle, several_columns, results_are_kept, a_case_without_hotpress, a_cold_run_says_so, logs, bad_schedules, warnings):
        test()
finish()
