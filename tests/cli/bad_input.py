"""Each kind of bad input: one clear message, exit code 2, nothing written."""

import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time

from program import PROGRAM, NO_PICTURES, SMALL_CASE, SOURCE, DONE, check, expect_bad_input, files, finish, scratch, strandlab

MAT = {"length_mm": 10, "layer_thickness_mm": 0.8, "layers": [{"role": "surface", "strands": [{"x0": 0, "x1": 4}, {"x0": 5, "x1": 10}]}]}


def usage():
    expect_bad_input([], ["subcommand is required"])
    expect_bad_input(["chek", "osb.toml"], ["unknown command \"chek\"", "did you mean \"check\"?"])
    expect_bad_input(["check"], ["CASE is required"])
    expect_bad_input(["check", "osb.toml", "--frce"], ["--frce"])
    expect_bad_input(["check", "osb.toml", "--set", "press.compactions=[0,", "0.4]"], ["A list needs quotes, or no spaces: --set 'press.compactions=[0, ...]'"])
    expect_bad_input(["check", "osb.toml", "other.toml"], ["other.toml"])
    expect_bad_input(["init", "obs"], ["no ready case \"obs\"", "did you mean \"osb\"?"])
    expect_bad_input(["check", "none.toml"], ["none.toml: no such case file"])
    expect_bad_input(["check", ""], ["no case file is given"])
    for given in (["chek\x1b[31m"], ["check", "osb.toml", "--fr\x1b[31mce"], ["check", "no\x1b[31m\n.toml"],
                  ["check", "osb.toml", "--set", "press.sides=\x1b[31m"], ["check", "osb.toml", "--set", "x" * 100000]):
        message = expect_bad_input(given, ["\\x1b[31m"] if "x" * 100 not in given[-1] else ["100000"]).stderr
        check("\x1b" not in message and len(message) < 1000, f"{given[-1][:40]!r}: the terminal would obey: {message!r}")
    expect_bad_input(["run", SOURCE / "cases" / "osb.toml"], ["STRANDLAB_ISA is \"sse9\"", "this machine has", "generic"],
                     env=os.environ | {"STRANDLAB_ISA": "sse9"})
    check(strandlab("--version").stdout.startswith("strandlab "), "--version")
    check(strandlab("--help").returncode == DONE, "--help exits with 0")


CASES = [
    ("[press]\nsped_m_s = 3", [":2:", "unknown key press.sped_m_s", "did you mean speed_m_s?", "compactions"]),
    ("[pres]\nspeed_m_s = 3", [":1:", "unknown section [pres]", "did you mean press?"]),
    ("[press]\nspeed_m_s = \"fast\"", [":2:", "press.speed_m_s = \"fast\"", "must be a number"]),
    ("[mat]\nlayer_thickness_mm = 0", [":2:", "mat.layer_thickness_mm = 0 mm", "from 0.001 to"]),
    ("[materials.m]\ndensity_kg_m3 = -350", [":2:", "materials.m.density_kg_m3 = -350", "greater than 0"]),
    ("[materials.m]\nE_L_MPa = 0", [":2:", "materials.m.E_L_MPa = 0 MPa", "greater than 0"]),
    ("[kinds.core]\nlength_sd_mm = 26", [":2:", "kinds.core.length_sd_mm = 26", "length_mm = 25"]),
    ("[press]\ncompactions = [0, 1.0]", [":2:", "press.compactions", "less than 1"]),
    ("[press]\ncompactions = [0.3, 0.2]", [":2:", "press.compactions", "increasing"]),
    ("[materials.m]\nnu_TR = 0.7", ["[materials.m]", "not positive definite", "nu_TR"]),
    ("[materials.m]\nY_T_MPa = 4", ["[materials.m]", "not positive semi-definite", "Y_T"]),
    ("[press\n", [":1:", "not valid TOML"]),
]


def case_files():
    for text, parts in CASES:
        pathlib.Path("panel.toml").write_text(text, encoding="utf-8")
        for command in ("check", "run"):
            expect_bad_input([command, "panel.toml"], ["panel.toml"] + parts)


