"""strandlab bondline and theory as a user meets them: tables, records, plots, and what bad input is told."""

import csv
import json
import os
import pathlib

from program import SOURCE, DONE, check, expect_bad_input, finish, scratch, strandlab

DATA = SOURCE / "tests" / "data" / "bondline"
# Le (2010) Table 2.1: mean and half 95 % interval of 1/D_t, mm/MPa.
PUBLISHED = {"PF-1": (.01628, .01406), "PF-25": (.01048, .00995), "PF-100": (-.00022, .00042), "VTC-PF-1": (.01177, .00640),
             "VTC-PF-25": (.00210, .00343), "VTC-PF-100": (-.00017, .00032), "PVA-1": (.14645, .05617),
             "PVA-25": (.06536, .01832), "PVA-100": (.03693, .01963)}


def rows(file):
    with open(file, encoding="utf-8") as text:
        return list(csv.DictReader(text))


def example():
    made = strandlab("bondline", "--example")
    check(made.returncode == DONE, "bondline --example")
    pathlib.Path("dls.csv").write_text(made.stdout, encoding="utf-8")
    result = strandlab("bondline", "dls.csv", "-o", "out")
    check(result.returncode == DONE, f"bondline: {result.stderr}")
    groups = {row["group"]: row for row in rows("out/groups.csv")}
    for name, (mean, half) in PUBLISHED.items():
        check(abs(float(groups[name]["compliance_t_mm_per_MPa"]) - mean) < half / 2.1, f"mean of {name}")
    specimens = rows("out/specimens.csv")
    check(len(specimens) == 174, "all specimens are listed")
    check(list(specimens[0])[:2] == ["id", "compliance_t_mm_per_MPa"], "columns of specimens.csv")
    check(specimens[0]["resin"] == "PF", "further columns are kept")
    check(json.loads(pathlib.Path("out/dls.json").read_text(encoding="utf-8"))["groups"][0]["n"] == 22, "JSON")
    check(pathlib.Path("out/means.png").read_bytes()[:4] == b"\x89PNG", "means.png")
    check(pathlib.Path("out/mapping_PF-25.png").exists(), "mapping of a group")
    expect_bad_input(["bondline", "dls.csv", "-o", "out"], ["out", "--force"])
    check(strandlab("bondline", "dls.csv", "-o", "out", "--force").returncode == DONE, "--force")


def panel_case():
    pathlib.Path("panel.toml").write_text('[glue]\nfrom_bondline = "out/dls.json"\ngroup = "PF-25"\n', encoding="utf-8")
    result = strandlab("check", "panel.toml")
    check(result.returncode == DONE and "compliance_t_mm_per_MPa = [0.0104" in result.stdout, "a case names a result")


def spreadsheet():
    result = strandlab("bondline", DATA / "spreadsheet.csv", "-o", "sheet")
    check(result.returncode == DONE, f"spreadsheet: {result.stderr}")
    check("excluded: S9" in result.stdout and "rigid-bond limit" in result.stdout, "an excluded specimen is shown")
    groups = {row["group"]: row for row in rows("sheet/groups.csv")}
    # The file was made with 1/D_t = .010 .015 .022 .030 and .002 .003 .006 .008, k to .1 N/mm.
    check(abs(float(groups["low"]["compliance_t_mm_per_MPa"]) - .01925) < 5e-5, "mean of low")
    check(abs(float(groups["high"]["compliance_t_mm_per_MPa"]) - .00475) < 5e-5, "mean of high")
    check(groups["high"]["excluded"] == "1", "excluded specimens are counted")


def percent():
    """gnuplot takes the labels of ticks for formats: a group may still be called "PF 25 %"."""
    made = strandlab("bondline", "--example").stdout.replace("PF-25,", "PF 25 %,")
    pathlib.Path("percent.csv").write_text(made, encoding="utf-8")
    result = strandlab("bondline", "percent.csv", "-o", "percent")
    check(result.returncode == DONE and not result.stderr, f"groups with a per cent sign: {result.stderr}")
    check(pathlib.Path("percent/means.png").exists(), "means.png of groups with a per cent sign")


