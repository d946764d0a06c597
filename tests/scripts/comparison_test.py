# SPDX-License-Identifier: GPL-3.0-or-later
"""The comparison with the peers reads what they print, takes medians and judges promises; no peer is needed.

Usage: python3 comparison_test.py
"""

import os
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
BENCHMARKS = HERE.parent / "benchmarks"
sys.path[:0] = [str(BENCHMARKS), str(BENCHMARKS / "peers")]

import compare
import to_lammps_data
from comparison import cases, codes, costs, outputs, promises, report, running
from comparison.results import Results, combine


def recorded(name):
    return (HERE / "recorded" / name).read_text(encoding="utf-8")


def run(code, scene, size, ms, repetition=0, threads=1, **more):
    """A record of an undisturbed run."""
    record = {"code": code, "scene": scene, "size": size, "threads": threads, "repetition": repetition}
    return {**record, "ms_per_step": ms, "cpu_ms_per_step": ms * threads, "contacts": 10, "rss_MiB": 20.0, **more}


def row(records, promise, words="", installed=("yade", "lammps")):
    """The row of a promise whose description holds some words."""
    found = [row for row in promises.rows(Results(records), set(installed)) if row.promise == promise and words in row.what]
    assert len(found) == 1, found
    return found[0]


class Outputs(unittest.TestCase):
    def test_lammps_gives_the_timed_run_and_not_its_warm_up(self):
        figures = outputs.read_lammps(recorded("lammps.txt"), 50)

        self.assertAlmostEqual(figures["ms_per_step"], 0.0375596 / 50 * 1e3)
        self.assertAlmostEqual(figures["cpu_ms_per_step"], 0.607 * figures["ms_per_step"])
        self.assertEqual((figures["N"], figures["contacts"]), (5000, 12351))
        self.assertEqual(figures["state"], {"kinetic_energy_J": 4.758322681e-08, "mean_height_m": 0.01681437152})

    def test_liggghts_is_read_like_lammps_with_the_processor_time_of_the_system(self):
        figures = outputs.read_lammps(recorded("liggghts.txt"), 50)

        self.assertAlmostEqual(figures["ms_per_step"], 0.033747 / 50 * 1e3)
        # From 4 + 1 to 8 + 1 ticks.
        self.assertAlmostEqual(figures["cpu_ms_per_step"], 4 / os.sysconf("SC_CLK_TCK") / 50 * 1e3)
        self.assertEqual((figures["N"], figures["contacts"]), (5000, 12344))

    def test_yade_is_read_from_its_line_among_others(self):
        figures = outputs.read_json(recorded("yade.txt"), 50, "RESULT ")

        self.assertEqual((figures["N"], figures["contacts"]), (5000, 13339))
        self.assertAlmostEqual(figures["ms_per_step"], 3.362489220016869)

    def test_plekton_is_read_from_its_line(self):
        self.assertEqual(outputs.read_json(recorded("plekton.txt"), 50)["contacts_by_kind"]["with_planes"], 1028)

    def test_all_codes_are_recorded_in_the_same_state(self):
        # After 70 steps from one bed the spheres have moved by some 1e-9 m: mean heights agree to 1e-8 m.
        read = (outputs.read_lammps(recorded(name), 50) for name in ("lammps.txt", "liggghts.txt"))
        heights = [figures["state"]["mean_height_m"] for figures in read]
        heights.append(outputs.read_json(recorded("yade.txt"), 50, "RESULT ")["state"]["mean_height_m"])
        heights.append(outputs.read_json(recorded("plekton.txt"), 50)["state"]["mean_height_m"])

        self.assertLess(max(heights) - min(heights), 1e-8)

    def test_what_is_no_result_is_refused(self):
        lammps = recorded("lammps.txt")
        unreadable = {
            "cut off": lammps[: lammps.rindex("Loop time")],
            "other steps": lammps.replace("for 50 steps", "for 60 steps"),
            "no number": lammps.replace("4.758322681e-08", "******"),
            "blown up": lammps.replace("4.758322681e-08", "nan"),
            "no time": lammps.replace("Loop time of 0.0375596", "Loop time of nan"),
            "empty": "",
        }
        for reason, text in unreadable.items():
            with self.subTest(reason), self.assertRaises(outputs.Unreadable):
                outputs.read_lammps(text, 50)
        for text in ("", "Segmentation fault", '{"steps": 50, "ms_per_step": 0}', '{"steps": 50', '{"steps": 50, "state": null}'):
            with self.subTest(text), self.assertRaises(outputs.Unreadable):
                outputs.read_json(text, 50)