def overrides():
    pathlib.Path("panel.toml").write_text("", encoding="utf-8")
    expect_bad_input(["mat", "panel.toml", "--set", "press"], ["--set press", "key.path=value"])
    expect_bad_input(["mat", "panel.toml", "--set", "press.compactions=[0"], ["--set press.compactions=[0", "key.path=value"])
    expect_bad_input(["mat", "panel.toml", "--set", "pres.speed_m_s=3"], ["did you mean press?"])
    expect_bad_input(["mat", "panel.toml", "--set", "press.speed_m_s=-3"], ["press.speed_m_s = -3 m/s"])
    expect_bad_input(["mat", "panel.toml", "--set", "test.kinds=[bending_3_point]", "--set", "press.compactions=[0.25]"],
                     ["span of 20 thicknesses", "264 mm", "0.25", "mat.length_mm"])
    expect_bad_input(["mat", "panel.toml", "--set", "glue.coverage=0"], ["glue.coverage = 0", "greater than 0"])
    expect_bad_input(["mat", "panel.toml", "--set", "glue.coverage_classes=[0.1,0.5,1]", "--set", "glue.coverage_compliances_mm_per_MPa=[0.01,0.02,0]"],
                     ["glue.coverage", "1/D_t = [0.01, 0.02, 0]", "not increasing"])
    expect_bad_input(["mat", "panel.toml", "--set", "mat.length_mm=1e9"], ["mat.length_mm", "to 100000"])
    expect_bad_input(["mat", "panel.toml", "--set", "mat.length_mm=1e5", "--set", "grid.cells_through_strand=32",
                      "--set", "grid.cell_aspect=0.25"], ["particles", "MB of memory", "mat.length_mm"])


def changed(**layer):
    mat = json.loads(json.dumps(MAT))
    mat["layers"][0].update(layer)
    return json.dumps(mat)


MATS = [
    (changed(strands=[{"x0": 0, "x1": 6}, {"x0": 5, "x1": 10}]), ["layer 1", "overlap"]),
    (changed(strands=[{"x0": 4, "x1": 4}]), ["layer 1", "x1"]),
    (changed(role="surfac"), ["surfac", "surface"]),
    (changed(strands=[{"x0": 0, "x1": float("nan")}]), ["mat.json"]),
    (changed(strands=[{"x0": 0, "x1": 1e999}]), ["mat.json"]),
    ("{\"length_mm\": 10", ["mat.json"]),
    ("", ["mat.json"]),
]


def mat_files():
    pathlib.Path("panel.toml").write_text("[mat]\nfile = \"mat.json\"\n", encoding="utf-8")
    expect_bad_input(["run", "panel.toml"], ["mat.json"])
    for text, parts in MATS:
        pathlib.Path("mat.json").write_text(text, encoding="utf-8")
        for command in ("check", "mat"):
            expect_bad_input([command, "panel.toml"], ["mat.json"] + parts)


def tests_no_mat_can_take():
    """What the tests would refuse is refused before a mat is pressed for them."""
    pathlib.Path("panel.toml").write_text("[mat]\nlength_mm = 5\nrows = [\"surface\"]\n", encoding="utf-8")
    for command in ("check", "press", "run"):
        expect_bad_input([command, "panel.toml", "--set", "test.kinds=[bending_end_couple]"], ["two strands at the loaded end"])
    expect_bad_input(["run", "panel.toml", "--set", "test.elements_through_strand=49"], ["elements_through_strand", "from 1 to 48"])
    expect_bad_input(["check", "panel.toml", "--set", "materials.m.E_L_MPa=inf"], ["E_L_MPa", "a finite number, greater than 0"])
    expect_bad_input(["check", "panel.toml", "--set", "materials.m.hardening_n=0.5"], ["hardening_n", "1 or more"])
    pathlib.Path("mat.json").write_text(
        '{"length_mm": 5, "layer_thickness_mm": 0.8, "layers": [{"role": "surface", "strands": [{"x0": 0, "x1": 5}]}, '
        '{"role": "surface", "strands": [{"x0": 0, "x1": 5, "material": "popla"}]}]}', encoding="utf-8")
    expect_bad_input(["run", "panel.toml", "--set", "mat.file=mat.json"], ["mat.json", "layer 2", "unknown material \"popla\"", "poplar"])


