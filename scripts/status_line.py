#!/usr/bin/python3
"""Shows what the node does: simulated time, real-time factor, overruns; thrust and lag amplitude, or disc amplitude and journal eccentricity.

On a terminal one line is rewritten; otherwise a line is printed every few seconds. Warnings of the node appear above it.
Exit status: 0 after --duration or Ctrl-C, 1 when the ROS master cannot be reached.
"""
import argparse
import collections
import math
import shutil
import signal
import sys
import threading
import time

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from heerk_rotor.msg import RotorState, ShaftState
from rosgraph_msgs.msg import Log

WINDOW = 2.0       # [s] of wall time over which real-time factor and amplitudes are formed
SAMPLING = 0.01    # [s] at most one message in this time is decoded; the others cost next to nothing


class Samples:
    """The last seconds of a state topic, thinned out."""

    def __init__(self, message_type):
        self.message_type = message_type
        self.lock = threading.Lock()
        self.entries = collections.deque()   # (wall time, message)
        self.next = 0.0

    def receive(self, raw):
        now = time.monotonic()
        if now < self.next:
            return
        self.next = now + SAMPLING
        message = self.message_type().deserialize(raw._buff)  # pylint: disable=protected-access
        with self.lock:
            self.entries.append((now, message))
            while now - self.entries[0][0] > WINDOW:
                self.entries.popleft()

    def window(self):
        with self.lock:
            return list(self.entries)


def real_time_factor(entries):
    """Simulated over wall time, or None while there is too little of it."""
    if len(entries) < 2 or entries[-1][0] - entries[0][0] < 0.2:
        return None
    return (entries[-1][1].sim_time - entries[0][1].sim_time) / (entries[-1][0] - entries[0][0])


def half_range(series):
    return 0.5 * (max(series) - min(series)) if series else 0.0


def timing_text(entries):
    factor = real_time_factor(entries)
    last = entries[-1][1]
    stale = time.monotonic() - entries[-1][0]
    pace = "no new states" if stale > 1.0 else "real-time factor -----" if factor is None else f"real-time factor {factor:5.3f}"
    return f"t {last.sim_time:9.2f} s | {pace} | overruns {last.overruns}"


def rotor_text(entries):
    """Amplitude: half the range of the blade that moves most, over the window."""
    last = entries[-1][1]
    lag = max((half_range([m.lag[k] for _, m in entries if len(m.lag) > k]) for k in range(len(last.lag))), default=0.0)
    return (f"{timing_text(entries)} | thrust {last.hub.force.z / 1e3:6.2f} kN | lag amplitude {math.degrees(lag):6.3f} deg"
            f" | collective {math.degrees(last.collective):5.2f} deg (command: {last.command_source or 'none'})")


def shaft_text(entries):
    """Amplitude: half the range of the disc that moves most, over the window; eccentricity in parts of the clearance."""
    last = entries[-1][1]
    orbit = max((half_range([m.disc_x[k] for _, m in entries if len(m.disc_x) > k]) for k in range(len(last.disc_x))), default=0.0)
    eccentricity = max(m.eccentricity_ratio for _, m in entries)
    return (f"{timing_text(entries)} | {last.rotor_speed * 30 / math.pi:7.0f} rpm | disc amplitude {orbit * 1e6:7.2f} um"
            f" | journal eccentricity {last.eccentricity_ratio:5.3f} (most {eccentricity:5.3f})")


class Display:
    """One rewritten line on a terminal, else a line every few seconds; whole lines in between."""

    def __init__(self, interval):
        self.terminal = sys.stdout.isatty()
        self.interval = interval if interval else (0.2 if self.terminal else 5.0)
        self.lock = threading.Lock()
        self.text = ""

    def show(self, text):
        if self.terminal:  # a wrapped line could not be rewritten
            text = text[: shutil.get_terminal_size().columns - 1]
        with self.lock:
            self.text = text
            print(f"\r\x1b[K{text}" if self.terminal else text, end="" if self.terminal else "\n", flush=True)

    def line(self, text):
        with self.lock:
            print(f"\r\x1b[K{text}\n{self.text}" if self.terminal else text, end="" if self.terminal else "\n", flush=True)

    def end(self):
        if self.terminal and self.text:
            print(flush=True)


class Node:
    """What is known about the node: its states, warnings and whether it has shown up."""

    def __init__(self, display):
        self.display = display
        self.rotor, self.shaft = Samples(RotorState), Samples(ShaftState)
        self.first_sign = None          # wall time of the first message
        self.diagnosed = {}             # name -> last summary that was shown
        for topic, samples in (("rotor/state", self.rotor), ("shaft/state", self.shaft)):
            rospy.Subscriber(topic, rospy.AnyMsg, self.sign_of_life(samples.receive), tcp_nodelay=True)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.sign_of_life(self.diagnose))
        rospy.Subscriber("/rosout_agg", Log, self.report)

    def sign_of_life(self, callback):
        def receive(message):
            if self.first_sign is None:
                self.first_sign = time.monotonic()
            callback(message)
        return receive

    def diagnose(self, array):
        for status in array.status:
            level = status.level if isinstance(status.level, int) else status.level[0]
            summary = (level, status.message)
            if level > 0 and self.diagnosed.get(status.name) != summary:
                self.display.line(f"[{'warning' if level == 1 else 'error'}] {status.name}: {status.message}")
            self.diagnosed[status.name] = summary

    def report(self, log):
        if log.level >= Log.WARN and log.name != rospy.get_name():
            self.display.line(f"[{'warning' if log.level == Log.WARN else 'error'}] {log.name}: {log.msg}")

    def text(self):
        rotor, shaft = self.rotor.window(), self.shaft.window()
        if rotor:
            return rotor_text(rotor)
        return shaft_text(shaft) if shaft else "waiting for rotor/state or shaft/state"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--duration", type=float, default=math.inf, metavar="S", help="end S seconds after the first message")
    parser.add_argument("--interval", type=float, metavar="S", help="time between updates (0.2 s on a terminal, else 5 s)")
    arguments = parser.parse_args(rospy.myargv()[1:])

    ended = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: ended.set())
    if not rosgraph.is_master_online():
        print(f"status_line: no ROS master at {rosgraph.get_master_uri()}", file=sys.stderr)
        return 1
    rospy.init_node("status_line", anonymous=True, disable_signals=True)
    display = Display(arguments.interval)
    node = Node(display)
    while True:
        left = math.inf if node.first_sign is None else node.first_sign + arguments.duration - time.monotonic()
        if left <= 0 or ended.wait(min(display.interval, left)):
            break
        display.show(node.text())
    display.end()
    return 0


if __name__ == "__main__":
    sys.exit(main())
