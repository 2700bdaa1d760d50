"""Runs of `simulate` with the elastic rotor over one revolution, and their errors."""
import csv
import json
import math
import pathlib
import re
import subprocess

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CONFIG = "config/bo105.yaml"
REVOLUTION = 2.0 * math.pi / 44.40             # [s]
POLARS = {"linear": ["subsystems.airloads.polar=linear"],
          "tables, cubic": ["subsystems.airloads.interpolation=monotone_cubic"],
          "tables, bilinear": ["subsystems.airloads.interpolation=linear"]}
UPRIGHT = ["subsystems.fuselage.shaft_tilt_forward_deg=0.0"]  # blades in hover do not move: the start is smooth
REFERENCE_STEPS = 30000                        # HEERK4, per revolution
RAMP_STEPS, RAMP_REVOLUTIONS = 4000, 3         # per revolution; the commands move during the first two
COMMANDS = {"collective": (0.12, 0.14), "lateral_cyclic": (0.0, 0.02), "longitudinal_cyclic": (0.0, -0.03)}  # [rad] from, to

# State and outputs whose error counts, in groups of one scale: the diagonal matrix D of the paper's norm is 1 / (largest magnitude in the
# group during the revolution).
GROUPS = (r"rotor\.lag_\d", r"rotor\.flap_\d", r"rotor\.lag_rate_\d", r"rotor\.flap_rate_\d", r"rotor\.tip_twist_\d", r"rotor\.rotor_force_.",
          r"rotor\.tilting_moment_.", r"rotor\.root_force_.*", r"rotor\.root_moment_.*", r"airloads\.load_\d+_[xyz]_\d", r"inflow\..*", r"mast\.twist")


class SimulateError(RuntimeError):
    """`simulate` did not understand what it was asked for, or could not write."""


class Study:
    """Runs cases, each once, all from the same smooth start (per kind of airloads), and compares them with references."""

    def __init__(self, simulate, folder):
        self.simulate, self.folder = simulate, pathlib.Path(folder)
        self.starts, self.cases, self.scales, self.count = {}, {}, {}, 0

    def execute(self, arguments, settings):
        command = [self.simulate, str(ROOT / CONFIG), "--json", "--quiet"] + [str(a) for a in arguments]
        if not any(setting.startswith("simulation.start=") for setting in settings):
            settings = ["simulation.start=none"] + list(settings)
        command += [word for setting in settings for word in ("--set", setting)]
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, check=False)
        self.count += 1
        if result.returncode not in (0, 3):
            raise SimulateError(f"exit status {result.returncode} of\n  {' '.join(command)}\n{result.stderr}")
        return result.returncode, json.loads(result.stdout)

    def start(self, airloads, more=()):
        """Start file of a system with the settings `more`: from rest in hover, reached with strong structural damping, into a state with cyclic pitch by a polynomial in time."""
        key = (airloads, tuple(more))
        if key not in self.starts:
            rest, ramp, start = (self.folder / f"{name} {len(self.starts)}" for name in ("rest.yaml", "ramp.csv", "start.yaml"))
            hold = self.folder / "hold.csv"
            hold.write_text("time," + ",".join(COMMANDS) + "\n" + ",".join(repr(v) for v in [0.0] + [a for a, _ in COMMANDS.values()]) + "\n")
            common = POLARS[airloads] + UPRIGHT + list(more)
            self.execute(["--revolutions", 60, "--commands", hold, "--save-start", rest], common + ["simulation.azimuth_step_deg=1.0", "subsystems.rotor.damping_mass=60.0"])
            with open(ramp, "w") as file:
                file.write("time," + ",".join(COMMANDS) + "\n")
                for k in range(2 * RAMP_STEPS + 1):
                    s = min(1.0, (k + 0.5) / (2 * RAMP_STEPS))
                    part = s ** 4 * (35 - 84 * s + 70 * s ** 2 - 20 * s ** 3)
                    values = [a + part * (b - a) for a, b in COMMANDS.values()]
                    file.write(",".join(repr(v) for v in [(k - 0.1) * REVOLUTION / RAMP_STEPS if k else 0.0] + values) + "\n")
            self.execute(["--revolutions", RAMP_REVOLUTIONS, "--commands", ramp, "--save-start", start],
                         common + [f"simulation.start={rest}", f"simulation.azimuth_step_deg={360 / RAMP_STEPS!r}", "simulation.newton_tolerance=1e-13"])
            self.starts[key] = start
        return self.starts[key]

    def settings(self, airloads, method, steps, more=(), sudden=False):
        chosen = POLARS[airloads] + UPRIGHT + [f"simulation.integrator={method}", f"simulation.azimuth_step_deg={360 / steps!r}"] + list(more)
        return chosen if sudden else chosen + [f"simulation.start={self.start(airloads, more)}"]

    def run(self, airloads, method, steps, more=(), rows=1, sudden=False):
        """(names, values: one row per recorded instant) of one revolution, None when the solution failed."""
        case = (airloads, method, steps, tuple(more), rows, sudden)
        if case not in self.cases:
            file = self.folder / "run.csv"
            settings = self.settings(airloads, method, steps, more, sudden) + ["simulation.newton_tolerance=1e-14"]
            status, _ = self.execute(["--revolutions", 1, "--every", steps // rows, "--output", file, "--signals", "all"], settings)
            found = None
            if status == 0:
                with open(file, newline="") as opened:
                    lines = list(csv.reader(opened))
                found = [re.sub(r" \[.*", "", name) for name in lines[0]], np.array(lines[1:], dtype=float)
            file.unlink()
            self.cases[case] = found
        return self.cases[case]

    def error(self, airloads, method, steps, more=(), sudden=False):
        """Weighted norm of the error at the end of the revolution; None when it failed or exceeds 1."""
        run = self.run(airloads, method, steps, more, sudden=sudden)
        if run is None:
            return None
        key = (airloads, tuple(more), sudden)
        if key not in self.scales:
            names, rows = self.run(airloads, "HEERK4", REFERENCE_STEPS, more, rows=60, sudden=sudden)
            groups = [[i for i, name in enumerate(names) if re.fullmatch(pattern, name)] for pattern in GROUPS]
            largest = [np.max(np.abs(rows[:, group]), initial=0.0) for group in groups]
            self.scales[key] = [(g, s) for g, s in zip(groups, largest) if s > 0.0], rows[-1]
        groups, exact = self.scales[key]
        error = math.sqrt(np.mean([np.mean(((run[1][-1, group] - exact[group]) / scale) ** 2) for group, scale in groups]))
        return error if error <= 1.0 else None

    def counts(self, airloads, method, steps, settings):
        status, result = self.execute(["--evaluation-counts"], self.settings(airloads, method, steps) + settings)
        if status != 0:
            return None
        return result["evaluations"]
