"""strandlab bench as a script meets it: the keys that figures of different machines are compared by."""

import json

from program import DONE, check, expect_bad_input, finish, scratch, strandlab

KEYS = {"threads", "elastic_ns_per_particle_step", "press_ns_per_particle_step", "static_solve_s", "plastic_fraction",
        "fields_per_node", "fma_gflops", "triad_gb_s"}


def bench():
    result = strandlab("bench", "--json", "--threads", "1", "--repeats", "1")
    check(result.returncode == DONE, f"bench: {result.stderr}")
    (figures,) = json.loads(result.stdout)
    check(KEYS <= set(figures), f"keys of bench --json: {sorted(figures)}")
    check(figures["threads"] == 1, "threads")
    for key in KEYS - {"threads"}:
        check(figures[key] > 0, f"{key} = {figures[key]}")
    check(.3 < figures["plastic_fraction"] < .9, "most of the mat yields in mid-press")
    check(1 < figures["fields_per_node"] < 3, "fields per node")
    # 16 times what two cores of 2026 take, a hundredth of what codes of the field do: something broke, not a slow machine.
    check(figures["elastic_ns_per_particle_step"] < 600, "elastic steps are fast")
    check(figures["peak_memory_mb"] < 1000, "memory")
    expect_bad_input(["bench", "--repeats", "0"], ["--repeats"])


with scratch():
    bench()
finish()
