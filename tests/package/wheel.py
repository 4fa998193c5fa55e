"""What pip does by pyproject.toml, but for the archive: scikit-build-core is not in Debian 12, so its steps are taken by hand.
wheel.py SOURCE BUILD CMAKE CXX CC PYTHON"""

import os
import pathlib
import subprocess
import sys
import tomllib

SOURCE, BUILD, CMAKE, CXX, CC, PYTHON = sys.argv[1:]


def run(*command, env=None):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, env=env)
    if result.returncode != 0:
        sys.exit(f"FAILED: {' '.join(map(str, command))}: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return result.stdout


backend = tomllib.loads(pathlib.Path(SOURCE, "pyproject.toml").read_text(encoding="utf-8"))["tool"]["scikit-build"]
folder = pathlib.Path(BUILD, "wheel")
run(CMAKE, "-S", SOURCE, "-B", folder / "build", "-G", "Ninja", "-DSKBUILD=2", "-DSKBUILD_STATE=wheel", f"-DPython3_EXECUTABLE={PYTHON}",
    f"-DCMAKE_BUILD_TYPE={backend['cmake']['build-type']}", f"-DCMAKE_CXX_COMPILER={CXX}", f"-DCMAKE_C_COMPILER={CC}",
    "-DCMAKE_UNITY_BUILD=ON", *(f"-D{key}={value}" for key, value in backend["cmake"]["define"].items()))
run(CMAKE, "--build", folder / "build", "--target", *backend["build"]["targets"])
for component in backend["install"]["components"]:
    run(CMAKE, "--install", folder / "build", "--prefix", folder / "root", "--component", component)
left = sorted(path.name for path in (folder / "root").iterdir())
if left != ["strandlab"]:
    sys.exit(f"FAILED: the wheel's root holds {left}")
told = run(PYTHON, "-B", "-c", "import strandlab; print(strandlab.__file__, strandlab.Case.ready('osb').name)",
           env=os.environ | {"PYTHONPATH": str(folder / "root")})
if told.split() != [str(folder / "root" / "strandlab" / "__init__.py"), "osb"]:
    sys.exit(f"FAILED: {told}")
print("failures: 0")