def records():
    result = strandlab("bondline", DATA / "records.csv", "--records", DATA / "records", "-o", "slopes")
    check(result.returncode == DONE, f"records: {result.stderr}")
    check("flag: r2: toe" in result.stdout and "flag: r3: slip" in result.stdout, "toe and slip are flagged")
    check("excluded: r4" in result.stdout, "a record that ends early is excluded")
    specimens = {row["id"]: row for row in rows("slopes/specimens.csv")}
    # Made with 1/D_t = .0105 and .0163 and displacement noise of .0002 mm.
    check(abs(float(specimens["r1"]["compliance_t_mm_per_MPa"]) - .0105) < 1e-3, "r1")
    check(abs(float(specimens["r5"]["compliance_t_mm_per_MPa"]) - .0163) < 1e-3, "r5")
    check(float(specimens["r1"]["r_squared"]) > .99, "R squared")
    window = strandlab("bondline", DATA / "records.csv", "--records", DATA / "records", "--window-N", "50,300", "-o", "newton")
    check(window.returncode == DONE and rows("newton/specimens.csv")[0]["window_high_N"] == "300", "window in N")


def options():
    both = strandlab("bondline", "dls.csv", "--formula", "le2010", "--within", "resin,strands", "--group-by",
                     "coverage_percent", "-o", "printed")
    check(both.returncode == DONE and both.stdout.count("one-way ANOVA") == 3, "groups are compared within")
    coth = rows("out/specimens.csv")[0]["compliance_t_mm_per_MPa"]
    printed = rows("printed/specimens.csv")[0]["compliance_t_mm_per_MPa"]
    check(0 < float(printed) / float(coth) - 1 < .02, "the printed formula is about 1 % off")
    without = dict(os.environ, PATH="/nonexistent")
    plain = strandlab("bondline", "dls.csv", "-o", "plain", env=without)
    check(plain.returncode == DONE and "gnuplot" in plain.stderr, "without gnuplot it says so and goes on")
    check(pathlib.Path("plain/groups.csv").exists(), "and writes its tables")
    design = strandlab("bondline", "--design", "--compliance-t", "0.01048,0.06536", "--L1-mm", "5", "--L2-mm", "5")
    check(design.returncode == DONE and "0.06536" in design.stdout, "--design")


def bad_input():
    expect_bad_input(["bondline"], ["table of specimens", "--design"])
    expect_bad_input(["bondline", "none.csv"], ["none.csv", "cannot be read"])
    pathlib.Path("short.csv").write_text("id,group,k_N_per_mm\na,g,1900\n", encoding="utf-8")
    expect_bad_input(["bondline", "short.csv"], ["short.csv:1", "missing column E1_MPa", "L2_mm"])
    expect_bad_input(["bondline", "dls.csv", "-o", "x", "--formula", "tanh"], ["tanh", "coth", "le2010"])
    expect_bad_input(["bondline", "dls.csv", "-o", "x", "--group-by", "species"], ["species", "coverage_percent"])
    expect_bad_input(["bondline", DATA / "records.csv", "-o", "x"], ["missing column k_N_per_mm"])
    expect_bad_input(["bondline", DATA / "records.csv", "--records", DATA, "-o", "x"], ["r1.csv", "cannot be read"])
    expect_bad_input(["bondline", DATA / "records.csv", "--records", DATA / "records", "--window-percent", "40,10", "-o", "x"],
                     ["40 to 10 %"])
    expect_bad_input(["bondline", "dls.csv", "--u-k", "-1", "-o", "x"], ["--u-k"])
    expect_bad_input(["bondline", "dls.csv", "-o", "dls.csv"], ["cannot make the folder dls.csv", "-o"])
    pathlib.Path("loop").symlink_to("loop")
    expect_bad_input(["bondline", "dls.csv", "-o", "loop"], ["cannot make the folder loop"])
    expect_bad_input(["bondline", "dls.csv", "-o", "x" * 5000], ["cannot make the folder", "too long"])
    expect_bad_input(["bondline", "--design", "--compliance-t", "0"], ["above zero"])
    expect_bad_input(["bondline", "--design", "--t1-mm", "0"], ["t1_mm = 0 must be positive"])
    lines = pathlib.Path("dls.csv").read_text(encoding="utf-8").splitlines(keepends=True)
    lines[3] = lines[3].replace(",", ",\"", 1)  # takes the 171 specimens behind it into one cell
    pathlib.Path("quote.csv").write_text("".join(lines), encoding="utf-8")
    expect_bad_input(["bondline", "quote.csv", "-o", "x"], ["quote.csv:4", "quote", "not closed to the end of the file"])
    check(not pathlib.Path("x").exists(), "bad input leaves nothing behind")


