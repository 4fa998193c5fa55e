"""Every ready case as it stands in cases/: check, and a short coarse run from the mat to the moduli."""

import csv
import json
import pathlib

from program import DONE, SOURCE, check, finish, scratch, strandlab

PLATE = "osb3d"
NAMES = sorted(p.stem for p in (SOURCE / "cases").glob("*.toml") if p.stem != PLATE)

# 60 mm, so that no gap swallows a row; one cell through a strand.
COARSE = ("mat.length_mm=60", "grid.cells_through_strand=1", "grid.cell_aspect=4", "press.compactions=[0, .1]",
          "glue.compliance_t_mm_per_MPa=[0.0105]", "test.elements_through_strand=1", "test.kinds=[tension]", "run.pictures=false")


# A whole press cycle costs more: half the length, four times the speed.
QUICK = {"hot_osb": ("mat.length_mm=30", "press.speed_m_s=64")}


def settings(*changes):
    return [part for change in changes for part in ("--set", change)]


def make(name):
    made = strandlab("init", name)
    check(made.returncode == DONE, f"init {name}: {made.stderr}")
    check((SOURCE / "cases" / f"{name}.toml").read_text(encoding="utf-8") == made.stdout, f"cases/{name}.toml is init {name}")
    pathlib.Path(f"{name}.toml").write_text(made.stdout, encoding="utf-8")
    shown = strandlab("check", f"{name}.toml")
    check(shown.returncode == DONE, f"check {name}: {shown.stderr}")
    check("# weight: " in shown.stdout, f"check {name} says what the mat weighs")


def ready_case(name):
    make(name)
    run = strandlab("run", f"{name}.toml", *settings(*COARSE, *QUICK.get(name, ())))
    check(run.returncode == DONE, f"run {name}: {run.stderr}")
    record = json.loads(pathlib.Path("runs", name, "run.json").read_text(encoding="utf-8"))
    for key in ("weight_fraction_by_kind", "weight_fraction_by_material"):
        check(abs(sum(record["mat"][key].values()) - 1) < 1e-12, f"run.json of {name}: {key} sums to 1")
    check(("vtc" in record["mat"]["weight_fraction_by_material"]) == ("vtc" in name), f"{name} has VTC strands or not")
    with open(f"runs/{name}/moduli.csv", encoding="utf-8") as stream:
        moduli = [float(m["modulus_MPa"]) for m in csv.DictReader(stream)]
    # Between a core without surfaces and a panel of VTC strands along it.
    kept = 1 if name == "hot_osb" else 2  # the hot press keeps the panel as it opened
    check(len(moduli) == kept and all(400 < m < 30000 for m in moduli), f"moduli of {name}: {moduli}")
    return moduli


def ready_cases():
    make(PLATE)  # tests/cli/plate.py presses such a mat
    moduli = {name: ready_case(name) for name in NAMES}
    # Densified surfaces stiffen a panel of the same mat (same seed and lengths).
    check(moduli["osb_vtc50"][0] > 1.5 * moduli["osb"][0], f"osb_vtc50 {moduli['osb_vtc50']} against osb {moduli['osb']}")


def thick_soft_strands_of_a_species():
    """Rows of their own thickness, random angles, a material from E_L alone, softened in the press: in every file of the run."""
    pathlib.Path("own.toml").write_text("""[mat]
length_mm = 30
rows = ["surface", "core*2", "surface"]
[kinds.surface]
material = "fir"
thickness_mm = 1.2
length_mm = 0
length_sd_mm = 0
gap_mm = 0
gap_sd_mm = 0
yield_factor = 0.5
stiffness_factor = 0.5
[kinds.core]
angle_deg = 0
angle_spread_deg = 90
[materials.fir]
species = "douglas-fir"
E_L_MPa = 13000
density_kg_m3 = 500
[press]
compactions = [0, 0.1]
""", encoding="utf-8")
    coarse = settings(*COARSE[1:])
    told = "material fir: E_R, E_T, G_RL, G_TL, G_RT, nu_RL, nu_TL, nu_TR follow from E_L = 13000 MPa"
    check(told in strandlab("check", "own.toml").stdout, "check says which constants follow from the species")
    run = strandlab("run", "own.toml", *coarse)
    check(run.returncode == DONE, f"run: {run.stderr}")
    check(told in run.stdout, "run says which constants follow from the species")
    check(told in pathlib.Path("runs/own/log.txt").read_text(encoding="utf-8"), "the log does too")
    record = json.loads(pathlib.Path("runs/own/run.json").read_text(encoding="utf-8"))
    check(any(told in line for line in record["derived_constants"]), "run.json does too")
    mat = json.loads(pathlib.Path("runs/own/mat.json").read_text(encoding="utf-8"))
    check([layer.get("thickness_mm") for layer in mat["layers"]] == [1.2, None, None, 1.2], "mat.json has the thicknesses")
    core = [strand for layer in mat["layers"][1:3] for strand in layer["strands"]]
    check(all(-90 <= strand["angle_deg"] <= 90 for strand in core), "mat.json has the angles")
    # Weight: length x thickness x density over all strands.
    surface = 2 * 30 * 1.2 * 500
    whole = surface + sum((s["x1"] - s["x0"]) * 0.8 * 350 for s in core)
    share = record["mat"]["weight_fraction_by_material"]["fir"]
    check(abs(share - surface / whole) < 1e-12, f"weight fraction {share}, expected {surface / whole}")
    check(f"fir {100 * share:.1f} %" in run.stdout, "run says the weight fraction")
    # Pressed again from its own mat file: the same bits.
    again = strandlab("run", "own.toml", "-o", "again", *coarse, "--set", "mat.file=runs/own/mat.json")
    check(again.returncode == DONE, f"run from the mat file: {again.stderr}")
    for name in ("press.csv", "moduli.csv"):
        check(pathlib.Path("again", name).read_bytes() == pathlib.Path("runs/own", name).read_bytes(), f"{name} of the mat file")


for test in (ready_cases, thick_soft_strands_of_a_species):
    with scratch():
        test()
finish()
