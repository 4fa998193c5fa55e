"""strandlab from Python: python3 tests/python/test_strandlab.py PROGRAM, with the module in PYTHONPATH.

Nothing here checks physics anew: the same library gave the program's results, which must be the same bits here.
"""

import copy
import gc
import os
import pathlib
import pickle
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


def small():
    case = strandlab.Case.ready("osb")
    case.update(SMALL)
    return case


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
        for name in strandlab.ready_cases():
            printed = subprocess.run([PROGRAM, "init", name], capture_output=True, text=True, check=True).stdout
            self.assertEqual(strandlab.Case.from_toml(printed), strandlab.Case.ready(name), name)

    def test_glue_comes_from_a_table_of_lap_shear_tests(self):
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder, "dls.csv")
            table.write_text(subprocess.run([PROGRAM, "bondline", "--example"], capture_output=True, text=True, check=True).stdout)
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
            subprocess.run([PROGRAM, "run", file, "-o", f"{folder}/run"], check=True, capture_output=True)
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

    def test_nothing_is_written_in_memory(self):
        self.assertEqual(os.listdir("."), self.here)

    def test_a_run_in_a_folder_is_the_programs(self):
        with tempfile.TemporaryDirectory() as folder:
            run = strandlab.run(small(), folder=f"{folder}/run")
            self.assertTrue((run.folder / "report.html").is_file())
            np.testing.assert_array_equal(run.moduli["modulus_MPa"], self.result.moduli["modulus_MPa"])
            with self.assertRaisesRegex(strandlab.InputError, "another case"):
                strandlab.run(small().changed({"run.seed": 2}), folder=f"{folder}/run")

    def test_arrays_are_read_only_views_that_outlive_their_panel(self):
        panel = strandlab.form(small()).panel
        strand = panel.strands[0]
        x, F = strand["position_mm"], strand["deformation_gradient"]
        self.assertEqual((x.shape, F.shape), ((len(strand), 2), (len(strand), 2, 2)))
        self.assertEqual(strand["position_mm"].__array_interface__["data"], x.__array_interface__["data"])
        with self.assertRaises(ValueError):
            x[0] = 0
        kept = x.copy()
        del panel, strand
        gc.collect()
        np.testing.assert_array_equal(x, kept)

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
        slow = small().changed({"press.speed_m_s": 1})  # long enough to be told of
        strandlab.press(slow, on_progress=lambda step, fraction, detail: steps.append(step), on_state=states.append)
        self.assertEqual([panel.compaction for panel in states], [0, 0.1])
        self.assertEqual(set(steps), {"press"})

        def stop(panel):
            raise KeyError("enough")
        with self.assertRaisesRegex(KeyError, "enough"):
            strandlab.press(small(), on_state=stop)

    def test_other_threads_run_while_a_mat_is_pressed(self):
        turns, done = [0], threading.Event()

        def turn():
            while not done.wait(0.001):
                turns[0] += 1
        other = threading.Thread(target=turn)
        other.start()
        before = turns[0]
        strandlab.press(small().changed({"press.speed_m_s": 4}))
        after = turns[0]
        done.set()
        other.join()
        self.assertGreater(after - before, 10)  # a lock that is held to the end leaves one turn

    def test_ctrl_c_ends_a_pressing_within_a_second(self):
        case = small().changed({"press.speed_m_s": 0.05, "run.threads": 2})  # minutes long
        began = time.monotonic()
        pid = os.getpid()
        killer = subprocess.Popen([sys.executable, "-c", f"import os, signal, time; time.sleep(1.5); os.kill({pid}, signal.SIGINT)"])
        signalled = None
        try:
            strandlab.press(case)
        except KeyboardInterrupt:
            signalled = time.monotonic()
        killer.wait()
        self.assertIsNotNone(signalled, "the pressing was over before it was interrupted")
        self.assertLess(signalled - began, 1.5 + 1 + 2)  # and two seconds for a busy machine to start the killer

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
            printed = subprocess.run([PROGRAM, "theory", file, "--csv", "-"], capture_output=True, text=True, check=True).stdout
            self.assertEqual(len(strandlab.theory(small())["modulus_MPa"]), len(printed.splitlines()) - 1)

    def test_a_panel_draws_itself(self):
        import matplotlib
        matplotlib.use("Agg")
        panel = self.result.panels[-1]
        self.assertIn("data:image/png", panel._repr_html_())
        ax = panel.plot("plastic_strain")
        self.assertEqual(len(ax.collections[0].get_array()), panel.points)

    def test_a_failed_pressing_is_a_run_error_and_a_bad_case_an_input_error(self):
        with self.assertRaises(strandlab.InputError):
            strandlab.form(small().changed({"mat.file": "/nowhere/mat.json"}))
        with self.assertRaises(strandlab.InputError):
            strandlab.open_run("/nowhere")
        self.assertTrue(issubclass(strandlab.InputError, ValueError))
        self.assertTrue(issubclass(strandlab.RunError, RuntimeError))


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)
    unittest.main()
