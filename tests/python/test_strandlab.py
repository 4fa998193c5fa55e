"""strandlab from Python: python3 tests/python/test_strandlab.py PROGRAM, with the module in PYTHONPATH.

Nothing here checks physics anew: the same library gave the program's results, which must be the same bits here.
"""

import ast
import copy
import gc
import json
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import strandlab

PROGRAM = sys.argv.pop(1)

SMALL = {"mat.length_mm": 12, "mat.rows": ["surface", "core*2", "surface"], "kinds.core.gap_mm": 1, "kinds.core.gap_sd_mm": 0.2,
         "press.speed_m_s": 64, "press.compactions": [0, 0.1], "run.threads": 1, "glue.compliance_t_mm_per_MPa": [0, 0.05]}


HOT = SMALL | {"press.densities_kg_m3": [400], "hotpress.cells": 10, "press.speed_m_s": 32,
               "hotpress.schedule": ["close to 400 kg/m3 in 2 s", "hold until 10 s", "vent 2 s", "open 3 s"]}
HOT.pop("press.compactions")

# Two rows of 5 mm: a tenth of a second of work.
TINY = {"mat.length_mm": 5, "mat.rows": ["surface", "core"], "kinds.core.length_mm": 2, "kinds.core.length_sd_mm": 0.2, "kinds.core.gap_mm": 1,
        "kinds.core.gap_sd_mm": 0.2, "press.compactions": [0, 0.02], "run.threads": 1, "glue.compliance_t_mm_per_MPa": [0, 0.0105]}


def small():
    return strandlab.Case.ready("osb").changed(SMALL)


def tiny():
    return strandlab.Case.ready("osb").changed(TINY)


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=True).stdout


class without:  # noqa: N801  a block of code in which a package is not installed
    def __init__(self, package):
        self.package = package

    def __enter__(self):
        self.before = sys.modules.get(self.package)
        sys.modules[self.package] = None  # import raises ImportError

    def __exit__(self, *_):
        del sys.modules[self.package]
        if self.before is not None:
            sys.modules[self.package] = self.before


def interrupted_after(work, delay_s):
    """Seconds from Ctrl-C, which comes delay_s after the start of work(), to KeyboardInterrupt; None where work() ended before."""
    signalled = []

    def interrupt():
        signalled.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)
    timer = threading.Timer(delay_s, interrupt)
    timer.start()
    try:
        work()
    except KeyboardInterrupt:
        return time.monotonic() - signalled[0]
    finally:
        timer.cancel()
        timer.join()
    return None


