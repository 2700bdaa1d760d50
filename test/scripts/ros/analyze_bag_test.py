#!/usr/bin/python3
"""analyze_bag.py finds the damping, harmonics and gaps that were put into a recording, and refuses what it cannot analyse."""
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np
import rosbag
from std_msgs.msg import Float64

HERE = pathlib.Path(__file__).resolve().parent
SCRIPTS = HERE.parents[2] / "scripts"
sys.path[:0] = [str(HERE), str(SCRIPTS)]
import synthetic_bag  # noqa: E402
from rotor_analysis import harmonics, modes, recording  # noqa: E402

LOST = (400, 404, 408, 1200)
DURATION = 5.0


def analyze(*arguments):
    return subprocess.run([sys.executable, SCRIPTS / "analyze_bag.py", *map(str, arguments)], capture_output=True, text=True, check=False)


class AnalyzeBag(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        directory = tempfile.TemporaryDirectory()
        cls.addClassCleanup(directory.cleanup)
        cls.folder = pathlib.Path(directory.name)
        cls.bag = cls.folder / "flight.bag"
        cls.written = synthetic_bag.write(cls.bag, DURATION, lost=LOST)
        cls.result = analyze(cls.bag)

    def test_writes_four_pictures_that_are_not_blank(self):
        self.assertEqual(self.result.returncode, 0, self.result.stderr)
        for name in ("time_histories", "multiblade", "hub_load_harmonics", "lag_damping"):
            picture = matplotlib.image.imread(self.folder / "flight_plots" / f"{name}.png")
            self.assertGreater(np.ptp(picture[:, :, :3]), 0.5, name)

    def test_blades_that_flap_have_rows_of_their_own(self):
        # Five rows of 2.5 inches instead of four, at 120 dots per inch.
        self.assertEqual(matplotlib.image.imread(self.folder / "flight_plots" / "time_histories.png").shape[0], 1500)

    def test_counts_states_and_gaps(self):
        self.assertIn(f"{self.written} states", self.result.stdout)
        self.assertIn("gaps: 2, 4 messages missing", self.result.stdout)
        self.assertIn("after step 396", self.result.stdout)
        self.assertIn("after step 1196", self.result.stdout)

    def test_finds_each_lag_mode_by_both_methods(self):
        # The recording holds exactly these modes, so that both methods must agree to far better than the 1 % a user needs.
        found = [tuple(map(float, m)) for m in re.findall(
            r"lag: (\S+) rad/s .*pencil (\S+) 1/s, moving block ([-+.\d]+)", self.result.stdout)]
        expected = [synthetic_bag.COLLECTIVE, synthetic_bag.REGRESSIVE, synthetic_bag.PROGRESSIVE]
        self.assertEqual(len(found), len(expected), self.result.stdout)
        for (frequency, pencil, block), (growth, true_frequency, _) in zip(found, expected):
            self.assertAlmostEqual(frequency, true_frequency, delta=1e-3)
            self.assertAlmostEqual(pencil, growth, delta=0.01 * abs(growth))
            self.assertAlmostEqual(block, growth, delta=0.01 * abs(growth))

    def test_reports_no_gap_where_there_is_none(self):
        bag = self.folder / "whole.bag"
        synthetic_bag.write(bag, 1.0)
        self.assertIn("gaps: none", analyze(bag).stdout)

    def test_names_a_missing_file(self):
        self.expect_refusal("no such file", self.folder / "absent.bag")

    def test_refuses_what_is_not_a_bag(self):
        other = self.folder / "text.bag"
        other.write_text("hello\n", encoding="ascii")
        self.expect_refusal("not a readable bag", other)

    def test_refuses_a_bag_without_states_and_lists_what_it_has(self):
        bag = self.folder / "other.bag"
        with rosbag.Bag(str(bag), "w") as stream:
            stream.write("/something", Float64(1.0))
        self.expect_refusal("/something (std_msgs/Float64)", bag)

    def test_refuses_less_than_two_revolutions(self):
        bag = self.folder / "short.bag"
        synthetic_bag.write(bag, 1.5 * 2 * math.pi / synthetic_bag.ROTOR_SPEED)
        self.expect_refusal("too short", bag)

    def test_refuses_an_empty_time_range(self):
        self.expect_refusal("0 messages", self.bag, "--from", 100)

    def test_asks_which_of_two_topics(self):
        bag = self.folder / "two.bag"
        with rosbag.Bag(str(bag), "w") as stream:
            for step in range(3):
                stream.write("/a/state", synthetic_bag.state(step))
                stream.write("/b/state", synthetic_bag.state(step))
        self.expect_refusal("choose with --topic", bag)

    def expect_refusal(self, text, *arguments):
        result = analyze(*arguments)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(text, result.stderr)
        self.assertNotIn("Traceback", result.stderr)


class Harmonics(unittest.TestCase):
    def test_varying_speed_does_not_smear_them(self):
        # Azimuth with a 5 % speed ripple, sampled equally in time, four degrees apart on average.
        t = np.arange(0, 20 * 90) * math.radians(4)
        azimuth = t + 0.05 * np.sin(0.7 * t)
        load = (3.0 + 2.0 * np.cos(4 * azimuth + 0.4) + 0.5 * np.sin(8 * azimuth))[:, None]
        found = harmonics.per_revolution(azimuth, load)
        expected = np.zeros(13)
        expected[[0, 4, 8]] = 3.0, 2.0, 0.5
        # Cubic interpolation at 11 points per cycle (8/rev) is good to about 1e-3 of the amplitude.
        np.testing.assert_allclose(found.amplitude[:, 0], expected, atol=2e-3)

    def test_a_free_vibration_stays_out_of_them(self):
        azimuth = np.arange(0, 20 * 90) * math.radians(4)
        load = (100.0 * np.cos(0.3 * azimuth) + 2.0 * np.cos(4 * azimuth))[:, None]
        found = harmonics.per_revolution(azimuth, load)
        # A Hann window over 19 revolutions: side lobes at 3.7 revolution frequencies, 70 lines away, are below 2e-6.
        self.assertAlmostEqual(found.amplitude[4, 0], 2.0, delta=2e-3)
        self.assertAlmostEqual(found.residual[0], 100.0 / math.sqrt(2), delta=1.0)

    def test_refuses_less_than_one_revolution(self):
        azimuth = np.linspace(0, 6.0, 100)
        self.assertIsNone(harmonics.per_revolution(azimuth, np.ones((100, 1))))


class Modes(unittest.TestCase):
    def test_tells_growth_from_decay_in_noise(self):
        dt, generator = 0.01, np.random.default_rng(1)
        t = np.arange(0, 10, dt)
        signal = np.exp((0.05 - 12j) * t) + 0.3 * np.exp((-0.2 + 30j) * t)
        signal = signal + 1e-3 * (generator.standard_normal(len(t)) + 1j * generator.standard_normal(len(t)))
        first, second = modes.matrix_pencil(signal, dt, noise=1e-2)[:2]
        # Noise of 1e-3 over 1000 samples: the Cramer-Rao bound of the growth is about 1e-5 1/s for the first, 2e-4 for the second.
        self.assertAlmostEqual(first.growth, 0.05, delta=1e-3)
        self.assertAlmostEqual(first.frequency, -12.0, delta=1e-3)
        self.assertAlmostEqual(second.growth, -0.2, delta=5e-3)
        self.assertAlmostEqual(modes.moving_block(signal, dt, first.frequency).growth, 0.05, delta=5e-3)

    def test_decimation_keeps_amplitude_and_damping(self):
        dt = 1e-3
        t = np.arange(0, 8, dt)
        thinned, step = modes.decimated(np.exp(-0.5 * t) * np.cos(20 * t), dt, 80.0)
        self.assertGreater(step, 5 * dt)
        mode = modes.matrix_pencil(thinned, step)[0]
        # 1e-4: ripple of the Kaiser filter (80 dB).
        self.assertAlmostEqual(mode.growth, -0.5, delta=1e-4)
        self.assertAlmostEqual(mode.frequency, 20.0, delta=1e-4)


class RecordingOfResets(unittest.TestCase):
    def test_epochs_and_disorder_split_it(self):
        messages = [synthetic_bag.state(step) for step in (0, 4, 8, 12, 16, 20, 24)]
        for message in messages[4:]:
            message.epoch = 1
        messages.append(synthetic_bag.state(20))
        messages[-1].epoch = 1
        found = recording.Recording("/rotor/state", messages)
        self.assertEqual(found.gaps, [])
        self.assertEqual(found.disordered, 1)
        self.assertEqual(found.stretches[0], slice(0, 4))


if __name__ == "__main__":
    unittest.main()
