#!/usr/bin/python3
"""The view that rviz opens with follows the configuration."""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import open_rviz  # noqa: E402


class OpenRviz(unittest.TestCase):
    def test_each_kind_of_machine_has_its_view(self):
        self.assertEqual(open_rviz.view(ROOT / "config" / "dual_disc.yaml"), "shaft.rviz")
        for config in ("bo105.yaml", "lag_rotor.yaml"):
            self.assertEqual(open_rviz.view(ROOT / "config" / config), "rotor.rviz")

    def test_what_cannot_be_read_is_left_to_the_node(self):
        self.assertEqual(open_rviz.view("/nowhere.yaml"), "rotor.rviz")

    def test_the_views_exist(self):
        for name in ("rotor.rviz", "shaft.rviz"):
            self.assertTrue((ROOT / "rviz" / name).is_file(), name)


if __name__ == "__main__":
    unittest.main()
