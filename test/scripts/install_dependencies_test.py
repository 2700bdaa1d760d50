#!/usr/bin/python3
"""install_dependencies.sh asks apt only for what is missing, and says clearly what it cannot do. apt itself is replaced."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "install_dependencies.sh"
NEEDED = ("bash", "env", "sed", "grep", "cat")   # real programs the script may use


@unittest.skipIf(os.path.isdir("/opt/ros"), "with ROS in /opt/ros fewer packages are wanted")
class InstallDependencies(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.bin = pathlib.Path(directory.name)
        self.calls = self.bin / "calls"
        self.calls.touch()
        for program in NEEDED:
            (self.bin / program).symlink_to(shutil.which(program))
        self.program("id", "echo 0")
        self.program("apt-get", f'echo "apt-get $*" >>"{self.calls}"')
        self.program("apt-cache", "true")
        self.installed()

    def program(self, name, body):
        file = self.bin / name
        file.write_text(f"#!/bin/sh\n{body}\n", encoding="ascii")
        file.chmod(0o755)

    def installed(self, *missing):
        """dpkg-query then knows every package but these; it fails when one is unknown, as the real one does."""
        cases = "".join(f"{name}) failed=1; continue ;; " for name in missing)
        self.program("dpkg-query", 'shift 3; failed=0; for p; do case $p in '
                     f'{cases}*) echo "installed $p" ;; esac; done; exit $failed')

    def run_script(self, *sets):
        result = subprocess.run([SCRIPT, *sets], capture_output=True, text=True, check=False, env={"PATH": str(self.bin)})
        return result, self.calls.read_text(encoding="ascii").splitlines()

    def test_does_nothing_when_all_is_there(self):
        result, calls = self.run_script("test")
        self.assertEqual((result.returncode, result.stdout, result.stderr, calls), (0, "", "", []))

    def test_installs_only_what_is_missing(self):
        self.installed("cmake", "rosbash")
        result, calls = self.run_script("run")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(calls), 2)
        self.assertIn("update", calls[0])
        self.assertTrue(calls[1].endswith("install -y --no-install-recommends cmake rosbash"), calls[1])

    def test_rviz_is_installed_on_request_only(self):
        self.installed("rviz")
        self.assertEqual(self.run_script("run")[1], [])
        self.assertTrue(self.run_script("rviz")[1][1].endswith(" rviz"))

    def test_without_root_and_sudo_names_the_packages(self):
        self.installed("cmake")
        self.program("id", "echo 1000")
        result, calls = self.run_script("run")
        self.assertEqual((result.returncode, calls), (1, []))
        self.assertIn("no sudo", result.stderr)
        self.assertIn("apt-get install cmake", result.stderr)

    def test_uses_sudo_when_not_root(self):
        self.installed("cmake")
        self.program("id", "echo 1000")
        self.program("sudo", f'echo "sudo $1" >>"{self.calls}"; exec "$@"')
        result, calls = self.run_script("run")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(calls[0], "sudo env")

    def test_elsewhere_than_debian_names_the_packages(self):
        (self.bin / "dpkg-query").unlink()
        result, _ = self.run_script("run")
        self.assertEqual(result.returncode, 1)
        self.assertIn("not Debian or Ubuntu", result.stderr)
        self.assertIn("libroscpp-dev", result.stderr)

    def test_names_packages_the_release_does_not_offer(self):
        self.installed("catkin", "cmake")
        self.program("apt-cache", '[ "$2" != catkin ]')
        result, calls = self.run_script("run")
        self.assertEqual(result.returncode, 1)
        self.assertIn("does not offer: catkin", result.stderr)
        self.assertEqual(len(calls), 1)   # update, no installation

    def test_a_failed_installation_is_an_error(self):
        self.installed("cmake")
        self.program("apt-get", '[ "$4" != install ]')
        result, _ = self.run_script("run")
        self.assertEqual(result.returncode, 1)
        self.assertIn("still missing: cmake", result.stderr)

    def test_refuses_an_unknown_set(self):
        result, calls = self.run_script("everything")
        self.assertEqual((result.returncode, calls), (2, []))
        self.assertIn("unknown set 'everything'", result.stderr)


if __name__ == "__main__":
    unittest.main()
