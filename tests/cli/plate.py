"""A mat file in 3D, or mat.width_mm, makes the case a plate: formed, pressed and tested; moduli.csv and abd.csv."""

import csv
import json
import pathlib

from program import BAD_INPUT, DONE, check, expect_bad_input, finish, scratch, strandlab

# Three layers of short strands on a torus of 12 mm.
LAYERS = [[(4, 3, 10, 4, 0), (7, 9, 10, 6, 0)], [(2, 5, 10, 4, 90), (8, 9, 10, 6, 90)], [(1, 2, 10, 4, 0), (6, 6, 10, 4, 0), (9, 10, 10, 2, 0)]]
PLATE = ["plate_E_x", "plate_E_y", "plate_G_xy", "plate_Eb_x", "plate_Eb_y", "plate_Gb_xy", "plates_G_xz", "plates_G_yz", "plates_E_z"]
CUT = ["tension_x", "bending_x", "tension_y", "bending_y", "shear_xy_given"]
SETTINGS = ["--set", "press.compactions=[0]", "--set", "test.element_length_mm=2", "--set", "test.elements_through_strand=2",
            "--set", "glue.compliance_t_mm_per_MPa=[0,0.05]"]


def write_mat(name, layers, sides="periodic"):
    strands = [[dict(zip(("cx", "cy", "length", "width", "angle_deg"), strand)) for strand in layer] for layer in layers]
    pathlib.Path(name).write_text(json.dumps({"dim": 3, "length_mm": 12, "width_mm": 12, "layer_thickness_mm": 0.8, "sides": sides,
                                              "layers": [{"role": "surface", "strands": layer} for layer in strands]}))


