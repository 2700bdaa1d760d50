"""Error against step, order, error against time, and limits of the step."""
import math
import statistics

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from dual_disc_study.runs import Case, FILM_DAMPING
from fe_rotor_study.figures import slope
from lag_rotor_study.text import power, table

SPEEDS = (5000, 40000)
STYLES = {"Newmark": ("o-", "tab:blue"), "precise_2": ("^-", "tab:orange"), "precise_2, moved": ("^--", "tab:brown"), "HEERK3": ("s-", "tab:green"), "HEERK4": ("D-", "tab:red"),
          "HEERK3, moved": ("s--", "tab:olive"), "HEERK4, moved": ("D--", "tab:purple")}
LABELS = {f"{name}, moved": f"{name}, {FILM_DAMPING:.0f} N s/m in S" for name in ("HEERK3", "HEERK4", "precise_2")}
SWEEP = {"Newmark": (1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6, 5e-7, 2e-7, 1e-7), "precise_2": (5e-6, 4e-6, 2.5e-6, 2e-6, 1.25e-6, 1e-6, 5e-7),
         "precise_2, moved": (5e-6, 4e-6, 2.5e-6, 2e-6, 1.25e-6, 1e-6, 5e-7),
         "HEERK3": (5e-6, 4e-6, 2.5e-6, 2e-6, 1e-6), "HEERK4": (2e-4, 1e-4, 5e-5, 2.5e-5, 2e-5, 1.25e-5, 1e-5, 5e-6, 2.5e-6, 2e-6),
         "HEERK4, moved": (2e-4, 1e-4, 5e-5, 2.5e-5, 2e-5, 1.25e-5, 1e-5, 5e-6, 2.5e-6, 2e-6)}
ORDERS = (("Newmark", 2e-5, 1e-7, 2.0), ("precise_2", 2e-6, 5e-7, 4.0), ("HEERK3", 5e-6, 1e-6, 3.0), ("HEERK4", 2e-4, 5e-5, 4.0), ("HEERK4", 5e-5, 2e-6, 3.0))
LEVELS = (1e-5, 1e-6, 1e-7, 1e-8)      # errors at which times are compared
TIMED_STEPS, REPEATS = 4000, 5


def case_of(name, speed, step, **more):
    method, _, moved = name.partition(", ")
    return Case(speed, method, step, moved=FILM_DAMPING if moved else 0.0, **more)


def sweep(study):
    """{(name, speed): [(step, error)]} of the steps that succeed."""
    cases = {(name, speed): [case_of(name, speed, h) for h in steps] for name, steps in SWEEP.items() for speed in SPEEDS}
    study.run_all([case for row in cases.values() for case in row])
    return {key: [(c.step, e) for c in row if (e := study.error(c)) is not None] for key, row in cases.items()}


def times(study, errors):
    """{(name, speed, step): seconds per step, one per round} of the steps that succeed."""
    keys = [(name, speed, h) for (name, speed), points in errors.items() for h, _ in points]
    cases = {key: case_of(*key, duration=TIMED_STEPS * key[2], grid=0.0) for key in keys}
    found = study.step_times(list(cases.values()), REPEATS)
    return {key: found[case] for key, case in cases.items()}


def time_at(points, level):
    """Time for an error, straight between neighbours in the log-log plot; None outside."""
    for (t1, e1), (t2, e2) in zip(points, points[1:]):
        if min(e1, e2) <= level <= max(e1, e2) and e1 != e2:
            part = math.log(level / e1) / math.log(e2 / e1)
            return t1 * (t2 / t1) ** part
    return None