class Cases(unittest.TestCase):
    def test_keys_read_back_by_path_and_as_attributes(self):
        case = strandlab.Case()
        case.press.speed_m_s = 8
        case["kinds.core.angle_deg"] = np.float64(45)
        self.assertEqual((case["press.speed_m_s"], case.press.speed_m_s), (8.0, 8.0))
        self.assertEqual((case.kinds.core.angle_deg, case.kinds["core"].angle_deg), (45.0, 45.0))
        self.assertIn("speed_m_s", dir(case.press))
        self.assertIn("greater than 0", case.help("press.speed_m_s"))

    def test_every_key_takes_its_own_value(self):
        case = strandlab.Case.ready("hot_osb")
        text = case.to_toml()
        for path in case.keys():
            value = case[path]
            if value == []:
                continue  # not given
            case[path] = value
            self.assertEqual(case.to_toml(), text, path)

    def test_texts_with_any_characters_are_kept(self):
        case = strandlab.Case()
        for name in ('/a "b"\\c\n\t', "/\x7f\x01é漢𝄞"):
            case.mat.file = name
            self.assertEqual(case.mat.file, name)

    def test_a_case_is_refused_whole_and_stays_as_it_was(self):
        case = strandlab.Case()
        before = case.to_toml()
        with self.assertRaisesRegex(strandlab.InputError, "press.speed_m_s = -1 m/s: must be greater than 0"):
            case.update({"mat.length_mm": 50, "press.speed_m_s": -1})
        with self.assertRaisesRegex(strandlab.InputError, "unknown key press.sped; did you mean press"):
            case["press.sped"] = 3
        with self.assertRaisesRegex(AttributeError, "no key press.sped; did you mean press"):
            case.press.sped
        with self.assertRaisesRegex(TypeError, "not type"):
            case["press.speed_m_s"] = object
        with self.assertRaises(AttributeError):
            case.pres = 3
        self.assertEqual(case.to_toml(), before)

    def test_one_measure_of_states_takes_the_place_of_another(self):
        case = strandlab.Case()
        case.press.thicknesses_mm = [14, 12]
        self.assertEqual((case.press.thicknesses_mm, case.press.densities_kg_m3), ([14.0, 12.0], []))
        case.press.compactions = [0, 0.2]
        self.assertEqual((case.press.compactions, case.press.thicknesses_mm), ([0.0, 0.2], []))

    def test_copies_are_cases_of_their_own(self):
        case = small()
        for other in (case.copy(), copy.deepcopy(case), pickle.loads(pickle.dumps(case)), strandlab.Case.from_toml(case.to_toml())):
            self.assertEqual(other, case)
            other.run.seed = 9
            self.assertNotEqual(other, case)
            self.assertEqual(case.run.seed, 1)

    def test_ready_cases_are_those_of_the_program(self):
        # cases/NAME.toml is what the program prints (tests/cli/ready_cases.py).
        files = sorted((pathlib.Path(__file__).parents[2] / "cases").glob("*.toml"))
        self.assertEqual([file.stem for file in files], sorted(strandlab.ready_cases()))
        for file in files:
            self.assertEqual(strandlab.Case.read(file), strandlab.Case.ready(file.stem), file.stem)

    def test_glue_comes_from_a_table_of_lap_shear_tests(self):
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder, "dls.csv")
            table.write_text(strandlab.bondline_example())
            lines = strandlab.bondline(table)
            group, compliance = list(lines.groups["group"])[0], list(lines.groups["compliance_t_mm_per_MPa"])[0]
            lines.write(pathlib.Path(folder, "dls.json"))
            case = strandlab.Case()
            case.update({"glue.from_bondline": pathlib.Path(folder, "dls.json"), "glue.group": group})
            self.assertAlmostEqual(case.glue.compliance_t_mm_per_MPa[0], compliance, delta=1e-12 * compliance)
            case.press.speed_m_s = 8  # the number stays, and does not contradict its source
            self.assertEqual(len(case.glue.compliance_t_mm_per_MPa), 1)


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.here = os.listdir(".")
        cls.result = strandlab.run(small())

    def test_moduli_have_the_columns_and_bits_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "small.toml")
            file.write_text(small().to_toml())
            program("run", file, "-o", f"{folder}/run")
            run = strandlab.open_run(f"{folder}/run")
            for name in ("moduli", "press"):
                ours, theirs = getattr(self.result, name), getattr(run, name)
                self.assertEqual(list(ours), list(theirs))
                for column in ours:
                    np.testing.assert_array_equal(np.asarray(ours[column]), np.asarray(theirs[column]), err_msg=f"{name}, {column}")
            for ours, theirs in zip(self.result.panels, run.panels, strict=True):
                self.assertEqual(ours.compaction, theirs.compaction)
                for a, b in zip(ours, theirs, strict=True):
                    for field in a.fields:
                        np.testing.assert_array_equal(a[field], b[field])
            np.testing.assert_array_equal(strandlab.test(run.panels[-1]).moduli["modulus_MPa"],
                                          strandlab.test(self.result.panels[-1]).moduli["modulus_MPa"])
            self.assertEqual(run.case, small())
            with self.assertRaisesRegex(strandlab.InputError, "no table modul; there are .*moduli"):
                run.table("modul")
            with without("pandas"):
                plain = run.moduli
            self.assertEqual(type(plain), dict)
            self.assertEqual((list(plain), list(plain["test"])), (list(run.moduli), list(run.moduli["test"])))
            np.testing.assert_array_equal(plain["modulus_MPa"], run.moduli["modulus_MPa"])

    def test_a_hot_pressing_has_the_bits_of_the_program(self):
        hot = strandlab.Case.ready("hot_osb").changed(HOT)
        ours = strandlab.run(hot)
        self.assertIn("cured to", " ".join(ours.warnings))  # it was pressed hot
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "hot.toml")
            file.write_text(hot.to_toml())
            program("press", file, "-o", f"{folder}/run")
            theirs = strandlab.open_run(f"{folder}/run").panels
        self.assertEqual(len(ours.panels), len(theirs))
        for a, b in zip(ours.panels[-1], theirs[-1], strict=True):
            for field in a.fields:
                np.testing.assert_array_equal(a[field], b[field], err_msg=field)

    def test_nothing_is_written_in_memory(self):
        def written():  # bytes that this process has handed to write() so far, to whatever file
            return int(re.search(r"wchar: (\d+)", pathlib.Path("/proc/self/io").read_text())[1])
        before = written()
        strandlab.run(tiny())
        strandlab.theory(tiny())
        self.assertEqual(written(), before)
        self.assertEqual(os.listdir("."), self.here)

    def test_a_run_in_a_folder_is_the_programs(self):
        with tempfile.TemporaryDirectory() as folder:
            run = strandlab.run(tiny(), folder=f"{folder}/run")
            self.assertTrue((run.folder / "report.html").is_file())
            np.testing.assert_array_equal(run.moduli["modulus_MPa"], strandlab.run(tiny()).moduli["modulus_MPa"])
            with self.assertRaisesRegex(strandlab.InputError, "another case"):
                strandlab.run(tiny().changed({"run.seed": 2}), folder=f"{folder}/run")

    def test_fields_are_read_only_views_that_outlive_their_panel(self):
        panel = strandlab.form(small()).panel
        strand = panel.strands[0]
        shapes = {"position_mm": (2,), "velocity_mm_s": (2,), "deformation_gradient": (2, 2), "kirchhoff_stress_MPa": (6,), "plastic_strain": ()}
        self.assertEqual({name: array.shape[1:] for name, array in strand.fields.items()}, shapes)
        views, copies = strand.fields, {}
        for name, view in views.items():
            self.assertEqual(len(view), len(strand), name)
            self.assertFalse(view.flags.owndata or view.flags.writeable, name)
            again = panel._core.strands[0].fields[name]  # asked of the library once more
            self.assertEqual(again.__array_interface__["data"], view.__array_interface__["data"], name)
            with self.assertRaises(ValueError):
                view.setflags(write=True)
            copies[name] = view.copy()
        del panel, strand
        gc.collect()
        for name, view in views.items():
            np.testing.assert_array_equal(view, copies[name], err_msg=name)

    def test_what_must_be_copied_is_copied_once_and_read_only(self):
        panel = strandlab.form(small()).panel
        strand = panel.strands[0]
        for get in (strand.corners_mm, strand.cells, lambda: panel["position_mm"], lambda: panel.fields["plastic_strain"]):
            array = get()
            self.assertIs(get(), array)
            with self.assertRaises(ValueError):
                array[0] = 0

    def test_the_mesh_is_that_of_the_points(self):
        strand = self.result.panels[-1].strands[0]
        middles = strand.corners_mm()[strand.cells()].mean(axis=1)
        # Corners are means of what the adjacent points say, so a cell's middle is near its point: .0018 of a spacing was measured.
        self.assertLess(np.abs(middles - strand["position_mm"]).max(), 0.01 * min(strand.spacing_mm))

    def test_the_deformation_gradient_is_not_transposed(self):
        # A row of points along a strand: dx/ds is the first column of F. 2e-8 was measured, and 4e-4 with the first row in its place.
        strand = self.result.panels[-1].strands[0]
        n = strand.counts[0]
        along = np.diff(strand["position_mm"][:n], axis=0) / strand.spacing_mm[0]
        column = strand["deformation_gradient"][:n, :, 0]
        self.assertLess(np.abs(along - 0.5 * (column[1:] + column[:-1])).max(), 2e-7)
        row = strand["deformation_gradient"][:n, 0, :]
        self.assertGreater(np.abs(along - 0.5 * (row[1:] + row[:-1])).max(), 2e-5)

    def test_mass_of_the_density_profile_is_that_of_the_mat(self):
        profile = strandlab.profile(self.result.panels[-1])
        mean = np.mean(profile["density_kg_m3"])
        self.assertAlmostEqual(mean * 1e-3 * self.result.panels[-1].thickness_mm, self.result.mat.kg_per_m2, delta=1e-13)

    def test_other_glue_needs_no_new_pressing(self):
        stiff = strandlab.test(self.result.panels[-1], small().changed({"glue.compliance_t_mm_per_MPa": [0]})).moduli
        both = self.result.moduli
        self.assertEqual(len(stiff["modulus_MPa"]), 2)
        self.assertEqual(list(stiff["modulus_MPa"]), list(both["modulus_MPa"])[4:6])

    def test_states_and_progress_are_told_and_errors_pass_through(self):
        states, steps = [], []
        slow = small().changed({"press.speed_m_s": 2})  # long enough to be told of
        strandlab.press(slow, on_progress=lambda step, fraction, detail: steps.append(step), on_state=states.append)
        self.assertEqual([panel.compaction for panel in states], [0, 0.1])
        self.assertEqual(set(steps), {"press"})

        def stop(panel):
            raise KeyError("enough")
        with self.assertRaisesRegex(KeyError, "enough"):
            strandlab.press(small(), on_state=stop)

    def test_other_threads_run_during_long_calls(self):
        panel = strandlab.form(strandlab.Case.ready("osb").changed({"mat.length_mm": 20})).panel
        hot = strandlab.Case.ready("hot_osb")
        for name, work in (("press", lambda: strandlab.press(small().changed({"press.speed_m_s": 4}))),
                           ("test", lambda: strandlab.test(panel)), ("hotpress", lambda: strandlab.hotpress(hot))):
            turns, done = [0], threading.Event()

            def turn(turns=turns, done=done):
                while not done.wait(0.001):
                    turns[0] += 1
            other = threading.Thread(target=turn)
            other.start()
            before = turns[0]
            work()
            after = turns[0]
            done.set()
            other.join()
            self.assertGreater(after - before, 10, name)  # a lock that is held to the end leaves one turn; 700 in hotpress were measured

    def test_ctrl_c_ends_a_pressing_within_a_second(self):
        case = small().changed({"press.speed_m_s": 0.05, "run.threads": 2})  # minutes long
        self.assertLess(interrupted_after(lambda: strandlab.press(case), 0.5), 1)

    def test_ctrl_c_ends_the_tests_of_a_panel_within_a_second(self):
        panel = strandlab.form(strandlab.Case.ready("osb").changed({"mat.length_mm": 60})).panel  # 1.7 s of tests
        self.assertLess(interrupted_after(lambda: strandlab.test(panel), 0.3), 1)  # 0.05 s was measured

    def test_ctrl_c_ends_a_hot_press_cycle_within_a_second(self):
        case = strandlab.Case.ready("hot_osb").changed({"hotpress.cells": 400, "hotpress.step_s": 0.01})  # a minute long
        self.assertLess(interrupted_after(lambda: strandlab.hotpress(case), 0.5), 1)

    def test_hot_press_and_tests_tell_how_far_they_are(self):
        told = []
        strandlab.hotpress(strandlab.Case.ready("hot_osb"), on_progress=lambda *progress: told.append(progress))
        fractions = [fraction for _, fraction, _ in told]
        self.assertEqual({step for step, _, _ in told}, {"hotpress"})
        self.assertEqual(fractions, sorted(fractions))
        self.assertGreater(fractions[-1], 0.99)
        told.clear()
        panels = self.result.panels
        strandlab.test(panels, on_progress=lambda *progress: told.append(progress))
        self.assertEqual([(step, fraction) for step, fraction, _ in told], [("test", k / len(panels)) for k in range(len(panels) + 1)])

        def stop(*progress):
            raise KeyError("enough")
        for work in (lambda: strandlab.hotpress(strandlab.Case.ready("hot_osb"), on_progress=stop),
                     lambda: strandlab.test(panels, on_progress=stop)):
            with self.assertRaisesRegex(KeyError, "enough"):
                work()

    def test_glue_points_lie_between_their_strands(self):
        panel = self.result.panels[-1]
        points = strandlab.cure(panel)
        rows = np.array([strand.row for strand in panel])
        self.assertTrue((np.abs(rows[np.asarray(points["strand_a"])] - rows[np.asarray(points["strand_b"])]) >= 1).all())
        self.assertLessEqual(np.asarray(points["gap_mm"]).max(), small().glue.max_gap_mm)

    def test_answers_without_a_pressing(self):
        hot = strandlab.hotpress(strandlab.Case.ready("hot_osb"))
        self.assertEqual(list(hot.record)[0], "time_s")
        self.assertGreater(hot.answers["pressure_peak_MPa"], 0)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "case.toml")
            file.write_text(small().to_toml())
            printed = program("theory", file, "--csv", "-")
            self.assertEqual(len(strandlab.theory(small())["modulus_MPa"]), len(printed.splitlines()) - 1)

    def test_a_panel_draws_itself(self):
        import matplotlib
        matplotlib.use("Agg")
        panel = self.result.panels[-1]
        self.assertIn("data:image/png", panel._repr_html_())
        ax = panel.plot("plastic_strain")
        np.testing.assert_array_equal(ax.collections[0].get_array(), panel["plastic_strain"])
        with tempfile.TemporaryDirectory() as folder:
            panel.to_vtk(f"{folder}/panel.vtu")
            self.assertIn(f'NumberOfCells="{panel.points}"', pathlib.Path(folder, "panel.vtu").read_bytes()[:2000].decode("latin-1"))

    def test_fields_of_a_panel_are_those_of_its_strands_in_turn(self):
        panel = self.result.panels[-1]
        self.assertEqual(set(panel.fields), set(panel.strands[0].fields))
        self.assertEqual(panel["deformation_gradient"].shape, (panel.points, 2, 2))
        first, second = panel.strands[:2]
        np.testing.assert_array_equal(panel["position_mm"][len(first):len(first) + len(second)], second["position_mm"])
        with self.assertRaisesRegex(KeyError, "plastic_strain"):
            panel["plastic"]

    def test_a_failed_pressing_is_a_run_error_and_a_bad_case_an_input_error(self):
        with self.assertRaises(strandlab.InputError):
            strandlab.form(small().changed({"mat.file": "/nowhere/mat.json"}))
        with self.assertRaises(strandlab.InputError):
            strandlab.open_run("/nowhere")
        self.assertTrue(issubclass(strandlab.InputError, ValueError))
        self.assertTrue(issubclass(strandlab.RunError, RuntimeError))