class Searches(unittest.TestCase):
    LINE = '{"scene": "search_near", "code": "%s", "size": 500000, "repetition": 0, "steps": 1, "ms_per_step": %g, "cpu_ms_per_step": %g}'

    def records(self, ours, theirs):
        text = "\n".join(self.LINE % (code, ms, ms) for code, ms in (("plekton", ours), ("cgal", theirs)))
        return [{**figures, "threads": 1, "rss_MiB": 20.0} for figures in outputs.read_searches(text)]

    def test_the_search_promise_is_judged_by_the_lines_of_its_program(self):
        held = row(self.records(300.0, 400.0), "G12", "search_near", ("cgal",))
        missed = row(self.records(500.0, 400.0), "G12", "search_near", ("cgal",))

        self.assertAlmostEqual(held.measured.median, 4.0 / 3.0)
        self.assertEqual((held.verdict(held.must), missed.verdict(missed.must)), ("holds", "missed"))

    def test_what_was_not_searched_is_not_measured(self):
        self.assertEqual(row([], "G12", "search_flat").verdict(0.5), "not measured (needs --search)")

    def test_no_line_is_no_result(self):
        with self.assertRaises(outputs.Unreadable):
            outputs.read_searches("Segmentation fault")


class Statistics(unittest.TestCase):
    def test_ratios_are_taken_within_repetitions(self):
        # The machine slows down by half in the second repetition; the ratio stays 2.
        ratio = combine(lambda ours, theirs: theirs / ours, {0: 1.0, 1: 1.5, 2: 1.0}, {0: 2.0, 1: 3.0, 2: 2.2})

        self.assertEqual((ratio.median, ratio.smallest, ratio.largest), (2.0, 2.0, 2.2))

    def test_ratios_without_a_shared_repetition_are_those_of_medians(self):
        self.assertEqual(combine(lambda a, b: a / b, {0: 6.0, 1: 8.0}, {2: 2.0}).median, 3.5)

    def test_a_missing_series_gives_none(self):
        self.assertIsNone(combine(lambda a, b: a / b, {0: 1.0}, {}))

    def test_disturbed_runs_are_left_out_where_a_clean_one_is_left(self):
        disturbed = run("plekton", "s1", 5000, 2.0, cpu_ms_per_step=1.0)
        clean = run("plekton", "s1", 5000, 1.0, repetition=1)

        self.assertEqual(Results([disturbed, clean]).times("plekton", "s1", 5000), {1: 1.0})
        self.assertEqual(Results([disturbed]).times("plekton", "s1", 5000), {0: 2.0})

    def test_processor_time_takes_disturbed_runs_but_not_those_of_several_threads(self):
        records = [run("yade", "s1", 5000, 4.0, threads=threads, cpu_ms_per_step=3.0) for threads in (1, 2)]
        records.append(run("yade", "s1", 5000, 3.1, repetition=1))
        results = Results(records, "cpu")

        self.assertEqual(results.times("yade", "s1", 5000), {0: 3.0, 1: 3.1})
        self.assertEqual(results.times("yade", "s1", 5000, 2), {0: 4.0})

    def test_processor_time_is_taken_if_asked_for(self):
        # The last does not say: half of a processor over its life counts.
        records = [
            run("lammps", "s1", 5000, 2.0, cpu_ms_per_step=1.5),
            run("liggghts", "s1", 5000, 2.0, cpu_ms_per_step=None, share=0.5),
        ]
        results = Results(records, "cpu")

        self.assertEqual(results.times("lammps", "s1", 5000), {0: 1.5})
        self.assertEqual(results.times("liggghts", "s1", 5000), {0: 1.0})


