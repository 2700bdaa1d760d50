#!/usr/bin/python3
"""Opens rviz with the view for the kind of machine that a configuration describes: shaft.rviz for a shaft with discs, else rotor.rviz."""
import argparse
import os
import pathlib
import sys

import yaml


def view(config):
    """Name of the view. A configuration that cannot be read is the node's to complain about."""
    try:
        subsystems = yaml.safe_load(pathlib.Path(config).read_text())["subsystems"].values()
        return "shaft.rviz" if any(s["type"] == "shaft_rotor" for s in subsystems) else "rotor.rviz"
    except (OSError, yaml.YAMLError, TypeError, KeyError, AttributeError):
        return "rotor.rviz"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("views", type=pathlib.Path, help="folder with rotor.rviz and shaft.rviz")
    parser.add_argument("config", help="configuration file of the node")
    arguments, for_rviz = parser.parse_known_args()
    sys.stdout.flush()
    os.execvp("rviz", ["rviz", "-d", str(arguments.views / view(arguments.config)), *for_rviz])


if __name__ == "__main__":
    main()