class Plates(unittest.TestCase):
    def test_a_plate_has_the_bits_of_the_program(self):
        file = pathlib.Path(__file__).parents[1] / "data" / "mats3d" / "per_a.json"
        case = strandlab.Case.ready("osb").changed({"mat.file": file, "press.compactions": [0], "test.element_length_mm": 4,
                                                    "test.elements_through_strand": 1, "glue.compliance_t_mm_per_MPa": [0.0105]})
        plate = strandlab.plate(case)
        tested = plate.test()
        self.assertEqual(len(plate.strands["kind"]), len(set(plate.strands["strand"])))
        with tempfile.TemporaryDirectory() as folder:
            theirs = strandlab.run(case, folder=f"{folder}/plate")
            for ours, name in ((tested.moduli, "moduli"), (tested.abd, "abd")):
                self.assertGreater(len(ours["compliance_t_mm_per_MPa"]), 0)
                for column in theirs.table(name):
                    np.testing.assert_array_equal(np.asarray(ours[column]), np.asarray(theirs.table(name)[column]), err_msg=column)
        with self.assertRaisesRegex(strandlab.InputError, "a mat in 3D"):
            strandlab.form(case)

    def test_a_plate_pressed_from_python_has_the_files_of_the_program(self):
        mat = {"dim": 3, "length_mm": 12, "width_mm": 12, "layer_thickness_mm": 0.8, "sides": "periodic", "layers": [
            {"role": role, "strands": [{"cx": place, "cy": place, "length": 9, "width": 9, "angle_deg": angle}]}
            for role, place, angle in (("surface", 6, 10), ("core", 0, 80))]}
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "mat.json")
            file.write_text(json.dumps(mat), encoding="utf-8")
            case = strandlab.Case.ready("osb").changed({
                "mat.file": file, "press.compactions": [0, 0.2], "press.speed_m_s": 32, "grid.cells_through_strand": 1, "grid.cell_aspect": 4,
                "test.element_length_mm": 4, "test.elements_through_strand": 1, "glue.compliance_t_mm_per_MPa": [0.0105]})
            pathlib.Path(folder, "case.toml").write_text(case.to_toml(), encoding="utf-8")
            strandlab.run(case, folder=f"{folder}/ours")
            program("run", f"{folder}/case.toml", "-o", f"{folder}/theirs")
            for name in ("press.csv", "moduli.csv", "abd.csv", "density_map.csv"):
                self.assertEqual(*(pathlib.Path(folder, whose, name).read_bytes() for whose in ("ours", "theirs")), name)


