#!/usr/bin/python3
"""The report on performance is made of whatever benchmark results are there, fits growth, and says what has no result."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "performance_report.py"

try:
    import matplotlib  # noqa: F401
except ImportError:
    matplotlib = None


def entry(name, nanoseconds, **counters):
    return {"name": name, "run_name": name, "run_type": "iteration", "iterations": 1, "real_time": 2 * nanoseconds, "cpu_time": nanoseconds, "time_unit": "ns", **counters}


@unittest.skipIf(matplotlib is None, "needs matplotlib")
class PerformanceReport(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.folder = pathlib.Path(directory.name)
        (self.folder / "build").mkdir()
        (self.folder / "build" / "compile_commands.json").write_text("[]")

    def write(self, program, *entries):
        file = self.folder / "results" / f"{program}.json"
        file.parent.mkdir(exist_ok=True)
        context = {"date": "2026-01-02T03:04:05+00:00", "load_avg": [0.5, 0.5, 0.5]}
        file.write_text(json.dumps({"context": context, "benchmarks": list(entries)}))

    def report(self):
        """Exit status, text of the report, what the script said."""
        result = subprocess.run([sys.executable, SCRIPT, "--results", self.folder / "results", "--build", self.folder / "build", "--output", self.folder / "docs"],
                                capture_output=True, text=True, check=False)
        file = self.folder / "docs" / "performance.md"
        return result.returncode, file.read_text(encoding="utf-8") if file.exists() else "", result.stdout + result.stderr

    def test_growth_is_fitted_and_held_against_its_bound(self):
        self.write("scaling", *[entry(f"blades/{n}", 1000.0 * n ** 1.5) for n in (2, 4, 8)], *[entry(f"elements/{n}", 10.0 * n ** 1.5) for n in (5, 10, 20, 40)])
        status, text, _ = self.report()
        self.assertEqual(status, 0)
        self.assertIn("| blades | 2 .. 8 | 2.83 µs | 22.6 µs | 0.0 .. 0.0 | 1.50 | 1.50 | <= 1.1 |", text)
        self.assertIn("time grows with blades with an exponent of at most 1.1 | 1.50 from 2 to 8 | **no** |", text)
        self.assertIn("an exponent of at most 2 | 1.50 from 5 to 40 | yes |", text)
        self.assertTrue((self.folder / "docs" / "performance" / "scaling.png").exists())

    def test_the_shortest_repetition_counts_and_manual_time_where_there_is_one(self):
        self.write("lag_rotor_step", entry("step/absolute_lag_3e4", 900.0, h=1e-3), entry("step/absolute_lag_3e4", 400.0, h=1e-3), entry("step/absolute_lag_3e4", 500.0, h=1e-3))
        self.write("fe_rotor_step", entry("step/bo105/iterations:10/manual_time", 10000.0, h=4e-4))
        _, text, _ = self.report()
        self.assertIn("| lag rotor, K_s = 3·10⁴ N m/rad | 400 ns | 500 ns | 1 ms | 2.5e+03 |", text)
        self.assertIn("| elastic rotor, 10 sections | 20 µs | 20 µs | 400 µs | 20 |", text)

    def test_a_benchmark_that_failed_is_named_and_is_the_exit_status(self):
        self.write("publishing", {**entry("publish/subscribers:0/manual_time", 1.0), "error_occurred": True, "error_message": "no ROS master"}, entry("fillMessages", 150.0))
        status, text, said = self.report()
        self.assertEqual(status, 1)
        self.assertIn("bench_publishing publish/subscribers:0: no ROS master", said)
        self.assertIn("* bench_publishing publish/subscribers:0: no ROS master", text)
        self.assertIn("| ROS: filling state, lag angles, hub wrench | 150 ns |", text)

    def test_a_program_that_ended_early_is_named(self):
        self.write("startup", entry("toFirstStep/bo105/manual_time", 1e6, reading_ms=1, system_ms=1, simulation_ms=1, first_step_ms=1))
        (self.folder / "results" / "scaling.json").write_text("{")
        status, _, said = self.report()
        self.assertEqual(status, 1)
        self.assertIn("bench_scaling: no results", said)

    def test_the_part_on_work_and_precision_is_included_with_its_links(self):
        self.write("lag_rotor_step", entry("step/absolute_lag_3e4", 400.0, h=1e-3))
        part = self.folder / "docs" / "performance" / "work_precision.md"
        part.parent.mkdir(parents=True)
        part.write_text("# Work and precision\n\n![error](lag.png) [there](https://example.org) [up](#bounds)\n")
        _, text, _ = self.report()
        self.assertIn("\n## Work and precision\n\n![error](performance/lag.png) [there](https://example.org) [up](#bounds)\n", text)

    def write_sweep(self, *repetitions):
        def run(wall, cpu):
            return {"wall_time": wall, "cpu_time": cpu}
        lines = [json.dumps({"one_job": run(*one), "two_jobs": run(*two), "halves": [run(half, half) for half in halves]}) + "\n" for one, two, halves in repetitions]
        (self.folder / "results" / "sweep.repetitions").write_text("".join(lines))

    def test_the_sweep_by_two_jobs_is_held_against_one(self):
        self.write("lag_rotor_step", entry("step/absolute_lag_3e4", 400.0, h=1e-3))
        # Two programs are as fast as the slower of them.
        self.write_sweep(((4.2, 4.1), (3.0, 4.4), (1.9, 2.1)), ((4.0, 3.9), (2.0, 4.0), (2.5, 1.8)), ((4.4, 4.3), (2.2, 4.3), (1.0, 2.0)))
        self.assertIn("| 2.00, two programs that share nothing: 2.00 (medians of ratios; medians of wall times 4.20 s and 2.20 s, CPU times 4.10 s and 4.30 s) | yes |", self.report()[1])
        self.write_sweep(((4.0, 4.0), (2.5, 4.5), (2.4, 2.0)))
        self.assertIn("| 1.60, two programs that share nothing: 1.67 (medians of ratios; medians of wall times 4.00 s and 2.50 s, CPU times 4.00 s and 4.50 s) | **no** |", self.report()[1])
        self.write_sweep(((8.0, 4.0), (8.0, 4.0), (4.0, 4.0)))
        self.assertIn("| one job got 50 % of a processor; wall times 8.00 s and 8.00 s, CPU times 4.00 s and 4.00 s | machine not free |", self.report()[1])

    def test_without_results_it_says_what_it_expected(self):
        (self.folder / "results").mkdir()
        status, text, said = self.report()
        self.assertEqual((status, text), (2, ""))
        self.assertIn("expected JSON files", said)


if __name__ == "__main__":
    unittest.main()
