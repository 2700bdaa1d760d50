#!/usr/bin/python3
"""Runs a program and writes its exit status to a file, because roslaunch does not tell it.

usage (as launch-prefix): report_exit.py FILE PROGRAM [ARGUMENT]...
A program ended by signal N counts as 128 + N.
"""
import signal
import subprocess
import sys


def main():
    file, command = sys.argv[1], sys.argv[2:]
    # roslaunch signals the whole process group: the program decides what to do, this one only waits. Handlers (other than
    # "ignore") are not inherited, so the program starts with the default ones.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: None)
    code = subprocess.call(command)
    status = code if code >= 0 else 128 - code
    with open(file, "w", encoding="ascii") as stream:
        stream.write(f"{status}\n")
    return status


if __name__ == "__main__":
    sys.exit(main())
