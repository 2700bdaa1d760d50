#!/usr/bin/python3
"""The include check accepts what the architecture allows and names what it forbids."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_includes.py"


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.tree = pathlib.Path(directory.name)
        self.write("include/heerk_rotor/core/types.hpp", "#include <Eigen/Core>")
        self.write("include/heerk_rotor/ros/node.hpp", "#include <ros/ros.h>")

    def write(self, name, text):
        file = self.tree / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("#pragma once\n" + text + "\n", encoding="utf-8")

    def run_check(self):
        return subprocess.run([sys.executable, SCRIPT, self.tree], capture_output=True, text=True, check=False)

    def expect_violation(self, file, header, reason):
        self.write(file, f"#include {header}")
        result = self.run_check()
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(f"{file}:2:", result.stdout)
        self.assertIn(reason, result.stdout)

    def test_accepts_allowed_directions(self):
        self.write("src/solve/newton.cpp", '#include "heerk_rotor/core/types.hpp"\n#include "newton_parts.hpp"\n#include <vector>')
        self.write("src/solve/newton_parts.hpp", "")
        self.write("src/ros/node.cpp", '#include "heerk_rotor/ros/node.hpp"\n#include <heerk_rotor/RotorState.h>')
        result = self.run_check()
        self.assertEqual(result.returncode, 0, result.stdout)

    def test_refuses_upward_include(self):
        self.expect_violation("src/core/graph.cpp", '"heerk_rotor/ros/node.hpp"', "not ros")

    def test_refuses_ros_in_the_library(self):
        self.expect_violation("src/integrate/step.cpp", "<ros/time.h>", "ROS belongs to ros, tools")

    def test_refuses_generated_message_in_the_library(self):
        self.expect_violation("src/realtime/loop.cpp", "<heerk_rotor/RotorState.h>", "ROS belongs to")

    def test_refuses_lcm_type_in_the_library(self):
        self.expect_violation("src/models/rotor.cpp", "<heerk_rotor/rotor_state_t.hpp>", "LCM belongs to")

    def test_refuses_missing_header(self):
        self.expect_violation("src/core/graph.cpp", '"heerk_rotor/core/absent.hpp"', "no such header")

    def test_refuses_reaching_into_another_room(self):
        self.write("src/core/secret.hpp", "")
        self.expect_violation("src/solve/newton.cpp", '"../core/secret.hpp"', "reaches into another directory")

    def test_refuses_unknown_room(self):
        self.write("src/utils/many.cpp", "")
        result = self.run_check()
        self.assertEqual(result.returncode, 1)
        self.assertIn("'utils' is not a room", result.stdout)

    def test_a_tree_without_sources_is_an_error(self):
        self.tree = self.tree / "empty"
        self.tree.mkdir()
        self.assertEqual(self.run_check().returncode, 2)


if __name__ == "__main__":
    unittest.main()
