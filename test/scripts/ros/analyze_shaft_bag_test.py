#!/usr/bin/python3
"""analyze_bag.py finds gaps, damper and orbits that were put into the recording of a shaft."""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np
import rosbag
import rospy
from heerk_rotor.msg import ShaftState

SCRIPTS = pathlib.Path(__file__).resolve().parents[3] / "scripts"
sys.path.insert(0, str(SCRIPTS))
from rotor_analysis import recording, shaft_plots  # noqa: E402

SPEED = 500.0                                # [rad/s]
STEP, EVERY = 1e-5, 20
CLEARANCE, HOUSING = 1.6e-4, (1e-5, 3.2e-5)  # [m]
LOST = (4000, 4020, 9000)


def state(step):
    m = ShaftState()
    m.step, m.sim_time, m.rotor_speed, m.azimuth = step, step * STEP, SPEED, SPEED * step * STEP
    m.header.stamp = rospy.Time.from_sec(1.0 + m.sim_time)
    m.disc_x, m.disc_y = [1e-5 * math.cos(m.azimuth), 2e-5 * math.cos(m.azimuth)], [1e-5 * math.sin(m.azimuth), -2e-5 * math.sin(m.azimuth)]
    m.journal_x, m.journal_y = 3e-5 * math.cos(m.azimuth), 4e-5 * math.sin(m.azimuth)
    m.eccentricity_ratio = math.hypot(m.journal_x - HOUSING[0], m.journal_y - HOUSING[1]) / CLEARANCE
    return m


class AnalyzeShaftBag(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        directory = tempfile.TemporaryDirectory()
        cls.addClassCleanup(directory.cleanup)
        cls.bag = pathlib.Path(directory.name) / "shaft.bag"
        with rosbag.Bag(str(cls.bag), "w") as bag:
            for step in range(0, 30000, EVERY):
                if step not in LOST:
                    message = state(step)
                    bag.write("/shaft/state", message, message.header.stamp)
        cls.result = subprocess.run([sys.executable, SCRIPTS / "analyze_bag.py", str(cls.bag)], capture_output=True, text=True, check=False)
        cls.recording = recording.read(cls.bag)

    def test_writes_three_pictures_that_are_not_blank(self):
        self.assertEqual(self.result.returncode, 0, self.result.stderr)
        for name in ("time_histories", "orbits", "spectrum"):
            picture = matplotlib.image.imread(self.bag.with_name("shaft_plots") / f"{name}.png")
            self.assertGreater(np.ptp(picture[:, :, :3]), 0.5, name)

    def test_counts_states_and_gaps(self):
        self.assertIn(f"{30000 // EVERY - len(LOST)} states, steps 0..29980 by 20", self.result.stdout)
        self.assertIn("2 discs", self.result.stdout)
        self.assertIn("gaps: 2, 3 messages missing", self.result.stdout)

    def test_finds_the_damper_from_the_eccentricity(self):
        found = shaft_plots.housing(self.recording)
        for value, expected in zip(found, (CLEARANCE, *HOUSING)):
            self.assertAlmostEqual(value, expected, delta=1e-9)

    def test_without_a_damper_there_is_none(self):
        self.recording.eccentricity_ratio = 0 * self.recording.eccentricity_ratio
        self.addCleanup(setattr, type(self), "recording", recording.read(self.bag))
        self.assertIsNone(shaft_plots.housing(self.recording))

    def test_shows_the_last_turns_of_the_longest_part(self):
        part = shaft_plots.last_turns(self.recording)
        self.assertEqual(part.stop, len(self.recording.step))
        turns = np.ptp(self.recording.azimuth[part]) / (2 * math.pi)
        self.assertAlmostEqual(turns, shaft_plots.ORBIT_TURNS, delta=0.02)


if __name__ == "__main__":
    unittest.main()
