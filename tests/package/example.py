"""Installs the laboratory into a prefix of its own, builds an example against it, and runs that in an empty folder:
example.py BUILD EXAMPLE CMAKE CXX CC PYTHON"""

import pathlib
import re
import subprocess
import sys
import tempfile

BUILD, EXAMPLE, CMAKE, CXX, CC, PYTHON = sys.argv[1:]


def run(*command, cwd=None):
    result = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True, timeout=280, check=False)
    if result.returncode != 0:
        sys.exit(f"FAILED: {' '.join(map(str, command))}: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return result


with tempfile.TemporaryDirectory(prefix="strandlab_package_") as name:
    folder = pathlib.Path(name)
    run(CMAKE, "--install", BUILD, "--prefix", folder / "prefix")
    run(CMAKE, "-S", EXAMPLE, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_CXX_COMPILER={CXX}", f"-DCMAKE_C_COMPILER={CC}")
    run(CMAKE, "--build", folder / "build")
    empty = folder / "empty"
    empty.mkdir()
    result = run(folder / "build" / "press_and_test", cwd=empty)
    left = sorted(p.name for p in empty.iterdir())
    moduli = re.findall(r"^compaction 0\.02, (\w+), 1/D_t = ([\d.]+) mm/MPa: (\d+) MPa$", result.stdout, re.MULTILINE)
    if [m[:2] for m in moduli] != [("tension", "0"), ("bending_end_rotation", "0"), ("tension", "0.0105"),
                                   ("bending_end_rotation", "0.0105")]:
        sys.exit(f"FAILED: not the moduli asked for:\n{result.stdout}")
    if len(result.stdout.splitlines()) != 5 or result.stderr or left:
        sys.exit(f"FAILED: the library printed or wrote something: {left}\n{result.stdout}{result.stderr}")
    if PYTHON:  # the module lies where this version of Debian's Python looks below a prefix that is not /usr
        packages = run(PYTHON, "-c", "import sys; print(f'lib/python{sys.version_info.major}.{sys.version_info.minor}/dist-packages')").stdout.strip()
        run(PYTHON, "-B", "-c", f"import sys; sys.path.insert(0, '{folder / 'prefix' / packages}'); import strandlab; strandlab.Case()", cwd=empty)
print("failures: 0")
