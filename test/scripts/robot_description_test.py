#!/usr/bin/python3
"""The robot model follows the configuration: number of blades, sense of rotation, sizes; and never fails."""
import math
import pathlib
import subprocess
import sys
import unittest
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def describe(config, overrides="[]"):
    result = subprocess.run([sys.executable, ROOT / "scripts" / "robot_description.py", ROOT / "config" / config, "--set", overrides],
                            capture_output=True, text=True, check=True)
    return xml.fromstring(result.stdout), result.stderr


def joint(robot, name):
    return next(j for j in robot.findall("joint") if j.get("name") == name)


def numbers(element, tag, key):
    return [float(v) for v in element.find(tag).get(key).split()]


class RobotDescription(unittest.TestCase):
    def test_every_joint_of_the_node_exists_once_for_each_number_of_blades(self):
        for blades in range(2, 9):
            robot, _ = describe("bo105.yaml", f"['subsystems.rotor.blades={blades}']")
            names = [j.get("name") for j in robot.findall("joint")]
            expected = ["hub_joint", "rotor_joint"] + [f"blade_{k + 1}_{motion}_joint" for k in range(blades) for motion in ("flap", "lag", "pitch")]
            self.assertEqual(names, expected)
            links = {link.get("name") for link in robot.findall("link")}
            self.assertEqual({j.find(end).get("link") for j in robot.findall("joint") for end in ("parent", "child")}, links)
            self.assertAlmostEqual(numbers(joint(robot, "blade_2_flap_joint"), "origin", "rpy")[2], 2 * math.pi / blades)

    def test_hub_and_shaft_stand_as_the_mount_says(self):
        robot, _ = describe("bo105.yaml", "['subsystems.fuselage.hub_offset=[0.1, 0.0, 1.7]', 'subsystems.fuselage.shaft_tilt_forward_deg=5']")
        self.assertEqual(numbers(joint(robot, "hub_joint"), "origin", "xyz"), [0.1, 0.0, 1.7])
        self.assertAlmostEqual(numbers(joint(robot, "hub_joint"), "origin", "rpy")[1], math.radians(5))  # about +y: forward

    def test_a_clockwise_rotor_turns_and_counts_the_other_way_round(self):
        robot, _ = describe("bo105.yaml", "['subsystems.fuselage.rotation=cw']")
        self.assertEqual(numbers(joint(robot, "rotor_joint"), "axis", "xyz"), [0, 0, -1])
        self.assertAlmostEqual(numbers(joint(robot, "blade_2_flap_joint"), "origin", "rpy")[2], -math.pi / 2)
        self.assertEqual(numbers(joint(robot, "blade_1_flap_joint"), "axis", "xyz"), [0, -1, 0])   # up
        self.assertEqual(numbers(joint(robot, "blade_1_lag_joint"), "axis", "xyz"), [0, 0, -1])    # lead: with the rotation
        self.assertEqual(numbers(joint(robot, "blade_1_pitch_joint"), "axis", "xyz"), [-1, 0, 0])  # nose up: the leading edge is at -y

    def test_the_fuselage_grows_with_the_rotor(self):
        def skid(robot):
            return min(float(v.find("origin").get("xyz").split()[2]) for v in robot.find("link").findall("visual"))
        small, _ = describe("lag_rotor.yaml", "['subsystems.rotor.blade_length=2.4']")
        large, _ = describe("lag_rotor.yaml", "['subsystems.rotor.blade_length=4.9']")
        self.assertAlmostEqual(skid(small), -1.35, places=6)
        self.assertAlmostEqual(skid(large), -2.7, places=6)

    def test_a_shaft_is_its_frame_only(self):
        robot, said = describe("dual_disc.yaml")
        self.assertEqual([link.get("name") for link in robot.findall("link")], ["shaft_link"])
        self.assertEqual(robot.findall("joint"), [])
        self.assertEqual(said, "")

    def test_what_cannot_be_read_is_left_to_the_node(self):
        for config, overrides in (("absent.yaml", "[]"), ("bo105.yaml", "['subsystems.nobody.x=1']"), ("bo105.yaml", "['subsystems.rotor.blades=99']")):
            robot, said = describe(config, overrides)
            self.assertIn("drawing a usual rotor", said)
            self.assertEqual(len(robot.findall("joint")), 14)


if __name__ == "__main__":
    unittest.main()
