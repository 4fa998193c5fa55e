"""What surrounds the program may fail: a terminal that is gone, a full disk under a pipe, limits of a batch system."""

import os
import pathlib
import resource
import subprocess

from program import PROGRAM, NO_PICTURES, SMALL_CASE, DONE, BAD_INPUT, FAILED, check, expect_bad_input, finish, scratch, strandlab

MB = 1 << 20


def shell(command, **options):
    """Result of a line of shell in which $B is the program; an outlived time limit counts as a failure."""
    try:
        return subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=120, check=False,
                              env=dict(os.environ, B=str(PROGRAM)), **options)
    except subprocess.TimeoutExpired:
        check(False, command + ": still running after 120 s")
        return None


def lost_consoles():
    """Lines on the way may get lost, a run does not; a result that cannot be written is exit code 3."""
    for number, where in enumerate(("2>/dev/full", ">/dev/full", ">/dev/full 2>&1", "2>&-", ">&-", ">&- 2>&- <&-", "| true")):
        folder = f"r{number}"
        result = shell(f"set -o pipefail; $B run small.toml -o {folder} {where}")
        check(result.returncode == DONE, f"run {where}: exit code {result.returncode}\n{result.stderr}")
        for name in ("moduli.csv", "report.html"):
            check(pathlib.Path(folder, name).exists(), f"run {where}: no {name}")
        check(pathlib.Path(folder, "moduli.csv").read_bytes() == pathlib.Path("whole/moduli.csv").read_bytes(),
              f"run {where}: other moduli than an undisturbed run")
    for command in ("init osb", "init --reference", "check small.toml", "theory small.toml", "bondline --example", "--help"):
        for where in (">/dev/full", ">&-"):
            result = shell(f"$B {command} {where}")
            check(result.returncode == FAILED and "standard output" in result.stderr,
                  f"{command} {where}: exit code {result.returncode}, expected 3\n{result.stderr}")
    for where in ("2>/dev/full", "2>&-"):
        result = shell(f"$B check none.toml {where}")
        check(result.returncode == BAD_INPUT, f"check none.toml {where}: exit code {result.returncode}, expected 2")


def closed_terminal():
    """A run in a terminal that is closed: with a hang-up ignored, as nohup and disown do, it finishes."""
    main, terminal = os.openpty()
    process = subprocess.Popen(["bash", "-c", "trap '' HUP; exec \"$B\" run small.toml -o closed"], env=dict(os.environ, B=str(PROGRAM)),
                               stdin=terminal, stdout=terminal, stderr=terminal, start_new_session=True)
    os.close(terminal)
    os.read(main, 1)  # it has said its first words
    os.close(main)
    check(process.wait(timeout=120) == DONE, f"run in a closed terminal: exit code {process.returncode}")
    check(pathlib.Path("closed/moduli.csv").exists(), "run in a closed terminal: no moduli.csv")


def file_size_limit():
    """The page beyond the limit on a file's size is a warning; any other file ends the run, which can go on."""
    page = pathlib.Path("whole/report.html").stat().st_size
    others = max(p.stat().st_size for p in pathlib.Path("whole").rglob("*") if p.is_file() and p.name != "report.html")
    if others < page:
        between = (others + page) // 2
        result = strandlab("run", "small.toml", "-o", "limited",
                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (between, between)))
        check(result.returncode == DONE and "no report.html" in result.stderr and "File too large" in result.stderr,
              f"run, page beyond the limit: exit code {result.returncode}\n{result.stderr}")
    result = strandlab("run", "small.toml", "-o", "small", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000)))
    check(result.returncode == FAILED and "File too large" in result.stderr,
          f"run, files beyond the limit: exit code {result.returncode}\n{result.stderr}")
    result = strandlab("run", "small.toml", "-o", "small")
    check(result.returncode == DONE, "the run cannot go on after a limit on files: " + result.stderr)
    check(pathlib.Path("small/moduli.csv").read_bytes() == pathlib.Path("whole/moduli.csv").read_bytes(), "other moduli after a limit on files")


def address_space():
    """Under ulimit -v a command does its work or says that memory is short: it never spins, never dies by a signal."""
    done = 0
    for limit in (120, 160, 200, 250, 300, 400, 600, 1000, 4000):
        bytes_ = limit * MB
        try:
            result = subprocess.run([PROGRAM, "run", "small.toml", "-o", f"v{limit}"], capture_output=True, text=True, timeout=60, check=False,
                                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (bytes_, bytes_)))
        except subprocess.TimeoutExpired:
            check(False, f"run under ulimit -v of {limit} MB: still running after 60 s")
            continue
        refused = result.returncode in (BAD_INPUT, FAILED) and "memory" in result.stderr
        check(result.returncode == DONE or refused, f"run under ulimit -v of {limit} MB: exit code {result.returncode}\n{result.stderr}")
        done += result.returncode == DONE
    check(done >= 2, f"only {done} runs finish under the wide limits")
    check(strandlab("run", "small.toml", "-o", "v200").returncode == DONE, "the run of 200 MB cannot go on with more")


def large_mats():
    """A mat beyond the memory that is free is refused before it is formed: in no time, also below what is installed."""
    many = ["--set", "mat.length_mm=1e5", "--set", "kinds.core.length_mm=0.01", "--set", "kinds.core.length_sd_mm=0",
            "--set", "kinds.core.gap_mm=0", "--set", "kinds.core.gap_sd_mm=0", "--set", "mat.rows=[\"core*1000\"]"]
    expect_bad_input(["check", "small.toml", *many], ["strands", "particles", "MB of memory", "are free", "mat.length_mm"],
                     preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (10, 10)))
    expect_bad_input(["check", "small.toml", "--set", "mat.length_mm=2e4"], ["particles", "MB of memory", "are free"],
                     preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (400 * MB, 400 * MB)))


def deep_json():
    """JSON nested thousands deep is refused by name wherever the program reads JSON."""
    deep = "[" * 60000 + "]" * 60000
    row = "{\"role\":\"surface\",\"strands\":[{\"x0\":0,\"x1\":5}]}"
    for number, text in enumerate((deep, f"{{\"length_mm\":5,\"layer_thickness_mm\":0.8,\"note\":{deep},\"layers\":[{row}]}}")):
        pathlib.Path(f"deep{number}.json").write_text(text, encoding="utf-8")
        expect_bad_input(["check", "small.toml", "--set", f"mat.file=deep{number}.json"], [f"deep{number}.json", "more than 100 deep"])
    expect_bad_input(["check", "small.toml", "--set", "glue.from_bondline=deep0.json", "--set", "glue.group=PF"], ["deep0.json", "more than 100 deep"])
    pathlib.Path("deep").mkdir()
    pathlib.Path("deep/run.json").write_text(deep, encoding="utf-8")
    expect_bad_input(["run", "small.toml", "-o", "deep"], ["run.json", "more than 100 deep"])
    expect_bad_input(["report", "deep"], ["run.json", "more than 100 deep"])


with scratch():
    pathlib.Path("small.toml").write_text(SMALL_CASE + NO_PICTURES, encoding="utf-8")
    check(strandlab("run", "small.toml", "-o", "whole").returncode == DONE, "run")
    lost_consoles()
    closed_terminal()
    file_size_limit()
    address_space()
    large_mats()
    deep_json()
finish()
