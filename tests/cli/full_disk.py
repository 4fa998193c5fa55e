"""A disk that fills up during a run: exit code 3 and the file's name, and once there is space the run goes on to the same bytes.

Needs the right to mount a small file system in memory; exit code 77 (skipped) with the reason where there is none."""

import contextlib
import errno
import os
import pathlib
import subprocess
import sys

from program import DONE, FAILED, PROGRAM, SMALL_CASE, check, finish, scratch, strandlab

CASE = SMALL_CASE + """[run]
checkpoint_interval_s = 0.02
"""
SKIPPED = 77
DISK_MB = 400  # what a run asks for is the estimate for its size, far more than this one writes

# What must not depend on the disk having been full. The log names each start; the older checkpoint is of a moment that the
# clock chose; run.json and the report tell times.
NOT_COMPARED = ("log.txt", "checkpoint.previous.h5", "run.json", "report.html")


def in_a_namespace():
    """Starts this script again where it may mount without the machine seeing it."""
    unshared = [["unshare", "--mount"], ["unshare", "--user", "--map-root-user", "--mount"]]
    for way in unshared:
        with contextlib.suppress(FileNotFoundError):
            if subprocess.run([*way, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True, check=False).returncode == 0:
                os.execvp(way[0], [*way, sys.executable, *sys.argv, "--mounted"])
    print("skipped: no right to mount a file system in memory")
    sys.exit(SKIPPED)


def results(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(pathlib.Path(folder).rglob("*"))
            if p.is_file() and p.name not in NOT_COMPARED}


def fill(file, leave):
    """A file that takes all space but `leave` bytes. Where the run writes in between and too little is left, nothing has been taken: once more."""
    with open(file, "wb") as ballast:
        for _ in range(100):
            space = os.statvfs(file.parent)
            take = space.f_bavail * space.f_frsize - leave
            try:
                os.posix_fallocate(ballast.fileno(), 0, max(take, 1))
                return
            except OSError as error:
                check(error.errno == errno.ENOSPC, f"filling the disk: {error}")
    check(False, "the disk could not be filled")


def fills_up(disk, leave, undisturbed):
    """The disk is filled, but for `leave` bytes, when the run has begun to press; then its ballast is taken away."""
    folder, ballast = disk / f"run_{leave}", disk / "ballast"
    with subprocess.Popen([PROGRAM, "run", "a.toml", "-o", folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        for line in run.stdout:
            if "particles on" in line:
                break
        fill(ballast, leave)
        _, message = run.communicate()
    check(run.returncode == FAILED, f"{leave} bytes left: exit code {run.returncode}, expected 3: {message}")
    check(str(folder) in message and "No space left" in message, f"{leave} bytes left: names the file and the reason: {message}")
    ballast.unlink()
    again = strandlab("run", "a.toml", "-o", folder)
    check(again.returncode == DONE, f"{leave} bytes left: goes on when there is space: {again.stderr}")
    check(results(folder) == undisturbed, f"{leave} bytes left: the bytes of an undisturbed run")
    subprocess.run(["rm", "-r", folder], check=True)


def main():
    if "--mounted" not in sys.argv:
        in_a_namespace()
    with scratch() as folder:
        disk = folder / "disk"
        disk.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK_MB}m", "none", disk], check=True)
        pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
        whole = strandlab("run", "a.toml", "-o", "whole")
        check(whole.returncode == DONE, f"the undisturbed run: {whole.stderr}")
        undisturbed = results("whole")
        for leave in (0, 50_000, 150_000, 400_000, 700_000):
            fills_up(disk, leave, undisturbed)
        subprocess.run(["umount", disk], check=True)
    finish()


main()