class Promises(unittest.TestCase):
    def test_a_peer_that_is_slow_enough_lets_the_promise_hold(self):
        records = [run("plekton", "s2", 5000, 1.0), run("yade", "s2", 5000, 12.0)]

        found = row(records, "G3")

        self.assertEqual((found.verdict(found.must), found.verdict(found.aim)), ("holds", "missed"))

    def test_a_median_on_one_side_with_repetitions_on_the_other_says_so(self):
        records = [run("plekton", "s2", 5000, 1.0, repetition) for repetition in range(3)]
        over = [run("yade", "s2", 5000, ms, repetition) for repetition, ms in enumerate((9.0, 11.0, 12.0))]
        under = [run("yade", "s2", 5000, ms, repetition) for repetition, ms in enumerate((9.0, 9.0, 12.0))]

        self.assertEqual(row(records + over, "G3").verdict(10.0), "holds (not in every repetition)")
        self.assertEqual(row(records + under, "G3").verdict(10.0), "missed (not in every repetition)")

    def test_what_was_not_measured_says_why(self):
        alone = [run("plekton", "s2", 5000, 1.0)]
        failed = {"code": "yade", "scene": "s2", "size": 5000, "threads": 1, "repetition": 0, "failed": "exit code 1\nlines"}

        self.assertEqual(row(alone, "G3", installed=()).verdict(10.0), "not measured (no YADE on this machine)")
        self.assertEqual(row(alone, "G4").verdict(8.0), "not measured (s3 was not run)")
        self.assertEqual(row([*alone, failed], "G3").verdict(10.0), "not measured (YADE failed: exit code 1)")

    def test_lammps_of_the_distribution_counts_at_the_share_of_a_native_one(self):
        records = [run("plekton", "s1", 5000, 1.0), run("lammps", "s1", 5000, 2.0), run("lammps-native", "s1", 5000, 1.8)]

        self.assertAlmostEqual(row(records, "G1", "s1 5000: times LAMMPS").measured.median, 2.0 * promises.NATIVE_SHARE)
        native = row(records, "G1", "s1 5000: times LAMMPS", installed=("lammps", "lammps-native"))
        self.assertAlmostEqual(native.measured.median, 1.8)

    def test_a_contact_costs_what_a_layer_on_its_ground_takes_more_than_one_lifted_off_it(self):
        on_sheet = {"sphere_surface": 40, "sphere_sphere": 0}
        on_spheres = {"sphere_surface": 0, "sphere_sphere": 50}
        records = [
            run("plekton", "layer_sheet", 0, 2.0, contacts_by_kind=on_sheet),
            run("plekton", "layer_sheet_lifted", 0, 1.6),
            run("plekton", "layer_spheres", 0, 1.0, contacts_by_kind=on_spheres),
            run("plekton", "layer_spheres_lifted", 0, 0.8),
        ]

        # (2.0 - 1.6) / 40 = 0.01 ms over (1.0 - 0.8) / 50 = 0.004 ms.
        found = row(records, "G7", "a sphere-facet contact")
        self.assertAlmostEqual(found.measured.median, 2.5)
        self.assertEqual(found.verdict(found.must), "holds")
        self.assertIn("needs layers", row(records[:3], "G7", "a sphere-facet contact").verdict(3.0))

    def test_a_contact_of_s2_bears_what_s2_takes_beyond_the_sheet_and_the_other_contacts(self):
        bed = {"sphere_sphere": 90, "with_planes": 10, "sphere_surface": 0}
        membrane = {"sphere_sphere": 40, "with_planes": 10, "sphere_surface": 20}
        records = [
            run("plekton", "s1", 5000, 1.0, contacts_by_kind=bed),
            run("plekton", "s2", 5000, 1.2, contacts_by_kind=membrane),
            run("plekton", "sheet", 32, 0.3),
        ]

        # (1.2 - 0.3 - 50 * 0.01) / 20 = 0.02 ms, over 0.01 ms.
        self.assertAlmostEqual(row(records, "G7", "the same").measured.median, 2.0)

    def test_two_threads_with_other_bits_miss_whatever_their_speed(self):
        for scene, size, what in (("s1", 5000, "s1 5000"), ("s4b", 0, "s4b")):
            with self.subTest(scene):
                one = run("plekton", scene, size, 1.8, state={"kinetic_energy_J": 0.1})
                two = run("plekton", scene, size, 1.0, threads=2, state={"kinetic_energy_J": 0.1})
                other = run("plekton", scene, size, 1.0, threads=2, state={"kinetic_energy_J": 0.1 + 2e-17})

                self.assertEqual(row([one, two], "G8", what).verdict(1.6), "holds")
                self.assertEqual(row([one, other], "G8", what).verdict(1.6), "missed (other bits than one thread)")

    def test_memory_is_what_more_elements_take_more(self):
        records = [
            run("plekton", "s1", 5000, 1.0, rss_MiB=20.0),
            run("plekton", "s1", 20000, 4.0, rss_MiB=20.0 + 15000 * 0.5 / 1024),
            run("plekton", "lone", 1, 0.1, rss_MiB=9.0),
        ]

        self.assertAlmostEqual(row(records, "G9", "sphere").measured.median, 0.5)
        self.assertEqual(row(records, "G9", "fixed").measured.median, 9.0)
        self.assertIsNone(costs.memory_per_facet(Results(records)))

    def test_growth_is_per_sphere(self):
        records = [run("plekton", "s1", 5000, 1.0), run("plekton", "s1", 100000, 28.0)]

        self.assertAlmostEqual(row(records, "G10").measured.median, 1.4)

    def test_a_law_costs_what_its_scene_takes_over_the_same_under_the_linear_one(self):
        linear = run("plekton", "s1:linear_frictional", 5000, 1.0)
        hertz = run("plekton", "s1:hertz_mindlin", 5000, 1.4)

        of_hertz = row([linear, hertz], "G11", "s1: hertz_mindlin over")

        self.assertAlmostEqual(of_hertz.measured.median, 1.4)
        self.assertEqual(of_hertz.verdict(1.3), "missed")

    def test_plekton_is_told_the_law_of_a_scene(self):
        case = cases.Case("s2:dmt_adhesion+parts", 5000, "", 1, 2)

        words = codes.plekton_command("bench", codes.Job(case, None, 1))

        self.assertEqual(words[1], "s2")
        self.assertEqual(words[-2:], ["--law", "dmt_adhesion+parts"])


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def code(self, command):
        return codes.Code("peer", "", (), lambda job: command, outputs.read_json)

    def job(self, steps=5):
        return codes.Job(cases.Case("s4a", 0, "", 1, steps), None, 1)

    def test_a_good_run_is_recorded_with_where_it_belongs(self):
        command = ["echo", 'noise\n{"steps": 5, "ms_per_step": 2.0, "threads": 7}']

        record = compare.measure(self.code(command), self.job(), 3, 60)

        self.assertEqual((record["ms_per_step"], record["threads"], record["repetition"]), (2.0, 1, 3))

    def test_a_failing_peer_is_recorded_with_its_last_lines(self):
        failing = {
            "exit code 3": ["sh", "-c", "echo a reason; exit 3"],
            "exit code 127": [str(self.folder / "no_such_program")],
            "no line with a result": ["echo", "a reason"],
            "the time it was given": ["sleep", "60"],
        }
        for reason, command in failing.items():
            with self.subTest(reason):
                record = compare.measure(self.code(command), self.job(), 0, 0.5)

                self.assertIn(reason, record["failed"])

    def test_a_command_does_not_begin_with_the_peak_memory_of_this_program(self):
        ballast = bytes(64 * 1024 * 1024)
        own = "import resource; print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"

        kib = int(running.run([sys.executable, "-c", own], 1, 60).text)

        self.assertLess(kib, len(ballast) / 1024)

    def test_codes_take_turns_there_and_back(self):
        self.assertEqual([compare.in_turns("abc", repetition) for repetition in range(3)], [list("abc"), list("cba"), list("abc")])

    def test_beds_are_made_once_under_their_name(self):
        orders = []

        def make_bed(words):
            orders.append(words)
            Path(words[words.index("--out") + 1]).write_text("bed", encoding="utf-8")

        case = cases.cases_of(["s1flow"], [])[0]
        paths = {cases.provide_bed(case, self.folder, make_bed) for _ in range(2)}

        self.assertEqual(paths, {self.folder / "flow_20000.txt"})
        self.assertEqual([words[:3] for words in orders], [["--flow", "--spheres", "20000"]])

    def test_promises_on_contacts_and_memory_bring_their_runs(self):
        scenes = [case.scene for case in cases.cases_of(["s1", "s2"], [5000, 20000])]

        self.assertEqual(scenes, ["s1", "s1", "s2", "sheet", "sheet", "lone"])
        layers = [case.scene for case in cases.cases_of(["layers"], [])]
        self.assertEqual(layers, ["layer_sheet", "layer_sheet_lifted", "layer_spheres", "layer_spheres_lifted"])

    def test_a_bed_becomes_a_data_file_with_diameters_and_the_box(self):
        bed, data = self.folder / "bed.txt", self.folder / "bed.lammps"
        bed.write_text("1 0.5 3\n0.1 0.2 0.3 0.001 1 2 3 4 5 6\n", encoding="utf-8")

        to_lammps_data.convert(bed, data)

        text = data.read_text(encoding="utf-8")
        for line in ("0 1.5 xlo xhi", "0 0.5 ylo yhi", "1 1 0.002 2500 0.1 0.2 0.3", "1 1 2 3 4 5 6"):
            self.assertIn(f"\n{line}\n", text)

    def test_a_bed_that_is_cut_off_is_refused(self):
        bed = self.folder / "bed.txt"
        bed.write_text("2 0.5 1\n0.1 0.2 0.3 0.001 1 2 3 4 5 6\n", encoding="utf-8")

        with self.assertRaisesRegex(ValueError, "1 spheres; its first line promises 2"):
            to_lammps_data.read_bed(bed)


class Report(unittest.TestCase):
    def test_all_tables_are_printed_with_failures_and_disturbance(self):
        records = [
            run("plekton", "s1", 5000, 0.25, contacts_by_kind={"sphere_sphere": 9, "with_planes": 1}),
            run("yade", "s1", 5000, 2.5, cpu_ms_per_step=1.0),
            {"code": "lammps", "scene": "s1", "size": 5000, "threads": 1, "repetition": 0, "failed": "exit code 1\nERROR"},
        ]

        text = report.whole(Results(records), {"plekton", "yade", "lammps"})

        for words in ("yade *", "10.0", "10 (spheres: 9)", "lammps, s1 5000, 1 threads, repetition 0: exit code 1", report.DISTURBED):
            self.assertIn(words, text)

    def test_a_table_of_nothing_is_no_crash(self):
        self.assertIn("not measured", report.whole(Results([]), set()))


if __name__ == "__main__":
    unittest.main()