def run_folders():
    pathlib.Path("panel.toml").write_text("[mat]\nlength_mm = 5\nrows = [\"surface*2\"]\n", encoding="utf-8")
    check(strandlab("mat", "panel.toml", "-o", "run").returncode == DONE, "mat")
    expect_bad_input(["mat", "panel.toml", "-o", "run", "--set", "run.seed=2"],
                     ["run", "another case", "run.seed = 1 there, 2 here", "--force"])
    pathlib.Path("letters").mkdir()
    pathlib.Path("letters/letter.txt").write_text("dear", encoding="utf-8")
    expect_bad_input(["mat", "panel.toml", "-o", "letters"], ["letters", "no strandlab run"])
    expect_bad_input(["mat", "panel.toml", "-o", "letters", "--force"], ["letters", "no strandlab run"])
    expect_bad_input(["mat", "panel.toml", "-o", "panel.toml/run"], ["panel.toml/run", "is not a folder"])
    for folder in ("run", "new"):
        expect_bad_input(["test", "panel.toml", "-o", folder], [folder, "no pressed panel"])
        expect_bad_input(["test", "panel.toml", "-o", folder, "--force"], [folder, "no pressed panel"])
    pathlib.Path("run/mat.json").write_text("{}", encoding="utf-8")
    expect_bad_input(["mat", "panel.toml", "-o", "run"], ["run/mat.json", "not the mat of this case"])
    pathlib.Path("loop").symlink_to("loop")
    for name, why in (("loop", "ymbolic link"), ("loop/run", "ymbolic link"), ("x" * 5000, "too long")):
        expect_bad_input(["mat", "panel.toml", "-o", name], ["cannot be a run folder", why])
        expect_bad_input(["report", name], ["no strandlab run"])
        expect_bad_input(["movie", name], [])
        expect_bad_input(["profile", name], ["no case.toml"])
    expect_bad_input(["report", "run", "-o", "loop/report.html"], ["loop/report.html"])
    expect_bad_input(["mat", "panel.toml", "--set", "glue.from_bondline=.", "--set", "glue.group=a"], ["is a folder", "strandlab bondline"])


def records():
    """A run.json that is none is answered at once, however deep it is."""
    pathlib.Path("panel.toml").write_text("[mat]\nlength_mm = 5\nrows = [\"surface*2\"]\n", encoding="utf-8")
    pathlib.Path("run").mkdir()
    for text in ('{"strandlab": "1", "case": [1, 2], "steps": {}}',
                 '{"strandlab": "1", "case": [], "steps": {"mat": {"x": ' + "[" * 200000 + "]" * 200000 + "}}}"):
        pathlib.Path("run/run.json").write_text(text, encoding="utf-8")
        for command in (["mat", "panel.toml", "-o", "run"], ["mat", "panel.toml", "-o", "run", "--force"], ["report", "run"],
                        ["report", "run", "-o", "page.html"]):
            begin = time.monotonic()
            expect_bad_input(command, ["run/run.json", "not the record of a strandlab run"])
            check(time.monotonic() - begin < 10, f"{command}: takes {time.monotonic() - begin} s")
    pathlib.Path("run/run.json").unlink()
    pathlib.Path("run/run.json").mkdir()
    expect_bad_input(["mat", "panel.toml", "-o", "run"], ["run/run.json", "not the record of a strandlab run"])


