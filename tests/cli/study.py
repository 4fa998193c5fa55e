"""strandlab study and compare as a user meets them: the same tables however a study is run, killed, queued, extended and merged."""

import csv
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import time

from files import documented, header
from program import DONE, PROGRAM, check, expect_bad_input, files, finish, scratch, strandlab

# Two rows of 5 mm pressed to 2 %: a tenth of a second of work.
CASE = """[mat]
length_mm = 5
rows = ["surface", "core"]
[kinds.core]
length_mm = 2
length_sd_mm = 0.2
gap_mm = 1
gap_sd_mm = 0.2
[press]
compactions = [0, 0.02]
[glue]
compliance_t_mm_per_MPa = [0, 0.0105]
[run]
checkpoint_interval_s = 0.01
"""
PLAN = """base = "small.toml"
replicates = 2
[axes]
"press.speed_m_s" = [8, 16]
"kinds.core.law" = ["hill", "crushing"]
[[contrasts]]
key = "press.speed_m_s"
value = 16
against = 8
"""
TABLES = ("results.csv", "summary.csv", "effects.csv", "profiles.csv", "press.csv")


def tables(folder):
    """And the page, which has the folder's name as its title."""
    page = pathlib.Path(folder, "report.html").read_text(encoding="utf-8").replace(f"<h1>{folder}</h1>", "").replace(f"<title>{folder} ", "<title>")
    return {name: pathlib.Path(folder, name).read_bytes() for name in TABLES} | {"report.html": page}


def rows(file):
    with open(file, encoding="utf-8") as text:
        return list(csv.DictReader(text))


def study(*arguments, expected=DONE):
    result = strandlab("study", *arguments)
    check(result.returncode == expected, f"study {arguments}: exit code {result.returncode}: {result.stderr}")
    return result


