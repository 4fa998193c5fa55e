"""report.html of a run, made again from its folder alone, and the film of a pressing."""

import json
import os
import pathlib
import shutil
import stat
import subprocess

from program import DONE, FAILED, PROGRAM, NO_PICTURES, SMALL_CASE, check, expect_bad_input, finish, scratch, strandlab

# Names are the user's: this one wants to be markup.
HOSTILE = "</script><script>alert(1)</script><b>\"'&\U0001fab5" + "x" * 300


def data_of(page):
    text = pathlib.Path(page).read_text(encoding="utf-8")
    begin = text.index('<script type="application/json" id="data">') + len('<script type="application/json" id="data">')
    return json.loads(text[begin:text.index("</script>", begin)])


def made_with_the_run_and_again():
    pathlib.Path("a.toml").write_text(SMALL_CASE + NO_PICTURES, encoding="utf-8")
    result = strandlab("run", "a.toml", "-o", "out")
    check(result.returncode == DONE and "report.html" in result.stdout, f"run says where the report is: {result.stdout}{result.stderr}")
    first = pathlib.Path("out/report.html").read_bytes()
    pathlib.Path("a.toml").unlink()
    pathlib.Path("out/report.html").unlink()
    shutil.move("out", "moved")
    again = strandlab("report", "moved")
    check(again.returncode == DONE, f"report: {again.stderr}")
    check(pathlib.Path("moved/report.html").read_bytes() == first, "the run folder alone gives the same report")
    check(strandlab("report", "moved", "-o", "other.html").returncode == DONE and pathlib.Path("other.html").exists(), "report -o")
    text = first.decode("utf-8")
    check("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'" in text, "the page may load nothing")
    run = data_of("moved/report.html")["run"]
    for name in ("press.csv", "moduli.csv", "theory.csv", "morphology.csv", "histograms.csv"):
        check(run["tables"][name] == pathlib.Path("moved", name).read_text(encoding="utf-8"), f"the report holds {name} as it is")
    slip = pathlib.Path("moved/glue_lines/slip_0.04.csv").read_text(encoding="utf-8")
    check(run["tables"]["glue_lines/slip_0.04.csv"] == slip and ",0,1," in slip, "the report holds the slips of glue lines")
    frames = run["frames"]["frames"]
    check(len(frames) == 41, f"frames: {len(frames)}")
    step = 0.04 / 40
    check(all(abs(f["compaction"] - k * step) < 0.5 * step for k, f in enumerate(frames)), "frames are even in compaction")


def without_frames():
    """A folder of an older version, or of which the frames were deleted: its panels take their place."""
    shutil.copytree("moved", "old")
    shutil.rmtree("old/frames")
    check(strandlab("report", "old").returncode == DONE, "report without frames")
    check(len(data_of("old/report.html")["run"]["frames"]["frames"]) == 3, "a frame per panel kept")


def steps_that_are_not_done():
    pathlib.Path("b.toml").write_text(SMALL_CASE + NO_PICTURES, encoding="utf-8")
    check(strandlab("mat", "b.toml", "-o", "half").returncode == DONE, "mat")
    check(strandlab("report", "half").returncode == DONE, "report of a mat")
    run = data_of("half/report.html")["run"]
    check(run["tables"] == {} and run["frames"]["frames"] == [] and run["mat"], "a mat has no results yet")
    expect_bad_input(["movie", "half", "-o", "half.mp4"], ["half", "no pressed panel"], env=path_with_ffmpeg(""))


def hostile_names():
    """A run folder with such a name in its record and its mat still is a page whose data are data."""
    shutil.copytree("moved", "hostile")
    for name in ("run.json", "mat.json"):
        file = pathlib.Path("hostile", name)
        json_text = json.loads(file.read_text(encoding="utf-8"))
        if name == "run.json":
            json_text["case_name"] = HOSTILE
        else:
            json_text["layers"][0]["role"] = HOSTILE
        file.write_text(json.dumps(json_text), encoding="utf-8")
    check(strandlab("report", "hostile").returncode == DONE, "report with hostile names")
    text = pathlib.Path("hostile/report.html").read_text(encoding="utf-8")
    check("alert(1)<" not in text, "no name ends the element it is in")
    check(data_of("hostile/report.html")["run"]["record"]["case_name"] == HOSTILE, "the name stays what it is")


def figures():
    """A section of each colour for each state, four plots of the pressing, two of each test, in each format."""
    for name, begin in (("pdf", b"%PDF"), ("svg", b"<?xml"), ("png", b"\x89PNG")):
        result = strandlab("figures", "moved", "-o", name, "--format", name, "--width-mm", "60", "--font", "DejaVu Sans")
        check(result.returncode == DONE and "figures: 14 -> " in result.stdout, f"figures: {result.stdout}{result.stderr}")
        drawn = sorted(pathlib.Path(name).iterdir())
        check(len(drawn) == 14 and all(file.suffix == f".{name}" and file.read_bytes().startswith(begin) for file in drawn), f"figures: {drawn}")
    expect_bad_input(["figures", "moved", "--width-mm", "5"], ["--width-mm 5", "30 to 500"])
    expect_bad_input(["figures", "moved", "--font-pt", "1"], ["--font-pt 1"])
    expect_bad_input(["figures", "moved", "--font", 'a"; system "ls'], ["--font", "letters, digits"])
    expect_bad_input(["figures", "half"], ["half", "no pressed panel"])
    expect_bad_input(["figures", "nowhere"], ["nowhere"])


