"""Installs the Debian packages by apt into a system that has nothing else, uses them there as a user without rights from an empty folder,
and removes them again without a trace: clean_root.py BUILD CPACK

Minutes, and some 300 MB of packages from Debian's mirror. Needs root's rights and mmdebstrap, else it is skipped."""

import contextlib
import os
import pathlib
import shutil
import sys
import tempfile

from packages import MODULI, READ_MODULI, SETTINGS, made, run, skip

BUILD, CPACK = sys.argv[1:]
MIRROR = os.environ.get("STRANDLAB_DEBIAN_MIRROR", "http://deb.debian.org/debian")
if os.geteuid() != 0 or not shutil.which("mmdebstrap"):
    skip("needs root's rights and mmdebstrap (Debian: mmdebstrap)")


@contextlib.contextmanager
def mounted(kind, place):
    """What programs expect of a running system, there for the while."""
    run("mount", "-t", kind, kind, place)
    try:
        yield
    finally:
        run("umount", place)


def traces(root):
    """Files that name the program."""
    found = [path for folder in ("usr", "etc", "opt", "var/lib/strandlab") for path in (root / folder).rglob("*strandlab*")]
    return sorted(str(path.relative_to(root)) for path in found)


with tempfile.TemporaryDirectory(prefix="strandlab_root_") as name:
    folder = pathlib.Path(name)
    folder.chmod(0o755)
    packages = made(BUILD, CPACK, folder / "packages")
    root = folder / "root"
    run("mmdebstrap", "--variant=apt", "--mode=root", "bookworm", root, f"deb {MIRROR} bookworm main", timeout=900)
    shutil.copy("/etc/resolv.conf", root / "etc/resolv.conf")
    for package in packages.values():
        shutil.copy(package, root / "opt")
    environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C.UTF-8"}

    def inside(*command, user="root", **options):
        return run("chroot", f"--userspec={user}", root, *command, timeout=900, env=environment | {"HOME": "/"}, **options)

    with mounted("proc", root / "proc"):
        inside("apt-get", "update", "-qq")
        inside("apt-get", "install", "-y", "-qq", "--no-install-recommends", *(f"/opt/{package.name}" for package in packages.values()))
        for package in packages.values():
            (root / "opt" / package.name).unlink()
        if "usr/bin/strandlab" not in traces(root):
            sys.exit(f"FAILED: the packages installed {traces(root)}")
        home = root / "home" / "someone"
        home.mkdir()
        os.chown(home, 65534, 65534)

        def as_user(text):
            return inside("sh", "-ec", f"cd /home/someone\n{text}", user="nobody:nogroup")

        as_user("strandlab run /usr/share/strandlab/cases/osb.toml " + " ".join(f"'{part}'" for part in SETTINGS))
        for file in ("moduli.csv", "report.html"):
            if not (home / "runs/osb" / file).is_file():
                sys.exit(f"FAILED: the installed program left no {file}")
        told = as_user("strandlab doctor")
        if "ok      self-test" not in told or "ok      report page" not in told:
            sys.exit(f"FAILED: strandlab doctor:\n{told}")
        if "python3-strandlab" in packages:
            told = as_user(f'python3 -c "{READ_MODULI}"')
            if told.strip() != str(MODULI):
                sys.exit(f"FAILED: moduli read by Python: {told}")
        inside("apt-get", "remove", "-y", "-qq", "--purge", *packages)
        if traces(root):
            sys.exit(f"FAILED: left after removal: {traces(root)}")
    print(f"installed, run and removed in a clean Debian: {', '.join(packages)}")