def theory():
    result = strandlab("theory", "--compaction", "0", "--csv", "-")
    check(result.returncode == DONE, f"theory: {result.stderr}")
    estimates = {row["model"]: row for row in csv.DictReader(result.stdout.splitlines())}
    check(round(float(estimates["tension"]["modulus_MPa"])) == 4669, "tension of the default OSB")
    shown = strandlab("theory", "--compaction", "0,0.4", "--compliance-t", "0,0.01", "--strand-length-mm", "50,150",
                      "--gap-mm", "5,15", "--density-kg-m3", "500", "--csv", "theory.csv")
    check("4022" in shown.stdout and "2483" in shown.stdout, "random cores")
    check("shear_lag: shear-lag strands" in shown.stdout, "each model says what it assumes")
    check(sum(row["model"] == "shear_lag" for row in rows("theory.csv")) == 16, "lists are combined")
    made = strandlab("init", "lvl")
    pathlib.Path("lvl.toml").write_text(made.stdout, encoding="utf-8")
    # Of a case as its virtual tests hold the rows: E_L in plane strain; free bars on demand.
    check(" 10003\n" in strandlab("theory", "lvl.toml", "--compaction", "0").stdout, "tension of LVL in plane strain")
    for free in (("--offaxis", "uncoupled"), ("--set", "mat.offaxis=uncoupled")):
        check(" 9936\n" in strandlab("theory", "lvl.toml", "--compaction", "0", *free).stdout, f"{free}: tension of LVL is E_L")
    pathlib.Path("mat.json").write_text(json.dumps({"length_mm": 100, "layer_thickness_mm": 0.8, "layers": [{"role": "surface", "strands": [
        {"x0": 0, "x1": 50}, {"x0": 50, "x1": 100, "angle_deg": 90, "material": "vtc"}]}]}), encoding="utf-8")
    pathlib.Path("file.toml").write_text('[mat]\nfile = "mat.json"\n', encoding="utf-8")
    row = next(csv.DictReader(strandlab("theory", "file.toml", "--compaction", "0", "--offaxis", "uncoupled", "--csv", "-").stdout.splitlines()))
    check([row["model"], row["density_kg_m3"], row["modulus_MPa"]] == ["tension", "630", "5470.5"],
          f"strands of a mat file count with their own wood and angle: {row}")
    expect_bad_input(["theory", "--compaction", "1"], ["compaction 1"])
    expect_bad_input(["theory", "--strand-length-mm", "0"], ["strand length 0 mm"])
    expect_bad_input(["theory", "--density-kg-m3", "10"], ["density 10"])
    expect_bad_input(["theory", "--offaxis", "free"], ["free", "exact, uncoupled"])
    expect_bad_input(["theory", "none.toml"], ["none.toml"])


with scratch():
    example()
    panel_case()
    spreadsheet()
    records()
    percent()
    options()
    bad_input()
    theory()
finish()
