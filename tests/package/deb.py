"""Makes the Debian packages, unpacks them into a prefix of their own, and uses them from an empty folder, as a user without rights
where the test runs as root: deb.py BUILD CPACK PYTHON"""

import os
import pathlib
import shutil
import sys
import tempfile

from packages import MODULI, READ_MODULI, SETTINGS, made, run

BUILD, CPACK, PYTHON = sys.argv[1:]

with tempfile.TemporaryDirectory(prefix="strandlab_deb_") as name:
    folder = pathlib.Path(name)
    folder.chmod(0o755)
    packages = made(BUILD, CPACK, folder / "packages")
    for package in packages.values():
        depends = run("dpkg-deb", "-f", package, "Depends")
        for library in ("libc6", "libhdf5", "libcholmod", "libfmt"):
            if library not in depends:
                sys.exit(f"FAILED: {package.name} does not depend on {library}: {depends}")
        run("dpkg-deb", "-x", package, folder / "root")
    prefix = folder / "root" / "usr"
    for file in ("share/man/man1/strandlab.1", "share/bash-completion/completions/strandlab", "share/strandlab/cases/osb.toml",
                 *(f"share/doc/{name}/copyright" for name in packages)):
        if not (prefix / file).is_file():
            sys.exit(f"FAILED: the package lacks {file}")
    completed = run("bash", "-c", f"compopt() {{ :; }}; source {prefix}/share/bash-completion/completions/strandlab; "
                    "COMP_WORDS=(strandlab run --set press.s); COMP_CWORD=3; _strandlab; echo ${COMPREPLY[@]}")
    if completed.split() != ["press.speed_m_s=", "press.sides=", "press.symmetric="]:
        sys.exit(f"FAILED: bash completes --set press.s to {completed}")
    keys = {"press.speed_m_s", "press.sides", "press.symmetric"}
    if shutil.which("zsh"):  # its own functions stand in for the editor's, which match what was typed
        zsh = (f"compadd() {{ print -l -- $@ }}; complete_it() {{ source {prefix}/share/zsh/vendor-completions/_strandlab }}; "
               "words=(strandlab run --set press.s) CURRENT=4; complete_it")
        if not keys <= set(run("zsh", "-fc", zsh).split()):
            sys.exit("FAILED: zsh offers no keys after --set")
    else:
        print("zsh is not there: its completion is not tried")
    if shutil.which("fish"):
        fish = f"source {prefix}/share/fish/vendor_completions.d/strandlab.fish; complete -C 'strandlab run --set press.s'"
        found = {line.split("=")[0] for line in run("fish", "--no-config", "-c", fish).splitlines()}
        if found != keys:
            sys.exit(f"FAILED: fish completes --set press.s to {found}")
    else:
        print("fish is not there: its completion is not tried")
    empty = folder / "empty"
    empty.mkdir()
    user = []
    if os.geteuid() == 0 and shutil.which("setpriv"):
        user = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
        os.chown(empty, 65534, 65534)
    environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"} | {"HOME": str(empty)}
    run(*user, prefix / "bin" / "strandlab", "run", prefix / "share/strandlab/cases/osb.toml", *SETTINGS, cwd=empty, env=environment)
    if not (empty / "runs" / "osb" / "report.html").is_file():
        sys.exit("FAILED: the installed program left no report.html")
    if "python3-strandlab" in packages:
        module = prefix / "lib" / "python3" / "dist-packages"
        told = run(*user, PYTHON, "-B", "-c", READ_MODULI, cwd=empty, env=environment | {"PYTHONPATH": str(module)})
        if told.strip() != str(MODULI):
            sys.exit(f"FAILED: moduli read by Python: {told}")
    print("packages:", ", ".join(package.name for package in packages.values()))
