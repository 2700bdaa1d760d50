"""Runs of newmark_as_printed in processes of their own, compared with references of `simulate`."""
import concurrent.futures
import math
import multiprocessing

import numpy as np

from dual_disc_study import newmark_as_printed
from dual_disc_study.runs import Case, END, GRID, NODES, STEADY, reference
from lag_rotor_study.runs import PARALLEL

TOLERANCE = 1e-6                        # the paper's
FORMS = {"residual": "corrections from the residual", "advance": "matrices multiplied in advance"}  # equal but for round-off
RUNS = ((5000, 1e-7, "residual"), (5000, 1e-7, "advance"), (5000, 2e-7, "advance"), (5000, 5e-7, "residual"), (40000, 1e-6, "residual"), (5000, 1e-6, "residual"))  # long ones first
STEADY_ROWS = slice(round(STEADY / GRID), None)


def solve(case):
    speed, step, form = case
    return newmark_as_printed.run(speed, step, TOLERANCE, END, GRID, form)[:, 1:] * 1e-3  # [m]


def run_all():
    """{(speed [rpm], step [s], form): x, y of all nodes [m] at the instants of a Case with NODES}."""
    with concurrent.futures.ProcessPoolExecutor(PARALLEL, multiprocessing.get_context("spawn")) as pool:
        return dict(zip(RUNS, pool.map(solve, RUNS)))


def exact(study, speed):
    """The same of the reference [m]."""
    return study.run(reference(Case(speed, "HEERK4", 1e-5, signals=NODES))).rows[:, 1:]


def rms(found, right, column):
    """RMS error of a column at steady state."""
    a, b = found[STEADY_ROWS, column], right[STEADY_ROWS, column]
    return math.sqrt(np.sum((a - b) ** 2) / np.sum(b ** 2))


def largest(found, right):
    """Largest error over all nodes at steady state, in parts of the largest displacement of any."""
    a, b = found[STEADY_ROWS], right[STEADY_ROWS]
    return float(np.max(np.abs(a - b)) / np.max(np.abs(b)))
