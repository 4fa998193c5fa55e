"""Runs the program in a scratch folder as a user would, and counts what does not hold."""

import contextlib
import os
import pathlib
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
SOURCE = pathlib.Path(__file__).resolve().parents[2]
DONE, BAD_INPUT, FAILED = 0, 2, 3

# Two rows of 5 mm pressed to 4 %: a second of work.
SMALL_CASE = """[mat]
length_mm = 5
rows = ["surface", "core"]
[kinds.core]
length_mm = 2
length_sd_mm = 0.2
gap_mm = 1
gap_sd_mm = 0.2
[press]
speed_m_s = 8
compactions = [0, 0.02, 0.04]
[glue]
compliance_t_mm_per_MPa = [0, 0.0105]
"""

# For runs of which no picture is looked at: they take half as long.
NO_PICTURES = "[run]\npictures = false\n"

failures = 0


def check(holds, message):
    """Counts and prints a failure."""
    global failures
    if not holds:
        failures += 1
        print("FAILED:", message)


def finish():
    print("failures:", failures)
    sys.exit(1 if failures else 0)


def strandlab(*arguments, **options):
    """Result with returncode, stdout, stderr."""
    return subprocess.run([PROGRAM, *map(str, arguments)], **{"capture_output": True, "text": True, "timeout": 300, "check": False} | options)


@contextlib.contextmanager
def scratch():
    """Current folder while it lasts, removed afterwards."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory(prefix="strandlab_cli_") as folder:
        os.chdir(folder)
        try:
            yield pathlib.Path(folder)
        finally:
            os.chdir(before)


def files(folder="."):
    """Every file below a folder with its bytes, to see that nothing was written."""
    return {str(p): p.read_bytes() for p in sorted(pathlib.Path(folder).rglob("*")) if p.is_file()}


def expect_bad_input(arguments, parts, **options):
    """Exit code 2, one message on stderr with these parts, no file written or changed."""
    before = files()
    result = strandlab(*arguments, **options)
    shown = "strandlab " + " ".join(map(str, arguments))
    check(result.returncode == BAD_INPUT, f"{shown}: exit code {result.returncode}, expected 2\n{result.stderr}")
    for part in parts:
        check(part in result.stderr, f"{shown}: the message lacks \"{part}\":\n{result.stderr}")
    check(files() == before, f"{shown}: wrote files {sorted(set(files()) ^ set(before))}")
    return result