def start(*arguments):
    return subprocess.Popen([PROGRAM, "study", *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def what_a_study_leaves():
    before = files()
    dry = study("run", "plan.toml", "-o", "whole", "--dry-run")
    check(files() == before, "--dry-run writes nothing")
    check("8 item(s): 8 pressing(s), 32 solve(s)" in dry.stdout and "estimated time" in dry.stdout, f"--dry-run: {dry.stdout}")
    check("same mats for all values of: press.speed_m_s, kinds.core.law" in dry.stdout, f"what is shared: {dry.stdout}")
    study("run", "plan.toml", "-o", "whole", "--workers", 2)
    plan, results = rows("whole/plan.csv"), rows("whole/results.csv")
    check(len(plan) == 8 and [p["seed"] for p in plan] == 4 * ["1"] + 4 * ["2"], "8 items, replicates have seeds in turn")
    check(list(results[0])[:8] == ["item", "replicate", "press.speed_m_s", "kinds.core.law", "compaction", "test",
                                   "compliance_t_mm_per_MPa", "modulus_MPa"], f"columns of results.csv: {list(results[0])}")
    check(len(results) == 8 * 2 * 2 * 2, "a row per item, compaction, test and glue")
    moduli = {tuple(r[k] for k in ("press.speed_m_s", "kinds.core.law", "replicate", "test", "compliance_t_mm_per_MPa")):
              float(r["modulus_MPa"]) for r in results if r["compaction"] == "0.02"}
    # The paired difference is the mean of the replicates' differences, worked out here from results.csv.
    contrast = [r for r in rows("whole/summary.csv") if r["contrast"] and r["state"] == "2" and r["kinds.core.law"] == "hill"]
    check(len(contrast) == 4 and contrast[0]["press.speed_m_s"] == "16 - 8", f"contrasts: {contrast}")
    for row in contrast:
        pairs = [moduli["16", "hill", r, row["test"], row["compliance_t_mm_per_MPa"]] -
                 moduli["8", "hill", r, row["test"], row["compliance_t_mm_per_MPa"]] for r in "12"]
        check(abs(float(row["mean_MPa"]) - sum(pairs) / 2) < 1e-9 and row["n"] == "2", f"paired difference: {row}")
    check({r["factor"] for r in rows("whole/effects.csv")} == {"press.speed_m_s", "kinds.core.law"}, "effects of both axes")
    check({r["item"] for r in rows("whole/press.csv")} == {r["item"] for r in rows("whole/profiles.csv")} == {str(i) for i in range(1, 9)},
          "press curves and profiles of all items")
    return tables("whole")


def every_column_is_documented():
    words = documented()
    for name in ("plan.csv", *TABLES):
        for column in header(pathlib.Path("whole", name)):
            check(column in words or "." in column, f"docs/files.md does not explain {column} of {name}")


def once_again(expected):
    before = {name: data for name, data in files("whole").items() if "/items/" in name or "/pressings/" in name}
    again = study("run", "plan.toml", "-o", "whole")
    check("0 of 8 items to do" in again.stdout, f"nothing is left to do: {again.stdout}")
    check({name: data for name, data in files("whole").items() if name in before} == before, "nothing is done again")
    check(tables("whole") == expected, "the same tables")


def item_by_item(expected):
    """As a cluster runs it, one worker."""
    study("plan", "plan.toml", "-o", "single")
    study("collect", "single")
    check(rows("single/results.csv") == [], "no results yet")
    for name in range(1, 8):
        study("item", "single", name)
    study("item", "single", rows("single/plan.csv")[7]["hash"], "--keep", "moduli")
    study("item", "single", 8)
    study("collect", "single")
    check(tables("single") == expected, "items one by one: the same bytes")


def killed(expected):
    """At random moments, the whole study or one of its workers."""
    chance = random.Random(5)
    kills = 0
    while kills < 10:
        folder = pathlib.Path(f"killed_{kills}")
        while kills < 10:
            with start("run", "plan.toml", "-o", folder) as process:
                time.sleep(chance.uniform(0.05, 0.8))
                done = process.poll() is not None
                process.kill()
                _, message = process.communicate()
            if done:
                check(process.returncode == DONE, f"after kills: {message}")
                break
            kills += 1
        study("run", "plan.toml", "-o", folder)
        check(tables(folder) == expected, "after kills: the bytes of an undisturbed study")
        left = [name for name in files(folder) if name.endswith(".tmp")]
        check(not left, f"half-written files are removed: {left}")


def a_worker_that_crashes(expected):
    """It is recorded, the others go on, and the next run makes up for it."""
    with start("run", "plan.toml", "-o", "crash", "--workers", 1) as process:
        victim = None
        while victim is None and process.poll() is None:
            children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()
            victim = int(children[0]) if children else None
        os.kill(victim, signal.SIGSEGV)
        _, message = process.communicate()
    check(process.returncode == 3 and "ended by signal 11" in message and "1 of 8 items failed" in message, f"a crash: {message}")
    check(len({r["item"] for r in rows("crash/results.csv")}) == 7, "the others are whole")
    study("run", "plan.toml", "-o", "crash")
    check(tables("crash") == expected, "after a crash: the same bytes")


def two_at_once(expected):
    """Two studies in one folder share the items."""
    study("plan", "plan.toml", "-o", "two")
    both = [start("run", "plan.toml", "-o", "two", "--workers", 2) for _ in range(2)]
    for process in both:
        _, message = process.communicate()
        check(process.returncode == DONE, f"two at once: {message}")
    check(tables("two") == expected, "two at once: the same bytes")
    for log in pathlib.Path("two/items").glob("*/log.txt"):
        tested = re.findall(r"compaction 0\.02, tension, 1/D_t = 0:", log.read_text(encoding="utf-8"))
        check(len(tested) == 1, f"{log}: tested {len(tested)} times")


def on_a_queue(expected):
    """By an sbatch that takes Slurm's place: it runs the tasks of an array one after another, and then what depends on them."""
    os.mkdir("bin")
    pathlib.Path("bin/sbatch").write_text("""#!/bin/bash
echo "$@" >> "$QUEUE/calls"
script="${@: -1}"
if [[ $script == --wrap=* ]]; then bash -c "${script#--wrap=}" > "$QUEUE/collect.log" 2>&1; echo 12; exit; fi
tasks=$(sed -n 's/^#SBATCH --array=1-//p' "$script")
for task in $(seq "$tasks"); do SLURM_ARRAY_TASK_ID=$task bash "$script" >> "$QUEUE/task.log" 2>&1; done
echo "11;cluster"
""", encoding="utf-8")
    pathlib.Path("bin/scontrol").write_text("#!/bin/sh\necho 'MaxArraySize            = 1001'\n", encoding="utf-8")
    for name in ("sbatch", "scontrol"):
        os.chmod(f"bin/{name}", 0o755)
    os.mkdir("queue")
    environment = {**os.environ, "PATH": f"{os.getcwd()}/bin:{os.environ['PATH']}", "QUEUE": f"{os.getcwd()}/queue"}
    dry = strandlab("study", "run", "plan.toml", "-o", "queued", "--runner", "slurm", "--dry-run", env=environment)
    check(dry.returncode == DONE and "#SBATCH --array=1-1" in dry.stdout and "--dependency=afterany:JOB" in dry.stdout, f"dry run: {dry.stdout}")
    check(not os.path.exists("queued") and files("queue") == {}, "a dry run writes and submits nothing")
    submitted = strandlab("study", "run", "plan.toml", "-o", "queued", "--runner", "slurm", env=environment)
    check(submitted.returncode == DONE and "--dependency=afterany:11 " in submitted.stdout, f"submit: {submitted.stdout}{submitted.stderr}")
    check(tables("queued") == expected, "on a queue: the same bytes")
    again = strandlab("study", "run", "plan.toml", "-o", "queued", "--runner", "slurm", env=environment)
    check("nothing to submit" in again.stdout, f"nothing is left to submit: {again.stdout}")
    check(study("export", "queued").stdout == "", "nothing is left to export")
    if shutil.which("sbatch") is None:
        expect_bad_input(["study", "run", "plan.toml", "-o", "nowhere", "--runner", "slurm"], ["there is no sbatch on this machine"])


def told_to_stop(expected):
    """SIGUSR1, as a queue sends it before the limit, leaves what the next start goes on from."""
    study("plan", "plan.toml", "-o", "stopped")
    stops = 0
    for delay in (0.15, 0.3, 0.6):
        with start("item", "stopped", *range(1, 9)) as process:
            time.sleep(delay)
            if process.poll() is None:
                process.send_signal(signal.SIGUSR1)
                stops += 1
            process.communicate()
        check(process.returncode in (DONE, 3, -signal.SIGUSR1), f"SIGUSR1: exit code {process.returncode}")
    check(stops > 0, "no item was stopped")
    study("item", "stopped", *range(1, 9))
    study("collect", "stopped")
    check(tables("stopped") == expected, "after SIGUSR1: the same bytes")


def merged(expected):
    """Folders of two machines, copied into one."""
    for machine, speed in (("a", 8), ("b", 16)):
        text = re.sub(r"\[8, 16\]", f"[{speed}]", PLAN).split("[[contrasts]]", maxsplit=1)[0]
        pathlib.Path(f"{machine}.toml").write_text(text, encoding="utf-8")
        study("run", f"{machine}.toml", "-o", machine)
        for part in ("items", "pressings"):
            shutil.copytree(pathlib.Path(machine, part), pathlib.Path("merged", part), dirs_exist_ok=True)
    merge = study("run", "plan.toml", "-o", "merged")
    check("0 of 8 items to do" in merge.stdout, f"merged folders hold all results: {merge.stdout}")
    check(tables("merged") == expected, "merged: the same bytes")


def extended():
    more = PLAN.replace("replicates = 2", "replicates = 3").replace("[8, 16]", "[8, 16, 24]")
    pathlib.Path("more.toml").write_text(more, encoding="utf-8")
    extension = study("run", "more.toml", "-o", "whole")
    check("10 of 18 items to do" in extension.stdout, f"only new items run: {extension.stdout}")
    expect_bad_input(["study", "run", "plan.toml", "-o", "whole"], ["the study of another plan", "choose another folder with -o"])


def bad_input():
    pathlib.Path("bad.toml").write_text('base = "osb"\n[axes]\n"press.sped_m_s" = [4]\n', encoding="utf-8")
    expect_bad_input(["study", "plan", "bad.toml", "-o", "bad"], ["bad.toml:3: unknown key press.sped_m_s; did you mean speed_m_s?"])
    expect_bad_input(["study", "run", "nowhere.toml"], ["nowhere.toml: no such plan file"])
    expect_bad_input(["study", "item", "whole", "99"], ["whole: no item \"99\"; items are 1 to 18"])
    expect_bad_input(["study", "collect", "nowhere"], ["nowhere: holds no study"])
    expect_bad_input(["study", "run", "more.toml", "-o", "."], ["holds files but no study"])
    expect_bad_input(["study"], ["subcommand"])


def compared():
    for name, options in (("a1", ()), ("a2", ("--set", "run.seed=2")), ("b1", ("--set", "press.speed_m_s=8")),
                          ("b2", ("--set", "press.speed_m_s=8", "--set", "run.seed=2"))):
        check(strandlab("run", "small.toml", *options, "-o", name).returncode == DONE, f"run {name}")
    result = strandlab("compare", "a1", "b1", "a2", "b2", "--csv", "compare.csv")
    check(result.returncode == DONE and "small (press.speed_m_s = 16): 2 run(s)" in result.stdout, f"compare: {result.stdout}{result.stderr}")
    table = rows("compare.csv")
    check(len(table) == 24 and table[-1]["contrast"] == "small (press.speed_m_s = 8) - small (press.speed_m_s = 16)", "16 means, 8 differences")
    moduli = {name: {(r["compaction"], r["test"], r["compliance_t_mm_per_MPa"]): float(r["modulus_MPa"]) for r in rows(f"{name}/moduli.csv")}
              for name in ("a1", "a2", "b1", "b2")}
    for row in table[16:]:
        key = row["compaction"], row["test"], row["compliance_t_mm_per_MPa"]
        mean = (moduli["b1"][key] - moduli["a1"][key] + moduli["b2"][key] - moduli["a2"][key]) / 2
        check(abs(float(row["mean_MPa"]) - mean) < 1e-9, f"paired by seed: {row}")
    check(strandlab("compare", "a1", "--csv", "-").stdout.startswith("contrast,case,"), "--csv - prints the table")
    expect_bad_input(["compare", "a1", "b1", "a1"], ["a1 and a1 are the same panel (run.seed = 1)"])
    expect_bad_input(["compare", "a1", "whole"], ["whole: holds no strandlab run"])
    strandlab("press", "small.toml", "--set", "run.seed=3", "-o", "pressed")
    expect_bad_input(["compare", "a1", "pressed"], ["pressed: this run is not finished"])


with scratch():
    pathlib.Path("small.toml").write_text(CASE, encoding="utf-8")
    pathlib.Path("plan.toml").write_text(PLAN, encoding="utf-8")
    undisturbed = what_a_study_leaves()
    every_column_is_documented()
    once_again(undisturbed)
    item_by_item(undisturbed)
    killed(undisturbed)
    a_worker_that_crashes(undisturbed)
    two_at_once(undisturbed)
    on_a_queue(undisturbed)
    told_to_stop(undisturbed)
    merged(undisturbed)
    extended()
    bad_input()
    compared()
finish()