class Studies(unittest.TestCase):
    PLAN = {"base": "osb", "replicates": 2, "set": TINY, "axes": {"press.speed_m_s": {"from": 8, "to": 16, "count": 2}},
            "contrasts": [{"key": "press.speed_m_s", "value": 16, "against": 8}]}

    def test_a_study_is_the_programs(self):
        told = []
        with tempfile.TemporaryDirectory() as folder:
            study = strandlab.study(self.PLAN, f"{folder}/ours", on_progress=lambda *progress: told.append(progress))
            program("study", "run", study.folder / "plan.toml", "-o", f"{folder}/theirs")
            for name in ("plan", "results", "summary", "effects", "profiles", "press"):
                self.assertEqual(*(pathlib.Path(folder, whose, f"{name}.csv").read_bytes() for whose in ("ours", "theirs")), name)
                self.assertGreater(len(getattr(study, name)), 0)
            self.assertEqual(len(study.plan["item"]), 4)
            self.assertEqual(told[-1][0], "study")
            again = strandlab.study(study.folder / "plan.toml", study.folder)  # nothing is left to do
            np.testing.assert_array_equal(again.results["modulus_MPa"], strandlab.open_study(study.folder).results["modulus_MPa"])
            with self.assertRaisesRegex(strandlab.InputError, "no table result; there are .*results"):
                study.table("result")

    def test_the_base_may_be_a_case(self):
        with tempfile.TemporaryDirectory() as folder:
            study = strandlab.study({"base": tiny()}, folder + "/one")
            np.testing.assert_array_equal(study.results["modulus_MPa"], strandlab.run(tiny()).moduli["modulus_MPa"])

    def test_what_is_wrong_with_a_plan_is_said_here(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(strandlab.InputError, r"plan.toml:4: .*unknown key press.sped; did you mean press"):
                strandlab.study({"base": "osb", "axes": {"press.sped": [1]}}, f"{folder}/a")
            with self.assertRaisesRegex(strandlab.InputError, "needs a folder"):
                strandlab.study(self.PLAN)
            with self.assertRaisesRegex(strandlab.InputError, "holds no study"):
                strandlab.open_study(folder)
            self.assertEqual(os.listdir(folder), [])

    def test_ctrl_c_ends_a_study_and_its_workers_within_a_second(self):
        with tempfile.TemporaryDirectory() as folder:
            slow = {key: value for key, value in SMALL.items() if key != "press.speed_m_s"}
            plan = {"base": "osb", "set": slow, "axes": {"press.speed_m_s": [0.05, 0.06]}}  # minutes long
            seen = threading.Event()
            pid, interrupted = os.getpid(), []

            def interrupt():
                seen.wait(60)
                interrupted.append(time.monotonic())
                os.kill(pid, signal.SIGINT)
            thread = threading.Thread(target=interrupt, daemon=True)
            thread.start()
            try:
                strandlab.study(plan, f"{folder}/study", on_progress=lambda step, *_: seen.set() if step == "study" else None)
                took = None
            except KeyboardInterrupt:
                took = time.monotonic() - interrupted[0]
            thread.join()
            self.assertLess(took, 1)
            time.sleep(0.2)  # the workers are told by the system
            for process in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
                try:
                    self.assertNotIn(folder.encode(), process.read_bytes())
                except OSError:
                    pass  # it has ended


class Packaging(unittest.TestCase):
    def test_pip_and_cmake_agree(self):
        import tomllib
        tree = pathlib.Path(__file__).parents[2]
        project = tomllib.loads((tree / "pyproject.toml").read_text())
        version = project["tool"]["scikit-build"]["metadata"]["version"]
        found = re.search(version["regex"], (tree / version["input"]).read_text())
        self.assertEqual(found["value"], strandlab.__version__)
        cmake = (tree / "python" / "CMakeLists.txt").read_text()
        for target in project["tool"]["scikit-build"]["build"]["targets"]:
            self.assertIn(f"pybind11_add_module({target} ", cmake)
        for component in project["tool"]["scikit-build"]["install"]["components"]:
            self.assertIn(f"COMPONENT {component})", cmake)


class Types(unittest.TestCase):
    def test_the_stubs_name_what_the_module_has(self):
        stub = ast.parse((pathlib.Path(strandlab.__file__).parent / "_core.pyi").read_text())

        def names(body):
            for node in body:
                if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                    yield node.name
                elif isinstance(node, ast.AnnAssign):
                    yield node.target.id
        core = strandlab._core

        def public(thing):
            return {name for name in vars(thing) if not name.startswith("_")}
        self.assertEqual({name for name in names(stub.body) if not name.startswith("_")}, public(core))
        for node in stub.body:
            if isinstance(node, ast.ClassDef) and node.name not in ("InputError", "RunError"):
                ours = {name for name in names(node.body) if not name.startswith("_")}
                self.assertEqual(ours, public(getattr(core, node.name)), node.name)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)
    unittest.main()
