#!/usr/bin/python3
"""Checks which room includes which: the library must not know ROS, LCM or the programs above it.

usage: check_includes.py [SOURCE_DIR]      exit status 0: in order, 1: violations (one line each), 2: not a source tree
"""
import pathlib
import re
import sys

# Room -> rooms whose headers it may include (its own always). A room missing here is an error.
ROOMS = {
    "core": set(),
    "beam": set(),
    "aero": {"core"},
    "shaft": {"core"},
    "config": {"core"},  # nearest_name: the hints of both are spelled the same way
    "solve": {"core"},
    "integrate": {"core", "solve"},
    "models": {"core", "beam", "aero", "shaft", "config"},
    "assembly": {"core", "solve", "integrate", "beam", "aero", "shaft", "models", "config"},
    "analysis": {"core", "solve", "integrate", "config", "assembly"},
    "realtime": {"core", "solve", "integrate", "assembly"},  # assembly: RotorReading is what travels through the rings
    "lcm": {"core", "solve", "integrate", "beam", "aero", "shaft", "models", "config", "assembly", "realtime"},
    "ros": {"core", "solve", "integrate", "beam", "aero", "shaft", "models", "config", "assembly", "analysis", "realtime", "lcm"},
    "tools": {"core", "solve", "integrate", "beam", "aero", "shaft", "models", "config", "assembly", "analysis", "realtime", "lcm", "ros"},
}

# Headers from outside: pattern -> rooms that may include them. What matches nothing (Eigen, the standard library) is free.
EXTERNAL = [
    (re.compile(r"ros/|rosbag/|rosgraph_msgs/|tf2\w*/|diagnostic_updater/|\w+_msgs/|std_srvs/|heerk_rotor/\w+\.h$"),
     "ROS", {"ros", "tools"}),
    (re.compile(r"lcm/|heerk_rotor/\w+_t\.hpp$"), "LCM", {"lcm", "ros", "tools"}),
    (re.compile(r"yaml-cpp/"), "yaml-cpp", {"config"}),
    (re.compile(r"CLI/|CLI11"), "CLI11", {"tools"}),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
OWN = re.compile(r"heerk_rotor/(\w+)/(.+)")


def violation(source_dir, file, room, header):
    """Why `file` of `room` must not include `header`, or None."""
    own = OWN.fullmatch(header)
    if own:
        other = own.group(1)
        if not (source_dir / "include" / header).is_file():
            return "there is no such header"
        if other != room and other not in ROOMS[room]:
            return f"{room} may include {', '.join(sorted(ROOMS[room] | {room}))}, not {other}"
        return None
    for pattern, name, rooms in EXTERNAL:
        if pattern.match(header):
            return None if room in rooms else f"{name} belongs to {', '.join(sorted(rooms))}, not to {room}"
    local = (file.parent / header).resolve()
    if local.is_file() and local.parent != file.parent.resolve():
        return "reaches into another directory; put the header under include/heerk_rotor"
    return None


def check(source_dir):
    """All violations as lines `file:line: room includes header: why`, and the number of files read."""
    problems, count = [], 0
    for top in (source_dir / "include" / "heerk_rotor", source_dir / "src"):
        for file in sorted(p for p in top.rglob("*") if p.suffix in (".hpp", ".h", ".cpp")):
            count += 1
            where = file.relative_to(source_dir)
            room = file.relative_to(top).parts[0]
            if room not in ROOMS:
                problems.append(f"{where}:1: '{room}' is not a room; known are {', '.join(ROOMS)}")
                continue
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
                match = INCLUDE.match(line)
                reason = match and violation(source_dir, file, room, match.group(1))
                if reason:
                    problems.append(f"{where}:{number}: {room} includes {match.group(1)}: {reason}")
    return problems, count


def main():
    source_dir = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    problems, count = check(source_dir)
    if count == 0:
        print(f"check_includes: found no source files below {source_dir}", file=sys.stderr)
        return 2
    print("\n".join(problems + [f"check_includes: {count} files, {len(problems)} violations"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
