"""strandlab study on a Slurm of one machine, started here without systemd and with a configuration of its own: an array is run, a task of it
killed, what is missing submitted again, one told to stop before its time is up; the tables are those of an undisturbed study."""

import contextlib
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import time

from program import DONE, PROGRAM, check, finish, scratch, strandlab

DAEMONS = ("munged", "slurmctld", "slurmd")
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"
TABLES = ("results.csv", "summary.csv", "effects.csv", "profiles.csv", "press.csv")

# Seconds of work an item: long enough to be met at work, and checkpoints all the time.
CASE = """[mat]
length_mm = 12
rows = ["surface", "core*2", "surface"]
[kinds.core]
gap_mm = 1
gap_sd_mm = 0.2
[press]
compactions = [0, 0.05]
speed_m_s = 4
[glue]
compliance_t_mm_per_MPa = [0, 0.0105]
[run]
checkpoint_interval_s = 0.05
"""
PLAN = """base = "case.toml"
replicates = 2
[axes]
"press.friction" = [0.3, 0.6]
"""


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


missing = [name for name in (*DAEMONS, "sbatch") if not shutil.which(name, path=PATH)]
if missing:
    skip(f"no {', '.join(missing)} (Debian: slurm-wlm, munge)")
if os.geteuid() != 0:
    skip("Slurm's daemons want root's rights")


def free_port():
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        return listening.getsockname()[1]


@contextlib.contextmanager
def cluster(folder):
    """Slurm with one node, this machine; the environment says where its configuration is."""
    for name in ("state", "spool"):
        (folder / name).mkdir()
    (folder / "munge.key").write_bytes(os.urandom(1024))
    (folder / "munge.key").chmod(0o600)
    configuration = folder / "slurm.conf"
    configuration.write_text(f"""ClusterName=here
SlurmctldHost=localhost
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=2
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=bf_interval=1,sched_interval=1,batch_sched_delay=0
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MailProg=/bin/true
ReturnToService=2
SlurmdParameters=config_overrides
MaxArraySize=3
NodeName=localhost CPUs=2 RealMemory=1500 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""", encoding="utf-8")
    os.environ["SLURM_CONF"] = str(configuration)
    munged = ["munged", "--foreground", "--force", f"--key-file={folder}/munge.key", f"--socket={folder}/munge.socket",
              f"--pid-file={folder}/munged.pid", f"--log-file={folder}/munged.log", f"--seed-file={folder}/munged.seed"]
    started = []
    try:
        for command in (munged, ["slurmctld", "-D"], ["slurmd", "-D", "-N", "localhost"]):
            log = open(folder / f"{command[0]}.out", "w", encoding="utf-8")
            started.append(subprocess.Popen([shutil.which(command[0], path=PATH), *command[1:]], stdout=log, stderr=log))
            time.sleep(1)
        until(lambda: "idle" in told("sinfo", "-h", "-o", "%t"), "the node is there",
              lambda: "\n".join(path.read_text(errors="replace")[-1500:] for path in folder.glob("*.out")))
        yield
    finally:
        for daemon in reversed(started):
            daemon.terminate()
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def told(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60).stdout


def until(holds, what, why=lambda: "", seconds=120):
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            sys.exit(f"FAILED: {what} did not come about in {seconds} s: {why()}")
        time.sleep(0.1)


def queue():
    return told("squeue", "-h", "-r", "-o", "%i %T %j").split("\n")


def submit():
    result = strandlab("study", "run", "plan.toml", "-o", "queued", "--runner", "slurm")
    check(result.returncode == DONE, f"submitted: {result.stderr}")
    return result.stdout


def ended():
    until(lambda: not any(queue()), "the queue is empty", lambda: f"{queue()} {told('scontrol', 'show', 'job')[-1500:]}")


def running_tasks():
    return [line.split()[0] for line in queue() if line.endswith("RUNNING study")]


def logs():
    return "\n".join(path.read_text(errors="replace") for path in pathlib.Path("queued/slurm").glob("*.log"))


def tables(folder):
    return {name: pathlib.Path(folder, name).read_bytes() for name in TABLES}


with scratch() as folder, cluster(folder):
    pathlib.Path("case.toml").write_text(CASE, encoding="utf-8")
    pathlib.Path("plan.toml").write_text(PLAN, encoding="utf-8")
    check(strandlab("study", "run", "plan.toml", "-o", "whole").returncode == DONE, "an undisturbed study")
    # Short items are one task of a quarter of an hour by the estimates: all four of them here.
    told_first = submit()
    check(told_first.count("study: job ") == 2 and "--dependency=afterany:" in told_first, f"an array, and a job that collects: {told_first}")
    until(running_tasks, "a task runs", logs)
    until(lambda: list(pathlib.Path("queued/pressings").rglob("checkpoint.h5")), "a pressing is under way", logs)
    told("scancel", "--signal=KILL", running_tasks()[0])
    ended()
    check(pathlib.Path("queued/results.csv").exists(), f"the job that collects ran all the same: {logs()}")
    check(tables("queued") != tables("whole"), "the killed task left items undone")

    before = time.time()
    check("study: job " in submit(), "what is missing is submitted again")
    until(running_tasks, "it runs", logs)
    until(lambda: any(path.stat().st_mtime > before for path in pathlib.Path("queued/pressings").rglob("checkpoint.h5")), "and presses", logs)
    # As before its time is up; the task leaves a checkpoint and is queued again.
    task = running_tasks()[0]
    told("scancel", "--signal=USR1", "--batch", task)
    until(lambda: "Reason=BeginTime" in told("scontrol", "show", "job", task), "the task hears the signal and is queued again", logs)
    time.sleep(1)
    told("scontrol", "update", f"jobid={task}", "starttime=now")  # Slurm lets it wait for two minutes
    ended()
    check(tables("queued") == tables("whole"), f"killed, submitted again and stopped, the tables are those of an undisturbed study: {logs()[-1500:]}")
    check("nothing to submit" in submit(), "then nothing is left to submit")
finish()
