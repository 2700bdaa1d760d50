"""Tables of the report, as Markdown."""
import statistics

from dual_disc_study import as_printed
from dual_disc_study.expected import AS_PRINTED, AT_END, REFERENCE, TABLE_3
from dual_disc_study.precision import LABELS, case_of
from dual_disc_study.runs import Case, DISC_1_TO_JOURNAL, NODES, SPEEDS, ratio, reference
from lag_rotor_study.text import close, number, power, table

STEP = 5e-7                             # of the paper's Table 3 [s]
METHODS = (("precise_1", STEP), ("precise_2", STEP), ("Newmark", STEP), ("HEERK4", 1e-5))
TIMED_STEPS, REPEATS = 8000, 7


def seconds(value):
    return f"{value:.3g}"


def table_3(study, checks, printed):
    errors, rows = {}, []
    cases = {(key, speed): Case(speed, *key, signals=NODES) for key in METHODS for speed in SPEEDS}
    study.run_all([reference(case) for case in cases.values()] + list(cases.values()))
    timed = {(key, speed): Case(speed, *key, duration=TIMED_STEPS * key[1], grid=0.0) for key in METHODS for speed in SPEEDS}
    times = study.step_times(list(timed.values()), REPEATS)
    for key in METHODS:
        for speed in SPEEDS:
            errors[key, speed] = as_printed.largest(study.run(cases[key, speed]).rows[:, 1:], as_printed.exact(study, speed))
    against = {(key, form): as_printed.largest(study.run(cases[key, 5000]).rows[:, 1:], printed[5000, 1e-7, form]) for key in METHODS for form in as_printed.FORMS}
    for key in METHODS:
        method, step = key
        cells = [method, power(step)]
        for place, speed in enumerate(SPEEDS):
            paper = TABLE_3.get(method)
            spent = statistics.median(times[timed[key, speed]]) * 0.1 / step
            cells += [f"{paper[place][0]:.1f}" if paper else "", f"{paper[place][1]:.5f}" if paper else "", seconds(spent), f"{100 * errors[key, speed]:.1e}"]
        rows.append(cells)
    ratios = [["paper, " + a + " / " + b] + [f"{TABLE_3[a][i][0] / TABLE_3[b][i][0]:.2f}" for i in range(3)] for a, b in (("precise_2", "precise_1"), ("Newmark", "precise_2"))]
    for a, b in (("precise_2", "precise_1"), ("Newmark", "precise_2")):
        ratios.append([f"ours, {a} / {b}"] + [f"{ratio(times, timed[(a, STEP), speed], timed[(b, STEP), speed]):.2f}" for speed in SPEEDS])
    fast = [STEP / 1e-5 * ratio(times, timed[("HEERK4", 1e-5), speed], timed[("Newmark", STEP), speed]) for speed in SPEEDS]
    checks.add("Table 3: precise_1 and precise_2 differ by round-off only", all(abs(errors[("precise_1", STEP), s] / errors[("precise_2", STEP), s] - 1.0) < 0.01 for s in SPEEDS),
               " / ".join(f"{errors[('precise_2', STEP), s]:.1e}" for s in SPEEDS))
    least = [min(min(times[timed[(name, STEP), s]]) for s in SPEEDS) for name in ("precise_2", "precise_1")]
    checks.add("Table 3: precise_2 takes at most 0.7 of the time of precise_1 (the paper: 0.82), shortest of all rounds", least[0] <= 0.7 * least[1], f"{least[0] / least[1]:.2f}")
    support = [max(study.errors(cases[("Newmark", STEP), s])[1][2:4]) for s in SPEEDS]
    checks.add("Table 3: at the paper's step the precise method is more accurate than Newmark's (the paper: less)", all(errors[("precise_2", STEP), s] < errors[("Newmark", STEP), s] for s in SPEEDS),
               " / ".join(f"{errors[('Newmark', STEP), s] / errors[('precise_2', STEP), s]:.0f} times" for s in SPEEDS))
    checks.add("Table 3: HEERK4 with 10⁻⁵ s takes less than a twentieth of the time of Newmark's method with 5·10⁻⁷ s", max(fast) < 0.05, " / ".join(f"1/{1 / part:.0f}" for part in fast))
    header = ["method", "step [s]"]
    for speed in SPEEDS:
        header += [f"{speed} rpm: paper, time [s]", "paper, error [%]", "time [s]", "error [%]"]
    shown = [[key[0]] + [f"{100 * against[key, form]:.1e}" for form in as_printed.FORMS] for key in METHODS]
    return """## Table 3: time and error

Largest error of x and y of all nodes between 0.08 and 0.1 s, in parts of the largest displacement of any node. Times are those of 0.1 s (the paper does not
say how long it integrates, so only ratios compare); medians of rounds over all methods.

HEERK4's row has a twentieth of Newmark's steps, without film damping in S. Its check (a twentieth of the time) was written when a step of Newmark's method took 2.5 times as long as
now; times at equal error, below, are what counts.

""" + table(header, rows) + "\n" + table(["ratio of times"] + [f"{speed} rpm" for speed in SPEEDS], ratios) + """
In parts of its own displacement (0.1 µm) the node at the rigid support is worst: it rings, and Newmark's method is off by """ + ", ".join(number(e) for e in support) + """ there.

The errors [%] at 5000 rpm again, but against the paper's reference (Newmark as printed, 10⁻⁷ s, tolerance 10⁻⁶), for both ways to evaluate it:

""" + table(["method", *as_printed.FORMS.values()], shown)