def hdf5_files():
    """A pressed panel that is truncated, foreign or missing; a damaged checkpoint."""
    pathlib.Path("panel.toml").write_text("[mat]\nlength_mm = 5\nrows = [\"surface*2\"]\n[press]\ncompactions = [0]\n", encoding="utf-8")
    result = strandlab("press", "panel.toml", "-o", "pressed")
    check(result.returncode == DONE, "press: " + result.stderr)
    panel = pathlib.Path("pressed/panels/panel_0.h5")
    whole = panel.read_bytes()
    panel.write_bytes(whole[: len(whole) // 2])
    expect_bad_input(["test", "panel.toml", "-o", "pressed"], ["panel_0.h5"])
    panel.write_bytes(b"not a panel")
    expect_bad_input(["test", "panel.toml", "-o", "pressed"], ["panel_0.h5"])
    panel.unlink()
    expect_bad_input(["test", "panel.toml", "-o", "pressed"], ["panel_0.h5"])
    panel.write_bytes(whole)
    check(strandlab("test", "panel.toml", "-o", "pressed").returncode == DONE, "test of the whole file")
    expect_bad_input(["test", "panel.toml", "-o", "pressed", "--force", "--set", "press.speed_m_s=8"],
                     ["pressed", "press.speed_m_s = 16 there, 8 here"])

    record = json.loads(pathlib.Path("pressed/run.json").read_text(encoding="utf-8"))
    record["steps"]["press"]["finished"] = False  # as if it had been killed
    del record["steps"]["test"]
    pathlib.Path("pressed/run.json").write_text(json.dumps(record), encoding="utf-8")
    for name in ("moduli.csv", "theory.csv"):
        pathlib.Path("pressed", name).unlink()
    for name in ("plots", "glue_lines"):
        shutil.rmtree(pathlib.Path("pressed", name))
    for name in ("checkpoint.h5", "checkpoint.previous.h5"):
        pathlib.Path("pressed", name).write_bytes(whole[:1000])
    result = expect_no_new_results(["press", "panel.toml", "-o", "pressed"])
    check("checkpoint" in result.stderr, "the message names the checkpoint: " + result.stderr)


def expect_no_new_results(arguments):
    """Like expect_bad_input for a run folder whose case is known: run.json may be written again."""
    before = {name: text for name, text in files().items() if not name.endswith("run.json")}
    result = strandlab(*arguments)
    check(result.returncode == 2, f"{arguments}: exit code {result.returncode}: {result.stderr}")
    after = {name: text for name, text in files().items() if not name.endswith("run.json")}
    check(after == before, f"{arguments}: wrote files")
    return result


def no_permission():
    """A folder that may not be written: as nobody where the test runs as root."""
    pathlib.Path("panel.toml").write_text("[mat]\nlength_mm = 50\n", encoding="utf-8")
    pathlib.Path("closed").mkdir()
    os.chmod("closed", 0o555)
    os.chmod(".", 0o755)
    nobody = (lambda: os.setuid(65534)) if os.geteuid() == 0 else None
    expect_bad_input(["mat", "panel.toml", "-o", "closed/run"], ["closed/run", "ermission denied"], preexec_fn=nobody)


def no_space():
    """Files that cannot grow: writes fail as on a full disk, and leave no half file."""
    pathlib.Path("panel.toml").write_text("[mat]\nlength_mm = 50\n", encoding="utf-8")

    def full():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

    result = strandlab("mat", "panel.toml", "-o", "full", preexec_fn=full)
    check(result.returncode in (2, 3), f"full disk: exit code {result.returncode}")
    check("full/" in result.stderr, "full disk: the message names the file: " + result.stderr)
    check(not any(files("full").values()), f"full disk: left {list(files('full'))}")


def names_of_any_bytes():
    """Names are bytes: a run whose case or folder is not UTF-8 works, and what it writes is UTF-8."""
    folder = b"sh\xe4re"
    os.mkdir(folder)
    with open(folder + b"/f\xfcr.toml", "w", encoding="utf-8") as case:
        case.write(SMALL_CASE + NO_PICTURES)
    result = subprocess.run([PROGRAM, b"run", folder + b"/f\xfcr.toml"], capture_output=True, timeout=300, check=False)
    check(result.returncode == DONE, f"a name that is not UTF-8: {result.stderr}")
    for output in (result.stdout, result.stderr):
        output.decode("utf-8")  # throws where it is not
    check(b"f\\xfcr" in result.stdout, f"the name as text: {result.stdout}")
    run = b"runs/f\xfcr/"
    for name in (b"run.json", b"case.toml", b"log.txt", b"report.html"):
        if os.path.exists(run + name):
            with open(run + name, encoding="utf-8") as text:
                text.read()
    check(json.load(open(run + b"run.json", encoding="utf-8"))["case_name"] == "f\\xfcr", "case_name")
    again = subprocess.run([PROGRAM, b"run", folder + b"/f\xfcr.toml"], capture_output=True, timeout=300, check=False)
    check(again.returncode == DONE and b"is finished" in again.stdout, f"the same case again: {again.stdout} {again.stderr}")
    shutil.copy(run + b"mat.json", folder + b"/mat.json")
    with open(folder + b"/m.toml", "w", encoding="utf-8") as case:
        case.write(SMALL_CASE.replace("[mat]\n", "[mat]\nfile = 'mat.json'\n"))
    for _ in range(2):
        result = subprocess.run([PROGRAM, b"mat", folder + b"/m.toml", b"-o", b"m\xfc"], capture_output=True, timeout=300, check=False)
        check(result.returncode == DONE, f"a mat file in a folder that is not UTF-8: {result.stderr}")


def several_mistakes():
    """A line for each mistake of a case."""
    pathlib.Path("bad.toml").write_text("[mat]\nlenght_mm = 3\n[press]\nfriction = -1\n", encoding="utf-8")
    lines = expect_bad_input(["check", "bad.toml"], ["bad.toml:2", "bad.toml:4"]).stderr.splitlines()
    check(len(lines) == 2 and all(line.startswith("strandlab: ") for line in lines), f"a line for each mistake: {lines}")


TESTS = [usage, names_of_any_bytes, case_files, several_mistakes, overrides, mat_files, tests_no_mat_can_take, run_folders, records, hdf5_files, no_permission, no_space]

for test in TESTS:
    with scratch():
        strandlab_case = strandlab("init", "osb")
        pathlib.Path("osb.toml").write_text(strandlab_case.stdout, encoding="utf-8")
        test()
check((SOURCE / "cases" / "osb.toml").exists(), "cases/osb.toml")
finish()
