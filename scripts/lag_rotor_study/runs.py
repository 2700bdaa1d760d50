"""Runs of `simulate`, and their errors against a reference."""
import concurrent.futures
import dataclasses
import json
import math
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
OMEGA = 6.63                                   # rotor speed [rad/s], as in the configuration files
DURATION = 10.0                                # [s]
DEGREE = math.radians(1.0) / OMEGA             # step of one degree of azimuth [s]
FINE, FINE_EVERY = 2.5e-5, 4                   # step of the references [s], and how many of them per recorded row
GRID = FINE * FINE_EVERY                       # instants at which a reference is known [s]
DEGREE_PARTS = 100                             # steps of the reference per degree of azimuth
NEWTON = 1e-14                                 # scaled residual: 1e-12 would limit Table 1 to 9e-10, because 1 - q amplifies it 682 times
PARALLEL = 2                                   # runs at the same time
STIFFNESSES = (3e4, 3e5, 3e6, 3e7, 3e8)        # K_s [N m/rad]
COUPLED, MONOLITHIC = "config/lag_rotor.yaml", "config/lag_rotor_monolithic.yaml"


@dataclasses.dataclass(frozen=True)
class Case:
    """One run. form: printed | absolute_lag (coupled system), paper | exact | exact0 (monolithic system; S_mon as printed,
    with the exact column at the initial lag angles, at zero lag angles)."""
    stiffness: float
    method: str
    form: str
    step: float            # [s]
    every: int = 1         # rows are recorded every so many steps
    blades: int = 1        # lag angles recorded

    def arguments(self):
        sets = {"simulation.integrator": self.method, "simulation.step": repr(self.step)}
        if self.form in ("printed", "absolute_lag"):
            config = COUPLED
            sets.update({"simulation.formulation": self.form, "simulation.newton_tolerance": repr(NEWTON), "subsystems.mast.stiffness": repr(self.stiffness)})
        else:
            config = MONOLITHIC
            sets.update({"subsystems.rotor.linear_part": self.form.rstrip("0"), "subsystems.rotor.mast_stiffness": repr(self.stiffness)})
            if self.form == "exact0":
                sets["subsystems.rotor.reference_lag"] = "0.0"
        # Rounded down to a whole number of recorded rows; a millionth of a row is round-off of the quotient.
        steps = self.every * math.floor(DURATION / (self.step * self.every) + 1e-6)
        return [str(ROOT / config), "--duration", repr(steps * self.step)] + [w for k, v in sets.items() for w in ("--set", f"{k}={v}")]


@dataclasses.dataclass
class Run:
    """What came of a case: lag is None when the solution failed, otherwise (rows, blades) [rad] with row 0 the start."""
    summary: dict
    lag: np.ndarray


class SimulateError(RuntimeError):
    """`simulate` did not understand what it was asked for, or could not write."""


class Study:
    """Runs cases, each once, and compares them with references."""

    def __init__(self, simulate, folder):
        self.simulate, self.folder, self.runs = simulate, pathlib.Path(folder), {}

    def execute(self, arguments):
        command = [self.simulate] + arguments + ["--json", "--quiet"]
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, check=False)
        if result.returncode not in (0, 3):
            raise SimulateError(f"exit status {result.returncode} of\n  {' '.join(command)}\n{result.stderr}")
        return result.returncode, json.loads(result.stdout)

    def record(self, case):
        file = self.folder / f"{abs(hash(case))}.csv"
        signals = ",".join(f"rotor.lag_{i + 1}" for i in range(case.blades))
        status, summary = self.execute(case.arguments() + ["--output", str(file), "--every", str(case.every), "--signals", signals])
        lag = None
        if status == 0:
            lag = np.loadtxt(file, delimiter=",", skiprows=1, usecols=range(3, 3 + case.blades), ndmin=2)
        file.unlink()
        return case, Run(summary, lag)

    def run_all(self, cases):
        todo = [case for case in dict.fromkeys(cases) if case not in self.runs]
        with concurrent.futures.ThreadPoolExecutor(PARALLEL) as pool:
            for number, (case, run) in enumerate(pool.map(self.record, todo), start=1):
                self.runs[case] = run
                if sys.stderr.isatty():
                    print(f"\r{number}/{len(todo)} runs", end="\n" if number == len(todo) else "", file=sys.stderr)

    def wall_time(self, case):
        """Of the step loop without recording, alone on the machine; the best of three [s]."""
        return min(self.execute(case.arguments())[1]["wall_time"] for _ in range(3))

    def error(self, case):
        """RMS error of phi_1 over the grid points 1..N, relative; None when not converged."""
        run = self.runs[case]
        if run.lag is None:
            return None
        known = reference(case)
        stride = round(case.step / (known.step * known.every))
        exact = self.runs[known].lag[::stride, 0]
        error = math.sqrt(np.sum((run.lag[1:, 0] - exact[1:len(run.lag)]) ** 2) / np.sum(exact[1:len(run.lag)] ** 2))
        return error if error <= 1.0 else None


def reference(case):
    """The case whose solution is taken as exact for this one: same grid, much smaller step."""
    if case.step == DEGREE:
        return Case(case.stiffness, "HEERK4", "absolute_lag", DEGREE / DEGREE_PARTS, DEGREE_PARTS)
    return Case(case.stiffness, "HEERK4", "absolute_lag", FINE, FINE_EVERY)