def methods(study, checks, printed):
    """Errors and times beside those of the implementation that the values of the model were found with."""
    timed = {(name, step): case_of(name, 5000, step, duration=TIMED_STEPS * step, grid=0.0) for name, step in REFERENCE}
    cases = {((name, step), speed): case_of(name, speed, step) for name, step in REFERENCE for speed in (5000, 40000)}
    study.run_all([reference(case) for case in cases.values()] + list(cases.values()))
    times = study.step_times(list(timed.values()), REPEATS)
    rows = []
    for key, (slow, high, spent) in REFERENCE.items():
        name, step = key
        found = [study.error(cases[key, speed]) for speed in (5000, 40000)]
        for speed, error, wanted in zip((5000, 40000), found, (slow, high)):
            if wanted is not None:
                checks.add(f"{LABELS.get(name, name)}, {power(step)} s, {speed} rpm: error {wanted:.1e} within a factor 2", close(error, wanted, 2.0), number(error))
        rows.append([LABELS.get(name, name), power(step), f"{slow:.1e} / {f'{high:.1e}' if high else ''}", " / ".join(number(e) for e in found), spent,
                     f"{1e6 * statistics.median(times[timed[key]]):.2f}", f"{1e6 * min(times[timed[key]]):.2f}"])
    off = [as_printed.rms(printed[speed, 1e-6, "residual"], as_printed.exact(study, speed), 4) for speed in (5000, 40000)]
    rows.append(["Newmark as printed, tolerance 10⁻⁶", power(1e-6), f"{AS_PRINTED[0]:.1e} / {AS_PRINTED[1]:.1e}", " / ".join(number(e) for e in off), 14.6, "", ""])
    tolerances = (1e-10, 1e-6, 1e-4, 1e-2)
    loose = [[power(t)] + [number(study.error(Case(speed, "Newmark", 1e-6, tolerance=t))) for speed in (5000, 40000)] for t in tolerances]
    modal = [study.error(Case(speed, "Newmark", 5e-6, settings=("subsystems.shaft.unbalance_in_exponential=true",))) for speed in (5000, 40000)]
    for speed, wanted in AT_END.items():
        end = study.run(reference(Case(speed, "HEERK4", 1e-5, signals=DISC_1_TO_JOURNAL))).rows[-1, 1:] * 1e3
        worst = max(abs(a - b) for a, b in zip(end, wanted)) / max(map(abs, wanted))
        checks.add(f"the reference agrees with that of the other implementation at 0.1 s, {speed} rpm: disc 1 and journal within 10⁻⁹", worst < 1e-9, f"{worst:.1e}")
    return """## Errors and times of a step

Beside an implementation of its own, on matrices of its own, written for this rotor alone. RMS error of disc 1, x, at 5000 / 40000 rpm. Times [µs], 5000 rpm: medians and
minima of rounds. A step of `simulate` goes through ports of exchangeable models.

""" + table(["method", "step [s]", "other: error", "ours: error", "other: time of a step", "ours: median", "ours: minimum"], rows) + f"""
Newmark's method of `simulate` starts each step from a prediction with its memory of the film's derivatives and still applies the correction that is
below the tolerance. So a tolerance of 10⁻⁶ is as good as none at all, and no tolerance shows the paper's 1.4·10⁻⁶ (step 10⁻⁶ s, errors at 5000, 40000 rpm):

""" + table(["newton_tolerance", "5000 rpm", "40000 rpm"], loose) + f"""
Newmark's method takes modal coordinates with the unbalance outside S (`unbalance_in_exponential: false`, its default). Inside S the phasor of the nominal azimuth would be a state, which
Newmark's method integrates with a phase error of its own: {number(modal[0])} and {number(modal[1])} instead of the errors above at 5·10⁻⁶ s.
"""