def measured_boards():
    """Densitometer tables beside the panel's own profile: their mean is kept in the folder and shown by its page from then on."""
    shutil.copytree("moved", "beside")
    rows = [f"{k / 4},{500 + 40 * abs(k - 8)},{540 + 40 * abs(k - 8)}" for k in range(17)]
    pathlib.Path("boards.csv").write_text("depth mm,density 1 kg/m3,density 2 kg/m3\n" + "\n".join(rows) + "\n", encoding="utf-8")
    result = strandlab("report", "beside", "--measured", "boards.csv")
    check(result.returncode == DONE, f"report --measured: {result.stderr}")
    kept = pathlib.Path("beside/measured.csv").read_text(encoding="utf-8")
    mean = [row.split(",") for row in kept.splitlines() if row.startswith("mean of 2,")]
    middle = min(mean, key=lambda row: abs(float(row[2]) - 0.5))
    # 500 and 540 kg/m3 in the middle, 160 more per mm from there; the bin's middle is .02 mm away.
    check(abs(float(middle[3]) - 523.2) < 0.1, f"the mean of both boards: {middle}")
    check(float(mean[0][2]) == 0 and float(mean[-1][2]) == 1, "the mean goes from face to face")
    check(strandlab("report", "beside").returncode == DONE, "report again")
    check(data_of("beside/report.html")["run"]["tables"]["measured.csv"] == kept, "the page holds the measured boards")
    expect_bad_input(["report", "beside", "--measured", "none.csv"], ["none.csv"])
    check(pathlib.Path("beside/measured.csv").read_text(encoding="utf-8") == kept, "a table that cannot be read changes nothing")
    expect_bad_input(["report", "nowhere", "--measured", "boards.csv"], ["nowhere"])
    check(not pathlib.Path("nowhere").exists(), "no folder is made")


def refusals():
    expect_bad_input(["report", "nowhere"], ["nowhere", "run.json"])
    expect_bad_input(["report", "moved", "-o", "no/folder/report.html"], ["no/folder"])
    empty = {**os.environ, "STRANDLAB_SHARE": "/nowhere"}
    expect_bad_input(["report", "moved"], ["/nowhere/report.html", "STRANDLAB_SHARE", "Node.js"], env=empty)
    damaged = pathlib.Path("damaged")
    shutil.copytree("moved", damaged)
    (damaged / "frames" / "frame_03.h5").write_bytes(b"nothing")
    expect_bad_input(["report", "damaged"], ["frame_03.h5"])
    (damaged / "run.json").write_text("[]", encoding="utf-8")
    expect_bad_input(["report", "damaged"], ["run.json"])


def run_without_a_page():
    """A program without the report's page does its main job and says how to get the page."""
    result = strandlab("run", "b.toml", "-o", "bare", env={**os.environ, "STRANDLAB_SHARE": "/nowhere"})
    check(result.returncode == DONE and "no report.html" in result.stderr, f"run without the page: {result.stderr}")
    check(pathlib.Path("bare/moduli.csv").exists() and not pathlib.Path("bare/report.html").exists(), "all but the report")
    result = strandlab("run", "b.toml", "-o", "bare")
    check(result.returncode == DONE and pathlib.Path("bare/report.html").exists(), "a finished run gets its report later")