def rows(file):
    with open(file, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def inverse(matrix):
    """Gauss-Jordan."""
    size = len(matrix)
    work = [list(row) + [float(i == j) for j in range(size)] for i, row in enumerate(matrix)]
    for i in range(size):
        pivot = max(range(i, size), key=lambda k: abs(work[k][i]))
        work[i], work[pivot] = work[pivot], work[i]
        work[i] = [value / work[i][i] for value in work[i]]
        for k in range(size):
            if k != i:
                work[k] = [a - work[k][i] * b for a, b in zip(work[k], work[i])]
    return [row[size:] for row in work]


def periodic():
    write_mat("mat.json", LAYERS)
    ran = strandlab("run", "osb.toml", "--set", "mat.file=mat.json", *SETTINGS, "-o", "torus")
    check(ran.returncode == DONE, f"run of a plate: {ran.stderr}")
    check("unknowns, about" in ran.stdout, "a run of a plate says first what it takes")
    moduli = rows("torus/moduli.csv")
    check([row["test"] for row in moduli] == 2 * PLATE, "tests of a periodic plate")
    check([float(row["compliance_t_mm_per_MPa"]) for row in moduli] == [0] * 9 + [0.05] * 9, "a line for each compliance and test")
    for row in moduli:
        check(abs(float(row["reaction_modulus_MPa"]) / float(row["modulus_MPa"]) - 1) < 1e-6, f"two ways to {row['test']}")
    wood = 350 * sum(length * width for layer in LAYERS for _, _, length, width, _ in layer) / (12 * 12 * len(LAYERS))
    check(abs(float(moduli[0]["density_kg_m3"]) / wood - 1) < 1e-9, "density with the voids")

    stiffness = rows("torus/abd.csv")
    check(len(stiffness) == 2 and len(stiffness[0]) == 2 + 36, "abd.csv: a line for each compliance, 36 numbers")
    for line, modulus in zip(stiffness, (moduli[0], moduli[9])):
        abd = [[float(line[f"ABD_{i}{j}"]) for j in range(1, 7)] for i in range(1, 7)]
        check(abs(1 / (2.4 * inverse(abd)[0][0]) / float(modulus["modulus_MPa"]) - 1) < 1e-9, "E_x follows from abd.csv")

    again = strandlab("run", "osb.toml", "--set", "mat.file=mat.json", *SETTINGS, "-o", "torus")
    check(again.returncode == DONE and "this run is finished" in again.stdout, "a finished plate is not tested again")
    pathlib.Path("torus/abd.csv").unlink()
    strandlab("test", "osb.toml", "--set", "mat.file=mat.json", *SETTINGS, "-o", "torus")
    check(rows("torus/abd.csv") == stiffness, "strandlab test makes a lost table again, the same")


def cut():
    write_mat("cut.json", [[(6, 3, 12, 6, 0), (6, 9, 12, 6, 0)], [(3, 6, 12, 6, 90), (9, 6, 12, 6, 90)]], "cut")
    ran = strandlab("run", "osb.toml", "--set", "mat.file=cut.json", *SETTINGS, "-o", "cut")
    check(ran.returncode == DONE, f"run of a cut plate: {ran.stderr}")
    check([row["test"] for row in rows("cut/moduli.csv")] == 2 * CUT, "tests of a cut plate")
    check(not pathlib.Path("cut/abd.csv").exists(), "no plate stiffness of a cut plate")


FORMED = """
[mat]
length_mm = 30
width_mm = 30
rows = ["surface", "core", "surface"]
[kinds.surface]
length_mm = 20
width_mm = 6
[kinds.core]
length_mm = 20
width_mm = 6
"""


def formed():
    pathlib.Path("formed.toml").write_text(FORMED, encoding="utf-8")
    made = strandlab("form", "formed.toml", "-o", "formed_mat")
    check(made.returncode == DONE and "coverage" in made.stdout, f"form: {made.stderr}")
    check(len(list(pathlib.Path("formed_mat/pictures").iterdir())) == 3, "a picture of each layer")
    coverage = [float(row["coverage"]) for row in rows("formed_mat/layers.csv")]
    check(all(0.3 < value < 0.7 for value in coverage), f"layers of strands that do not overlap cover about a half: {coverage}")
    check(strandlab("run", "formed.toml", *SETTINGS, "-o", "formed").returncode == DONE, "a formed mat is tested")
    check(pathlib.Path("formed/mat.json").read_bytes() == pathlib.Path("formed_mat/mat.json").read_bytes(), "run tests the mat that form makes")


def what_its_tests_cannot_use():
    """Is said before the press closes."""
    for setting, words in (("glue.spot_mm=2", ["glue.spot_mm", "laid on sections only"]), ("glue.compliance_t_mm_per_MPa=[]", ["compliance"])):
        expect_bad_input(["run", "formed.toml", "--set", "press.compactions=[0.3]", "--set", setting, "-o", "refused"], words)
        check(not pathlib.Path("refused/press.csv").exists(), f"{setting}: refused before it is pressed")


PRESSING = ["--set", "grid.cells_through_strand=2", "--set", "grid.cell_aspect=6", "--set", "test.element_length_mm=2", "--set", "glue.compliance_t_mm_per_MPa=[0.0105]", "--set", "run.threads=2"]
HILL = [word for kind in ("surface", "core") for word in ("--set", f"kinds.{kind}.law=hill")]


def pressed():
    settings = [*PRESSING, *HILL, "--set", "press.compactions=[0.3,0.5]"]
    told = strandlab("check", "formed.toml", *settings)
    check(told.returncode == DONE and "particles:" in told.stdout and "unknowns" in told.stdout, f"check of a plate: {told.stderr}")
    ran = strandlab("run", "formed.toml", *settings, "-o", "pressed")
    check(ran.returncode == DONE, f"run of a plate that is pressed: {ran.stderr}")
    steps = json.loads(pathlib.Path("pressed/run.json").read_text(encoding="utf-8"))["steps"]
    check(2 <= steps["press"]["most_fields"] < 24, "run.json says how many fields met at a node")
    moduli = rows("pressed/moduli.csv")
    check([float(row["compaction"]) for row in moduli] == [0.3] * 9 + [0.5] * 9, "tests at each compaction")
    density = [float(row["density_kg_m3"]) for row in moduli]
    check(abs(density[9] / density[0] - 0.7 / 0.5) < 1e-9, "density follows compaction")
    check([float(row["compaction"]) for row in rows("pressed/abd.csv")] == [0.3, 0.5], "abd.csv: a line for each compaction")
    stress = [float(row["stress_MPa"]) for row in rows("pressed/press.csv")]
    check(stress[-1] > 1 and abs(stress[0]) < 0.1, f"press.csv: the platens feel the mat: {stress[-1]} MPa")
    for name in ("panels/panel_0.3.h5", "panels/panel_0.5.h5", "paraview/panel_0.5.vtu", "paraview/panel.pvd"):
        check(pathlib.Path("pressed", name).exists(), name)
    pathlib.Path("pressed/moduli.csv").unlink()
    again = strandlab("run", "formed.toml", *settings, "-o", "pressed")
    check(again.returncode == DONE and "press:" not in again.stdout, "a finished pressing is not repeated")
    check(rows("pressed/moduli.csv") == moduli, "its tests give the same again")
    for name, half in (("mirrored", "mirror"), ("half", "keep")):
        ran = strandlab("run", "formed.toml", *PRESSING, *HILL, "--set", "press.compactions=[0.5]", "--set", f"press.half={half}", "-o", name)
        check(ran.returncode == DONE, f"press.half = {half}: {ran.stderr}")
    abd = {name: rows(f"{name}/abd.csv")[0] for name in ("mirrored", "half")}
    check(float(abd["mirrored"]["ABD_11"]) > 1.5 * float(abd["half"]["ABD_11"]), "half a panel and its mirror image carry more than the half")
    coupling = abs(float(abd["mirrored"]["ABD_14"])) / (float(abd["mirrored"]["ABD_11"]) * float(abd["mirrored"]["ABD_44"])) ** 0.5
    check(coupling < 0.01, f"a panel that is its own mirror image does not bend when it is pulled: {coupling}")


def refused():
    hot = ["--set", "hotpress.mechanics=strands"]
    expect_bad_input(["run", "osb.toml", "--set", "mat.file=mat.json", *hot], ["plates are pressed cold"])
    expect_bad_input(["run", "formed.toml", "--set", "mat.forming=draped"], ["layers only: this one is draped"])
    expect_bad_input(["hotpress", "osb.toml", "--set", "mat.file=mat.json"], ["mat.json", "a mat in 3D"])
    write_mat("strips.json", [[(3, 6, 8, 4, 0)], [(9, 6, 8, 4, 0)]])
    strips = strandlab("run", "osb.toml", "--set", "mat.file=strips.json", *SETTINGS, "-o", "strips")
    check(strips.returncode == BAD_INPUT and "not connected across y" in strips.stderr, f"strips are no plate: {strips.stderr}")


with scratch():
    pathlib.Path("osb.toml").write_text(strandlab("init", "osb").stdout, encoding="utf-8")
    periodic()
    cut()
    formed()
    what_its_tests_cannot_use()
    pressed()
    refused()
finish()