def work_precision(study, folder, checks):
    errors = sweep(study)
    seconds = times(study, errors)
    figure, panels = plt.subplots(2, 2, figsize=(13, 10), sharey=True)
    curves = {}
    for row, speed in zip(panels, SPEEDS):
        for name, (style, colour) in STYLES.items():
            if (name, speed) not in errors:
                continue
            known = errors[name, speed]
            curves[name, speed] = [(statistics.median(seconds[name, speed, h]) * 0.1 / h, e) for h, e in known]
            for axis, points in ((row[0], known), (row[1], curves[name, speed])):
                axis.loglog(*zip(*points), style, color=colour, ms=5, lw=1.3, label=LABELS.get(name, name))
        for order, at, e in ((2, 1e-6, 3e-6 if speed == 5000 else 1.2e-4), (4, 1e-4, 2e-9)):
            steps = np.array([at / 4, at])
            row[0].loglog(steps, e * (steps / at) ** order, color="0.55", lw=0.9)
            row[0].text(at * 1.1, e, f"order {order}", color="0.4", fontsize=8, va="center")
        row[0].set(xlabel="step h [s]", ylabel=f"RMS error of disc 1, x, {speed} rpm")
        row[1].set(xlabel="time of the step loop for 0.1 s [s]")
        for axis in row:
            axis.grid(alpha=0.3)
    figure.legend(*panels[0, 0].get_legend_handles_labels(), fontsize=9, loc="upper center", ncol=len(SWEEP))
    figure.tight_layout(rect=(0, 0, 1, 0.965))
    figure.savefig(folder / "work_precision.png", dpi=80)
    plt.close(figure)

    rows = []
    for speed in SPEEDS:
        for level in LEVELS:
            fast = [time_at(curves[name, speed], level) for name in ("HEERK4, moved", "HEERK4")]
            cells = [speed, power(level)] + [f"{1e3 * t:.2g}" if t else "-" for t in fast]
            # Film damping in S does not change what Newmark's method finds.
            for method, forms in (("Newmark", ("Newmark", "Newmark")), ("precise_2", ("precise_2, moved", "precise_2"))):
                slow = [time_at(curves[form, speed], level) for form in forms]
                cells += [f"{a / b:.0f}" if a and b else "-" for a, b in zip(slow, fast)]
                if slow[0] and fast[0] and level == 1e-6:
                    checks.add(f"{method} takes at least 30 times as long as HEERK4, both as shipped, for an error of 10⁻⁶ at {speed} rpm", slow[0] / fast[0] >= 30.0, f"{slow[0] / fast[0]:.0f} times")
            rows.append(cells)
    orders = []
    for name, high, low, order in ORDERS:
        found = [slope([(1.0 / h, e) for h, e in errors[name, speed]], 0.999 / high, 1.001 / low) for speed in SPEEDS]
        orders.append(f"{name} {found[0]:.2f} and {found[1]:.2f} ({power(high)} to {power(low)} s)")
        checks.add(f"{name}: order {order:.0f} or more between {power(high)} and {power(low)} s at 5000 rpm (at least {order - 0.3:.1f})", order - 0.3 <= found[0] <= order + 1.2, f"{found[0]:.2f}")
    finest = dict(errors["Newmark", 5000])[1e-7]
    checks.add("Newmark with a step of 10⁻⁷ s does not accumulate errors: at most 5·10⁻⁹ at 5000 rpm", finest <= 5e-9, f"{finest:.1e}")
    return f"""## Error against step and time

![Error against step and against time](work_precision.png)

Orders at 5000 and 40000 rpm by least squares: {"; ".join(orders)}. Nothing accumulates in Newmark's method down to 10⁻⁷ s, because `simulate` solves for accelerations.
HEERK4 integrates exactly whatever is linear, so that its error is that of the film force alone. Its order is 4 at large steps; below 5·10⁻⁵ s, where h omega of the two stiff
modes that move the journal (2.97·10⁵ and 9.94·10⁵ rad/s) falls from tens to one, with bumps where it comes near a multiple of 2 pi (1.25·10⁻⁵ s at 40000 rpm: 4 pi), its order is 3 on average.

Times are medians of {REPEATS} rounds over all methods, {TIMED_STEPS} steps each. How many times as long as HEERK4 the others take for the same error, all
as shipped, with {FILM_DAMPING:.0f} N s/m of the film's damping in S (`linearised_film_damping`), and all with none in S (which changes nothing of what Newmark's method finds):

""" + table(["rpm", "error", "HEERK4 [ms]", "none in S [ms]", "Newmark / HEERK4", "Newmark / none in S", "precise_2 / HEERK4", "precise_2 / none in S"], rows)