def several_at_once():
    """Reports of one folder that are made at the same time are all made."""
    commands = [subprocess.Popen([PROGRAM, "report", "moved"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for _ in range(8)]
    for command in commands:
        _, errors = command.communicate()
        check(command.returncode == DONE, f"one of several reports: {errors}")
    check(len(data_of("moved/report.html")["run"]["frames"]["frames"]) == 41, "and the page is whole")
    check(not list(pathlib.Path("moved").glob("*.tmp")), "nothing is left of them")


def mat_of_another_length():
    """The page's sizes are those of the mat, also where a mat file's are not those of the case."""
    pathlib.Path("m.toml").write_text(SMALL_CASE + NO_PICTURES, encoding="utf-8")
    check(strandlab("mat", "m.toml", "-o", "formed").returncode == DONE, "mat")
    mat = json.loads(pathlib.Path("formed/mat.json").read_text(encoding="utf-8"))
    mat["layers"][0]["strands"][0]["material"] = "aspen"
    pathlib.Path("mat.json").write_text(json.dumps(mat), encoding="utf-8")
    aspen = ["--set", "materials.aspen.density_kg_m3=390", "--set", "mat.file=mat.json", "--set", "mat.length_mm=100"]
    shown = strandlab("check", "m.toml", *aspen).stdout
    check("5 x 1.6 mm" in shown and "not mat.length_mm" in shown, f"check: {shown}")
    check(strandlab("run", "m.toml", "-o", "other", *aspen).returncode == DONE, "run")
    run = data_of("other/report.html")["run"]
    check(run["mat"]["length_mm"] == 5 and not {"length_mm", "layer_thickness_mm"} & set(run["case"]), f"sizes: {run['case'].keys()}")
    check(run["case"]["mat_file"].endswith("mat.json"), "the page names the mat file")
    check({m["name"] for m in run["case"]["materials"]} == {"poplar", "aspen"}, f"materials: {run['case']['materials']}")
    expect_bad_input(["check", "m.toml", *aspen, "--set", "test.kinds=[bending_3_point]"], ["mat.json", "length_mm of the mat file is 5"])


def stale_page():
    """A page never stands beside results that it does not show."""
    pathlib.Path("s.toml").write_text(SMALL_CASE + NO_PICTURES, encoding="utf-8")
    page = pathlib.Path("stale/report.html")
    other = ["s.toml", "-o", "stale", "--set", "run.seed=2"]
    check(strandlab("run", "s.toml", "-o", "stale").returncode == DONE, "run with seed 1")
    check(strandlab("press", *other, "--force").returncode == DONE and not page.exists(), "pressed again: the page is gone")
    check(strandlab("report", "stale").returncode == DONE and page.exists(), "report of what there is")
    check(strandlab("test", *other).returncode == DONE and not page.exists(), "tested: the page lacks the moduli, and is gone")
    check(strandlab("run", *other).returncode == DONE, "run with seed 2")
    run = data_of(page)["run"]
    check(run["record"]["seed"] == 2 and "moduli.csv" in run["tables"], f"the page is that of seed {run['record']['seed']}")
    # Ends between the tests and the page, as a kill there does.
    bare = {**os.environ, "STRANDLAB_SHARE": "/nowhere"}
    check(strandlab("run", "s.toml", "-o", "stale", "--force", env=bare).returncode == DONE and not page.exists(), "run --force without a page")
    check(strandlab("run", "s.toml", "-o", "stale").returncode == DONE and data_of(page)["run"]["record"]["seed"] == 1, "then with one")
    # A page that strandlab report made counts as well.
    page.unlink()
    check(strandlab("report", "stale").returncode == DONE, "report")
    before = page.stat().st_mtime_ns
    check("finished" in strandlab("run", "s.toml", "-o", "stale").stdout and page.stat().st_mtime_ns == before, "is kept")


def path_with_ffmpeg(script):
    """An environment whose only ffmpeg is this shell script (None: no ffmpeg)."""
    folder = pathlib.Path("path").absolute()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    if script is not None:
        program = folder / "ffmpeg"
        program.write_text("#!/bin/sh\n" + script, encoding="utf-8")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return {**os.environ, "PATH": str(folder)}


def movie():
    # The stand-in writes what it was asked for and how many pictures lie beside the first.
    fake = 'for last; do :; done; folder="${last%/*}"; set -- "$@" pictures "$folder"/frame_*.png; echo "$*" > "$last"\n'
    for name in ("press.mp4", "press.gif"):
        result = strandlab("movie", "moved", "-o", name, "--width", "400", env=path_with_ffmpeg(fake))
        check(result.returncode == DONE and f"41 frames -> {name}" in result.stdout, f"movie: {result.stdout}{result.stderr}")
        asked, pictures = pathlib.Path(name).read_text(encoding="utf-8").split(" pictures ")
        check(("libx264" in asked) == (name == "press.mp4") and ("palettegen" in asked) == (name == "press.gif"), f"{name}: {asked}")
        check(len(pictures.split()) == 41, f"pictures for the film: {len(pictures.split())}")
    expect_bad_input(["movie", "moved"], ["ffmpeg is not installed", "apt-get install ffmpeg"], env=path_with_ffmpeg(None))
    expect_bad_input(["movie", "moved", "-o", "press.avi"], ["press.avi", ".mp4", ".gif"])
    expect_bad_input(["movie", "moved", "--fps", "0"], ["--fps 0"])
    expect_bad_input(["movie", "nowhere"], ["nowhere", "run.json"], env=path_with_ffmpeg(fake))
    failing = strandlab("movie", "moved", "-o", "bad.mp4", "--width", "400", env=path_with_ffmpeg("echo no such codec >&2; exit 1\n"))
    check(failing.returncode == FAILED and "no such codec" in failing.stderr, f"a failing ffmpeg: {failing.stderr}")
    check(not pathlib.Path("bad.mp4").exists(), "a failed film leaves no file")


if __name__ == "__main__":
    with scratch():
        made_with_the_run_and_again()
        without_frames()
        steps_that_are_not_done()
        hostile_names()
        figures()
        measured_boards()
        refusals()
        run_without_a_page()
        several_at_once()
        mat_of_another_length()
        stale_page()
        movie()
    finish()
