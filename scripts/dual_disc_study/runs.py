"""Runs of `simulate` with the dual-disc rotor, their errors against a reference, and the time of a step."""
import dataclasses
import math
import statistics
import threading

import numpy as np

from lag_rotor_study import runs as common
from lag_rotor_study.runs import ROOT, SimulateError  # noqa: F401

CONFIG = "config/dual_disc.yaml"
SPEEDS = (5000, 25000, 40000)          # of the paper's Figure 3 and Table 3 [rpm]
END, STEADY = 0.1, 0.08                # errors are taken between STEADY and END [s]
GRID = 1e-4                            # at multiples of this, or of the step if that is larger [s]
CONVERGED = 1e-10                      # tolerance of Newmark's iteration, the default of `simulate`: at 1e-7 s a looser one costs digits
DISC_1 = ("shaft.disc_1_x",)
DISC_1_TO_JOURNAL = ("shaft.disc_1_x", "shaft.disc_1_y", "shaft.journal_x", "shaft.journal_y")
NODES = tuple(f"shaft.node_{k}_{axis}" for k in range(9) for axis in "xy")
FILM_DAMPING = 1034.0                  # 1.5 times that of the centred film [N s/m]


@dataclasses.dataclass(frozen=True)
class Case:
    """One run from rest. The precise methods take the paper's physical coordinates, the others modal ones, Newmark's with the unbalance outside S."""
    speed: float                        # [rpm]
    method: str
    step: float                         # [s]
    tolerance: float = CONVERGED        # of Newmark
    moved: float = 0.0                  # film damping in S [N s/m]; as shipped FILM_DAMPING
    signals: tuple = DISC_1
    duration: float = END               # [s]
    grid: float = GRID                  # instants that are recorded, none if 0 [s]
    coordinates: str = ""               # other than usual
    settings: tuple = ()

    @property
    def every(self):
        return max(1, round(self.grid / self.step))

    def model(self):
        """Arguments without the length of the run."""
        coordinates = self.coordinates or ("physical" if self.method.startswith("precise") else "modal")
        sets = [f"simulation.integrator={self.method}", f"simulation.step={self.step!r}", f"simulation.rotor_speed_rpm={self.speed!r}",
                f"simulation.newton_tolerance={self.tolerance!r}", f"subsystems.shaft.coordinates={coordinates}",
                f"subsystems.shaft.linearised_film_damping={self.moved!r}", *self.settings]
        return [str(ROOT / CONFIG)] + [word for setting in sets for word in ("--set", setting)]

    def arguments(self):
        steps = self.every * math.floor(self.duration / (self.step * self.every) + 1e-6)
        return self.model() + ["--duration", repr(steps * self.step)]


def reference(case):
    """The case whose solution counts as exact."""
    return Case(case.speed, "HEERK4", 1e-6, signals=case.signals, duration=case.duration, grid=case.grid, settings=case.settings)


@dataclasses.dataclass
class Run:
    """rows is None when the solution failed, otherwise time and signals, row 0 the start."""
    summary: dict
    rows: np.ndarray

    @property
    def time(self):
        return self.rows[:, 0]


class Study(common.Study):
    """Runs cases, each once, and compares them with references; times others."""

    def __init__(self, simulate, folder):
        super().__init__(simulate, folder)
        self.count, self.files, self.lock = 0, 0, threading.Lock()

    def execute(self, arguments):
        with self.lock:
            self.count += 1
        return super().execute(arguments)

    def record(self, case):
        with self.lock:
            self.files += 1
            file = self.folder / f"{self.files}.csv"
        status, summary = self.execute(case.arguments() + ["--output", str(file), "--every", str(case.every), "--signals", ",".join(case.signals)])
        rows = None
        if status == 0:
            with open(file) as opened:
                wide = len(opened.readline().split(","))
                rows = np.loadtxt(opened, delimiter=",", usecols=[1, *range(wide - len(case.signals), wide)], ndmin=2)
        file.unlink()
        return case, Run(summary, rows)

    def run(self, case):
        self.run_all([case])
        return self.runs[case]

    def errors(self, case, exact=None):
        """RMS and largest error of each signal between STEADY and END, in parts of RMS and largest magnitude of the reference; None when it failed or exceeds 1."""
        run, known = self.run(case), self.run(exact or reference(case))
        if run.rows is None or not np.all(np.isfinite(run.rows)):
            return None
        stride = max(1, round(case.step / case.grid))
        right = known.rows[::stride][:len(run.rows)]
        steady = right[:, 0] > STEADY - 1e-9
        assert np.allclose(right[:, 0], run.time, rtol=0.0, atol=1e-9)
        difference, right = (run.rows - right)[steady, 1:], right[steady, 1:]
        with np.errstate(over="ignore"):
            rms = np.sqrt(np.sum(difference ** 2, axis=0) / np.sum(right ** 2, axis=0))
        largest = np.max(np.abs(difference), axis=0) / np.max(np.abs(right), axis=0)
        return (rms, largest) if np.max(rms) <= 1.0 else None

    def error(self, case, exact=None):
        """RMS error of the first signal."""
        found = self.errors(case, exact)
        return None if found is None else float(found[0][0])

    def step_times(self, cases, repeats):
        """Wall time per step of each case [s], one list per case with a number per round. Rounds run all cases one after the other, so
        that other load on the machine meets all of them, and ratios within a round can be compared."""
        found = {case: [] for case in cases}
        for _ in range(repeats):
            for case in cases:
                _, summary = self.execute(case.arguments())
                found[case].append(summary["wall_time"] / summary["steps"])
        return found


def ratio(times, above, below):
    """Median over the rounds of the ratio of two cases' times."""
    return statistics.median(a / b for a, b in zip(times[above], times[below]))
