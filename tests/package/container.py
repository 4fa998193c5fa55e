"""Builds the Containerfile and presses a small panel with it, as docs/install.md has it: container.py SOURCE

A quarter of an hour. The Debian that it starts from is bootstrapped, so that no registry is asked. Needs root's rights, podman and
mmdebstrap, else it is skipped; package_clean_root_Nightly installs the same packages into a bootstrapped root without podman."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from packages import SETTINGS, run, skip

SOURCE = pathlib.Path(sys.argv[1])
MIRROR = os.environ.get("STRANDLAB_DEBIAN_MIRROR", "http://deb.debian.org/debian")
if os.geteuid() != 0 or not shutil.which("podman") or not shutil.which("mmdebstrap"):
    skip("needs root's rights, podman and mmdebstrap (Debian: podman, mmdebstrap)")
LIMITS = ["--ulimit=nofile=1024:1024", "--ulimit=nproc=1024:1024"]

with tempfile.TemporaryDirectory(prefix="strandlab_container_") as name:
    folder = pathlib.Path(name)
    # As in a container without systemd of its own: no groups of processes, storage as plain folders.
    podman = ["podman", "--cgroup-manager=cgroupfs", "--storage-driver=vfs", f"--root={folder}/storage", f"--runroot={folder}/run",
              f"--tmpdir={folder}/tmp"]
    try:
        if (told := subprocess.run([*podman, "info"], capture_output=True, text=True, check=False)).returncode != 0:
            skip(f"podman does not work here: {told.stderr.strip()[-200:]}")
        run("mmdebstrap", "--variant=apt", "--mode=root", "bookworm", folder / "debian.tar", f"deb {MIRROR} bookworm main", timeout=900)
        run(*podman, "import", folder / "debian.tar", "localhost/debian:12", timeout=300)
        run("git", "clone", "-q", SOURCE, folder / "tree")
        # One that cannot start even a trivial program is no fault of ours; inside another container some of its ways are closed.
        for runtime, options in (([], []), ([], LIMITS), (["--runtime=runc"], ["--cgroups=no-conmon", *LIMITS])):
            podman_run = [*podman, *runtime, "run", "--rm", *options]
            trivial = subprocess.run([*podman_run, "--network=none", "localhost/debian:12", "true"], capture_output=True, text=True, check=False)
            if trivial.returncode == 0:
                break
        else:
            skip(f"podman starts nothing here: {trivial.stderr.strip()[-200:]}")
        # npm trusts whom this machine trusts, as behind a firewall that reads along.
        trusted = pathlib.Path("/etc/ssl/certs/ca-certificates.crt")
        trust = [f"--volume={trusted}:/trusted.crt:ro", "--env=NODE_EXTRA_CA_CERTS=/trusted.crt"] if trusted.exists() else []
        run(*podman, "build", "--network=host", "--isolation=chroot", *trust, "--build-arg=BASE=localhost/debian:12", "-t", "strandlab",
            folder / "tree", timeout=3600)
        work = folder / "work"
        work.mkdir()
        inside = [*podman_run, "--network=none", "-v", f"{work}:/work", "strandlab"]
        (work / "osb.toml").write_text(run(*inside, "init", "osb"), encoding="utf-8")
        run(*inside, "run", "osb.toml", *SETTINGS)
        for file in ("moduli.csv", "report.html", "pictures/stress.png"):
            if not (work / "runs/osb" / file).is_file():
                sys.exit(f"FAILED: the program in the container left no {file}")
        told = run(*inside, "doctor")
        if "ok      self-test" not in told:
            sys.exit(f"FAILED: strandlab doctor:\n{told}")
    finally:
        subprocess.run([*podman, "system", "reset", "--force"], capture_output=True, check=False)
print("the Containerfile makes an image that presses and tests a panel")
