"""docs/files.md says what every table holds: each column that the program writes stands there, and tables can be joined."""

import csv
import pathlib
import re

from program import SOURCE, DONE, NO_PICTURES, SMALL_CASE, check, finish, scratch, strandlab

# "grain_angle_mean_deg, _sd_deg, _lowest_deg" in the text stands for columns that begin alike.
SHORTENED = {"grain_angle_": ("mean_deg", "sd_deg", "lowest_deg", "highest_deg"),
             "strand_thickness_strain_": ("mean", "sd", "lowest", "highest")}
# Columns of the example table itself, kept beside the results (docs/bondline.md).
KEPT = {"resin", "strands", "coverage_percent"}


def documented():
    words = set(re.findall(r"[A-Za-z0-9_]+", (SOURCE / "docs" / "files.md").read_text(encoding="utf-8")))
    for stem, endings in SHORTENED.items():
        check(stem + endings[0] in words and all("_" + e in words for e in endings[1:]), f"docs/files.md: {stem}...")
        words.update(stem + ending for ending in endings)
    return words


def header(file):
    with open(file, encoding="utf-8") as text:
        return next(csv.reader(text))


def every_column_is_documented():
    words = documented()
    tables = sorted(pathlib.Path().rglob("*.csv"))
    check(len(tables) > 15, f"tables written: {len(tables)}")
    for table in tables:
        for column in header(table):
            check(column in words or column in KEPT, f"docs/files.md does not explain {column} of {table}")


def a_state_has_one_name():
    """Tables of kept states say the compaction asked for, digit by digit; what was reached is in morphology.csv, once."""
    states = {}
    for name in ("moduli.csv", "theory.csv", "morphology.csv", "histograms.csv", "profile.csv", "profile_summary.csv"):
        with open(pathlib.Path("out", name), encoding="utf-8") as text:
            states[name] = {row["compaction"] for row in csv.DictReader(text)}
    check(all(s == {"0", "0.02", "0.04"} for s in states.values()), f"compactions: {states}")
    with open("out/morphology.csv", encoding="utf-8") as text:
        reached = [float(row["compaction_reached"]) for row in csv.DictReader(text)]
    check(all(0 <= r - c < 1e-3 for r, c in zip(reached, (0, 0.02, 0.04))) and reached[2] != 0.04, f"reached: {reached}")


if __name__ == "__main__":
    with scratch():
        pathlib.Path("a.toml").write_text(SMALL_CASE + NO_PICTURES, encoding="utf-8")
        check(strandlab("run", "a.toml", "-o", "out").returncode == DONE, "run")
        densitometer = SOURCE / "tests" / "data" / "profile" / "densitometer.csv"
        profile = strandlab("profile", "out", "-o", "profile", "--measured", densitometer)
        check(profile.returncode == DONE, f"profile: {profile.stderr}")
        pathlib.Path("dls.csv").write_text(strandlab("bondline", "--example").stdout, encoding="utf-8")
        check(strandlab("bondline", "dls.csv", "-o", "lines").returncode == DONE, "bondline")
        pathlib.Path("dls.csv").unlink()
        every_column_is_documented()
        a_state_has_one_name()
    finish()
