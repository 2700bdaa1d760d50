"""Which steps each method bears, and what film damping inside S changes."""
import math

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

from dual_disc_study.precision import LABELS, SPEEDS, STYLES, case_of
from dual_disc_study.runs import Case
from dual_disc_study.shaft import whirl
from lag_rotor_study.text import number, power, table

GRID = 1e-3                            # [s]; steps are whole parts of it
PARTS = (5, 6, 7, 8, 10, 12, 14, 17, 20, 24, 28, 33, 40, 50, 60, 70, 80, 90, 100, 104, 107, 110, 114, 120, 130, 150, 200, 300, 500)
COARSE = (5, 7, 10, 14, 20, 28, 40, 50, 70, 100, 130, 150, 200, 300, 500, 1000)
METHODS = {"Newmark": COARSE, "precise_2": COARSE[8:9] + tuple(n for n in PARTS if n >= 100), "HEERK3": PARTS, "HEERK3, moved": PARTS, "HEERK4": PARTS, "HEERK4, moved": PARTS}
FILM, MORE = "1034 N s/m", "1551 N s/m"
MORE_DAMPING = 1551.0                  # half as much again [N s/m]
SHOWN = (5, 10, 20, 28, 40, 80, 100, 107, 200)


def first_window(errors):
    """The last good and the first bad step from small steps upwards [s]: bad is a failed solution, or an error above 10⁻⁵."""
    good = 0.0
    for step, error in sorted(errors.items()):
        if error is None or error > 1e-5:
            return good, step
        good = step
    return good, math.inf


def step_limits(study, folder, checks):
    cases = {(name, speed): {GRID / n: case_of(name, speed, GRID / n, grid=GRID) for n in parts} for name, parts in METHODS.items() for speed in SPEEDS}
    for speed in SPEEDS:
        for method in ("HEERK3", "HEERK4"):
            cases[method + ", more", speed] = {GRID / n: Case(speed, method, GRID / n, moved=MORE_DAMPING, grid=GRID) for n in SHOWN}
    study.run_all([case for row in cases.values() for case in row.values()])
    errors = {key: {h: study.error(case) for h, case in row.items()} for key, row in cases.items()}

    figure, panels = plt.subplots(1, 2, figsize=(14, 6.2), sharey=True)
    for axis, speed in zip(panels, SPEEDS):
        for place, name in enumerate(METHODS):
            style, colour = STYLES[name]
            line = sorted(errors[name, speed].items())
            axis.loglog([h for h, _ in line], [math.nan if e is None else e for _, e in line], style, color=colour, ms=4, lw=1.2, label=LABELS.get(name, name))
            lost = [h for h, e in line if e is None]
            axis.plot(lost, [2.0 * 1.8 ** place] * len(lost), "x", color=colour, ms=5)
        axis.set(title=f"{speed} rpm", xlabel="step h [s]", ylim=(1e-12, 1e2))
        axis.axhline(1.0, color="0.6", lw=0.8)
        axis.grid(alpha=0.3)
    panels[0].set_ylabel("RMS error of disc 1, x (x: unstable, or the solver stalls)")
    panels[0].legend(fontsize=8, loc="lower right")
    figure.tight_layout()
    figure.savefig(folder / "step_limits.png", dpi=80)
    plt.close(figure)

    text = []
    for speed in SPEEDS:
        good, bad = first_window(errors["HEERK3", speed])
        text.append(f"{power(good)} to {power(bad)} s at {speed} rpm")
        checks.add(f"HEERK3 at {speed} rpm: the first window of instability begins between 9·10⁻⁶ and 10⁻⁵ s", 9e-6 <= good and bad <= 1.0001e-5, f"{power(good)} s good, {power(bad)} s not")
        for name in ("HEERK3, moved", "HEERK4", "HEERK4, moved"):
            worst = max(math.inf if e is None else e for e in errors[name, speed].values())
            checks.add(f"{LABELS.get(name, name)}, {speed} rpm: no step up to 2·10⁻⁴ s is unstable", worst < 1e-2, f"largest error {worst:.1e}")
        known = errors["precise_2", speed]
        last = max(h for h, e in known.items() if e is not None)
        first = min((h for h, e in known.items() if e is None), default=math.inf)
        checks.add(f"precise_2 at {speed} rpm is limited to about 9·10⁻⁶ s by its predictor", 8.5e-6 <= last <= first <= 9.6e-6, f"{power(last)} s runs, {power(first)} s does not")
    fastest = abs(whirl(0.0)[-1])
    columns = (("HEERK3", "HEERK3"), ("HEERK3, moved", f"HEERK3, {FILM}"), ("HEERK3, more", f"HEERK3, {MORE}"), ("HEERK4", "HEERK4"), ("HEERK4, moved", f"HEERK4, {FILM}"),
               ("HEERK4, more", f"HEERK4, {MORE}"))
    rows = [[power(GRID / n)] + [f"{number(errors[name, 5000].get(GRID / n))} / {number(errors[name, 40000].get(GRID / n))}".replace("n.c.", "unstable") for name, _ in columns] for n in SHOWN]
    return f"""## Which steps they bear

![Error over step](step_limits.png)

The explicit film force outside S drives HEERK3 unstable in windows; the last good and the first bad step of the first one: {"; ".join(text)}. It lies
around h omega = pi of the mode at 2.97·10⁵ rad/s (1.06·10⁻⁵ s), which the centred film would damp with 1300 1/s. With
`shaft.linearised_film_damping` a damper at the journal goes into S and the remainder gives it back: the shipped 1034 N s/m is 1.5 c0, c0 = k pi/2 = 689 N s/m the
damping of the centred film (k = mu R L³/c³ = 438.7 N s/m). No window is left, and errors fall, at 10⁻⁴ s those of HEERK4 by 40 at 5000 rpm and by 5 at 40000 rpm; half as much again,
1551 N s/m, is stable too but less accurate. HEERK4 is stable without.

The precise method's exponential is exact, but its states inside the step come from the classical Runge-Kutta method, whose limit is 2√2/|λ|max = {2 * math.sqrt(2) / fastest:.2e} s:
beyond it stiff modes are wrong first (the error grows 200 times from 3.3·10⁻⁶ to 5·10⁻⁶ s), and beyond about 9·10⁻⁶ s it is unstable. Only in
this range and above is Newmark's method more accurate at equal step. It is stable at every step.

Errors at 5000 / 40000 rpm:

""" + table(["step [s]"] + [label for _, label in columns], rows)
