"""The Debian packages of a build folder, for the tests that use them."""

import shutil
import subprocess
import sys

# Of the installed osb.toml: four rows, 12 mm long.
SMALL = ("mat.length_mm=12", "mat.rows=[surface,core*2,surface]", "kinds.core.gap_mm=1", "kinds.core.gap_sd_mm=0.2", "press.speed_m_s=64",
         "press.compactions=[0,0.05]")
SETTINGS = [part for key in SMALL for part in ("--set", key)]
MODULI = 20  # rows of its moduli.csv: two states, two tests, five glues
# Prints the number of moduli of the run in runs/osb.
READ_MODULI = "import strandlab; print(len(strandlab.open_run('runs/osb').moduli['modulus_MPa']))"
SKIPPED = 77


def run(*command, timeout=280, **options):
    """What the command prints; ends the test where it fails."""
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=timeout, check=False, **options)
    if result.returncode != 0:
        sys.exit(f"FAILED: {' '.join(map(str, command))}: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return result.stdout


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def made(build, cpack, folder):
    """Files of the packages by name, made in the folder."""
    if not shutil.which("dpkg-shlibdeps"):
        skip("no dpkg-shlibdeps (Debian: dpkg-dev)")
    run(cpack, "-G", "DEB", "-B", folder, cwd=build)
    packages = {package.name.split("_")[0]: package for package in folder.glob("*.deb")}
    if "strandlab" not in packages:
        sys.exit(f"FAILED: packages: {sorted(packages)}")
    return packages
