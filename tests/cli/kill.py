"""Kills runs with SIGKILL, at random moments and when chosen files appear, starts them again until they are done, and compares
every file with those of an undisturbed run: kill.py PROGRAM [--kills 20] [--seed 1] [--result FILE]"""

import argparse
import collections
import contextlib
import json
import pathlib
import random
import subprocess
import sys
import time

from program import DONE, PROGRAM, SMALL_CASE, check, finish, scratch, strandlab

CASE = SMALL_CASE + """[run]
checkpoint_interval_s = 0.02
"""

# Files in the order of a run; a kill as soon as one appears or changes meets the work on it, or what follows at once.
CHOSEN = ("run.json.tmp", "run.json", "case.toml.tmp", "mat.json.tmp", "mat.json", "press.csv.tmp", "checkpoint.h5.tmp", "checkpoint.h5",
          "checkpoint.previous.h5", "panels/panel_0.02.h5.tmp", "panels/panel_0.02.h5", "paraview/panel_0.02.vtu",
          "frames/frame_20.h5.tmp", "frames/frame_20.h5", "paraview/panel.pvd", "pictures/grain_angle_0.04.png", "pictures/stress.png",
          "profile.csv", "glue_lines/slip_0.02.csv", "moduli.csv.tmp", "moduli.csv", "theory.csv", "plots/tension_against_compaction.png",
          "report.html.tmp", "report.html")

# Members of run.json that tell when, where and how fast, not what came out. Counts per step are of the last start.
OF_THE_MOMENT = ("date", "machine", "wall_s", "particle_steps_per_s", "ns_per_particle_step", "ns_per_particle_step_by_phase",
                 "assemble_s", "analyse_s", "factor_s", "solve_s", "fields_per_node", "plastic_fraction", "engine_bytes", "started")
# The log names each start. The older checkpoint is of a moment that the clock chose.
NOT_RESULTS = ("log.txt", "checkpoint.previous.h5")


def lasting(value):
    if isinstance(value, dict):
        return {key: lasting(item) for key, item in value.items() if key not in OF_THE_MOMENT}
    return [lasting(item) for item in value] if isinstance(value, list) else value


def page_data(text):
    begin = text.index('<script type="application/json" id="data">') + len('<script type="application/json" id="data">')
    return json.loads(text[begin:text.index("</script>", begin)])


def results(folder):
    """Every file of a run folder by name, as what must not depend on kills."""
    kept = {}
    for path in sorted(pathlib.Path(folder).rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_dir() or name in NOT_RESULTS:
            continue
        kept[name] = path.read_bytes()
        if name == "run.json":
            kept[name] = lasting(json.loads(kept[name]))
        if name == "report.html":
            kept[name] = lasting(page_data(kept[name].decode("utf-8")))
    return kept


def state(path):
    """Changes whenever a file takes the name; "NAME.tmp" stands for any temporary file of NAME."""
    stem, _, ending = path.name.rpartition(".")
    names = path.parent.glob(f"{stem}.*tmp") if ending == "tmp" else [path]
    found = set()
    for name in names:
        with contextlib.suppress(FileNotFoundError):
            status = name.stat()
            found.add((status.st_ino, status.st_mtime_ns))
    return found


def start(folder):
    return subprocess.Popen([PROGRAM, "run", "a.toml", "-o", folder], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def wait_for(process, path):
    """Until the file appears or is replaced, or the run ends."""
    before = state(path)
    while process.poll() is None:
        now = state(path)
        if now - before:
            return
        time.sleep(0.0002)


class Count:
    """What was done, for the result."""

    def __init__(self):
        self.random_moments, self.runs, self.different = 0, 0, 0
        self.files = collections.Counter()

    def kills(self):
        return self.random_moments + sum(self.files.values())


def live(folder, kills, chance, whole_s, count):
    """Starts a run again and again, killing each start, until one is done (or the kills are)."""
    while count.kills() < kills:
        chosen = chance.choice(CHOSEN) if chance.random() < 0.5 else None
        with start(folder) as process:
            if chosen:
                wait_for(process, folder / chosen)
            else:
                time.sleep(chance.uniform(0, 0.4 * whole_s))  # what was done is not done again: several kills to a run
            done = process.poll() is not None
            process.kill()
            _, message = process.communicate()
        if done:
            check(process.returncode == DONE, f"a run after kills ended with exit code {process.returncode}: {message}")
            return
        if chosen:
            count.files[chosen] += 1
        else:
            count.random_moments += 1
    result = strandlab("run", "a.toml", "-o", folder)
    check(result.returncode == DONE, f"a run after kills ended with exit code {result.returncode}: {result.stderr}")


def compare(folder, undisturbed, count):
    found = results(folder)
    different = sorted(name for name in set(found) | set(undisturbed) if found.get(name) != undisturbed.get(name))
    count.runs += 1
    count.different += bool(different)
    check(not different, f"files that differ from an undisturbed run's after kills: {', '.join(different)}")


def write_result(file, count, seed):
    result = {"kills": count.kills(), "at_random_moments": count.random_moments, "at_files": dict(sorted(count.files.items())),
              "runs": count.runs, "runs_that_differ": count.different, "seed": seed, "date": time.strftime("%Y-%m-%d", time.gmtime()),
              "commit": strandlab("--version").stdout.split("(")[-1].rstrip(")\n")}
    pathlib.Path(file).write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--result", type=pathlib.Path, help="file for the counts, which scripts/verification reads")
    arguments = parser.parse_args()
    result_file = arguments.result.resolve() if arguments.result else None
    chance, count = random.Random(arguments.seed), Count()
    with scratch() as folder:
        pathlib.Path("a.toml").write_text(CASE, encoding="utf-8")
        begin = time.monotonic()
        whole = strandlab("run", "a.toml", "-o", "whole")
        check(whole.returncode == DONE, f"the undisturbed run: {whole.stderr}")
        whole_s, undisturbed = time.monotonic() - begin, results("whole")
        while count.kills() < arguments.kills:
            life = folder / f"run_{count.runs}"
            live(life, arguments.kills, chance, whole_s, count)
            compare(life, undisturbed, count)
            if result_file:  # each time: a long test that is stopped keeps its counts
                write_result(result_file, count, arguments.seed)
            if sys.stdout.isatty():
                print(f"\r{count.kills()} kills, {count.runs} runs", end="", flush=True)
    print(f"{count.kills()} kills, {count.random_moments} at random moments and {sum(count.files.values())} at {len(count.files)} files, "
          f"over {count.runs} runs: {count.different} ended with other files than an undisturbed run")
    finish()


main()
