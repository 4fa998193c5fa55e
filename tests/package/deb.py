"""Makes the Debian packages, unpacks them into a prefix of their own, and uses them from an empty folder, as a user without rights
where the test runs as root: deb.py BUILD CPACK PYTHON"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

BUILD, CPACK, PYTHON = sys.argv[1:]
# Of the installed osb.toml: four rows, 12 mm long.
SMALL = ("mat.length_mm=12", "mat.rows=[surface,core*2,surface]", "kinds.core.gap_mm=1", "kinds.core.gap_sd_mm=0.2", "press.speed_m_s=64",
         "press.compactions=[0,0.05]")


def run(*command, **options):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=280, check=False, **options)
    if result.returncode != 0:
        sys.exit(f"FAILED: {' '.join(map(str, command))}: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return result.stdout


if not shutil.which("dpkg-shlibdeps"):
    print("skipped: no dpkg-shlibdeps (Debian: dpkg-dev)")
    sys.exit(77)

with tempfile.TemporaryDirectory(prefix="strandlab_deb_") as name:
    folder = pathlib.Path(name)
    folder.chmod(0o755)
    run(CPACK, "-G", "DEB", "-B", folder / "packages", cwd=BUILD)
    packages = {package.name.split("_")[0]: package for package in (folder / "packages").glob("*.deb")}
    if "strandlab" not in packages:
        sys.exit(f"FAILED: packages: {sorted(packages)}")
    for package in packages.values():
        depends = run("dpkg-deb", "-f", package, "Depends")
        for library in ("libc6", "libhdf5", "libcholmod", "libfmt"):
            if library not in depends:
                sys.exit(f"FAILED: {package.name} does not depend on {library}: {depends}")
        run("dpkg-deb", "-x", package, folder / "root")
    prefix = folder / "root" / "usr"
    for file in ("share/man/man1/strandlab.1", "share/bash-completion/completions/strandlab", "share/strandlab/cases/osb.toml"):
        if not (prefix / file).is_file():
            sys.exit(f"FAILED: the package lacks {file}")
    completed = run("bash", "-c", f"compopt() {{ :; }}; source {prefix}/share/bash-completion/completions/strandlab; "
                    "COMP_WORDS=(strandlab run --set press.s); COMP_CWORD=3; _strandlab; echo ${COMPREPLY[@]}")
    if completed.split() != ["press.speed_m_s=", "press.sides=", "press.symmetric="]:
        sys.exit(f"FAILED: bash completes --set press.s to {completed}")
    empty = folder / "empty"
    empty.mkdir()
    user = []
    if os.geteuid() == 0 and shutil.which("setpriv"):
        user = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
        os.chown(empty, 65534, 65534)
    environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"} | {"HOME": str(empty)}
    run(*user, prefix / "bin" / "strandlab", "run", prefix / "share/strandlab/cases/osb.toml", *(part for key in SMALL for part in ("--set", key)),
        cwd=empty, env=environment)
    if not (empty / "runs" / "osb" / "report.html").is_file():
        sys.exit("FAILED: the installed program left no report.html")
    if "python3-strandlab" in packages:
        module = prefix / "lib" / "python3" / "dist-packages"
        told = run(*user, PYTHON, "-B", "-c", "import strandlab; print(len(strandlab.open_run('runs/osb').moduli['modulus_MPa']))", cwd=empty,
                   env=environment | {"PYTHONPATH": str(module)})
        if told.strip() != "20":  # two states, two tests, five glues
            sys.exit(f"FAILED: moduli read by Python: {told}")
    print("packages:", ", ".join(package.name for package in packages.values()))
