"""Targets and the Markdown text."""
import datetime
import pathlib
import re
import subprocess
import textwrap

from lag_rotor_study.text import Checks, power, table
from work_precision_study import builds
from work_precision_study.curves import ALL, LEVELS, LIBRARIES, OTHERS, OURS
from work_precision_study.figures import title

KINDS = {"lag_rotor": "Lag rotor", "blades": "Elastic blades", "rotor": "Complete elastic rotor", "dual_disc": "Dual-disc rotor"}
AT_MOST = {"lag_rotor": 3.0, "blades": 10.0, "rotor": 10.0}   # of the best library's CPU time, one part in ..
AT_MOST_OF_NEWMARK = 20.0                                     # dual disc
TARGET_LEVELS = (1e-3, 1e-5)

METHOD = """All methods integrate the same coupled system by the same code: libraries receive f(t, x) with the algebraic part solved inside, ARKODE's additive
methods S x and f - S x separately. Time is the CPU time of the process for one integration without set-up, median of three measurements of at least 10 ms each;
integrations of more than 0.3 s are measured once, and the first of them ends a curve (2.4 s at K_s = 3e8). Steps and tolerances are swept. Error: root mean square
over ports of the root mean square, over entries and instants, of the difference from the reference, in parts of the port's largest magnitude. References are
explicit Runge-Kutta solutions of order 8 (ARKODE, tolerance 10⁻¹³, stopping at each instant), which share no step code with ours; what separates them from HEERK4
with a very small step is given. Times at equal error are interpolated in the log-log plot, separately for each setting, and the best setting of each method counts.
≤: the largest step or tolerance tried is more accurate than that already. -: not reached within the limit of time."""

SETTINGS = """Libraries got: absolute tolerances from the largest magnitude of all states of one unit, no limit on the number of steps, dense output for the instants;
CVODE, ARKODE DIRK and IMEX a linear solver written for the structure of S (2x2 blocks; Newton's matrix for the first two, exact for IMEX), which no user has without
writing it, and the dense Jacobian by differences as the alternative; BDF all orders, up to 2 (above, it is unstable for undamped oscillations) and with the
library's stability limit detection; ARKODE tables of order 3 to 8. IDA solves the DAE itself, states and loop outputs, with its dense Jacobian. Boost.odeint:
`dopri5` with dense output, states in parts of their magnitudes. Generalized-alpha: spectral radius 0.9 and 0.6, Newton with the constant S. Truncated RK4 keeps so
few modes of each blade that classical RK4 is stable; its error counts against the full solution."""

WHY = """The libraries that come this near were handed a solver for S, and the motion is smooth: at a loose tolerance their implicit methods step with the motion and
not with the modes, as HEERK4 does. What then remains is the number of evaluations of the loads (last columns). Without that solver the libraries are where the rows
"best library without solver for S" put them. As the tolerance gets tighter their steps shrink faster than those of HEERK4, and BDF with all orders jumps to
thousands of steps without gain in accuracy, which BDF up to order 2 does not (order 3 and above is unstable on oscillations). On the complete rotor HEERK4 needs
more steps per revolution than on blades alone: root forces of fast modes accelerate the fuselage, which accelerates all blades, stiffness that is in no subsystem's S
(with the fuselage held the error at 30 steps is a quarter). Below 19 steps per revolution its step is unstable in windows (`simulate --stability`: 8, 10, .., 18 steps):
errors at 10 steps are those of one revolution only."""

MEANINGS = {
    "lag_rotor": """`config/lag_rotor.yaml`, absolute-lag form, 10 s from a lag angle of 0.01 rad. Stiff is one undamped oscillation, the twist of the mast (102, 1020
and 10 199 rad/s), which S holds exactly. Two errors, every 0.2 s: of the lag angles, to which the fast twist contributes so little that a method may damp or ignore
it, and of all published outputs, with twist, torque and rates.""",
    "blades": """Blades, sections and swashplate of `config/bo105.yaml` with the linear polar on a hub that turns with constant speed, inflow prescribed, all 50 modes
per blade (up to 6.1·10⁵ rad/s). The rotor rests in hover, pitch moves along a polynomial for two revolutions, and the comparison is the revolution after that.
Error: all published outputs, every fifth of a revolution. Our models evaluate four blades in the lanes of one, so that one blade costs nearly as much as four.""",
    "rotor": """`config/bo105.yaml` as shipped (four blades with 44 modes each, Pitt-Peters inflow, elastic mast, fuselage on springs, algebraic loop) with `polar:
linear` and an upright shaft; start, length and error as for the blades.""",
    "dual_disc": """`config/dual_disc.yaml`, 0.1 s from rest. Two errors, every 2 ms from 0.08 s on: of the displacements of both discs, and of all published outputs,
with the force of the rigid support, which rings at 10⁵ rad/s. The film's force has kinks, and the start at rest is one of them."""}


def prose(text):
    return textwrap.fill(" ".join(text.split()), 170, break_long_words=False, break_on_hyphens=False)


def kind(name):
    return next(k for k in KINDS if name.startswith(k))


def capital(text):
    return text[0].upper() + text[1:]


def checks(study, limit):
    """What must hold, measured; `limit` [s] is what an integration may take at most.

    Alternatives are libraries, generalized-alpha, Newmark, precise integration, classical and truncated RK4."""
    found = Checks()
    for name, problem in study.items():
        for level in TARGET_LEVELS:
            add_ratio(found, name, problem, level, limit)
        slower = []
        for level in LEVELS:
            ours, theirs = problem.at("HEERK4", level), problem.fastest(LIBRARIES + OTHERS, level)
            if not ours:
                slower.append(f"does not reach {power(level)} within the limit")
            elif theirs and theirs[1].seconds < ours.seconds:
                slower.append(f"{theirs[0]} at {power(level)} in {theirs[1].seconds / ours.seconds:.2f} of its time")
        found.add(f"{capital(title(name))}: HEERK4 faster than every alternative from 10⁻² to 10⁻⁶", not slower, "; ".join(slower) if slower else "at all five errors")
    return found


def add_ratio(found, name, problem, level, limit):
    ours = problem.at("HEERK4", level)
    if kind(name) in AT_MOST:
        factor, others = AT_MOST[kind(name)], LIBRARIES
        claim = f"{capital(title(name))}: HEERK4 takes at most 1/{factor:.0f} of the best library's CPU time at {power(level)}"
    else:
        factor, others = AT_MOST_OF_NEWMARK, ("Newmark",)
        claim = f"{capital(title(name))}: HEERK4 takes at most 1/{factor:.0f} of Newmark's CPU time at {power(level)}"
    theirs = problem.fastest(others, level)
    if not ours:
        found.add(claim, False, "HEERK4 does not reach this error within the limit")
    elif theirs:
        ratio = theirs[1].seconds / ours.seconds
        found.add(claim, ratio >= factor, f"1/{ratio:.3g} of {theirs[0]}")
    else:
        # Nobody got there within the limit, which so is a bound.
        ratio = limit / ours.seconds
        found.add(claim, ratio >= factor, f"not reached within {1e3 * limit:.0f} ms, {ratio:.3g} times HEERK4's time")


def milliseconds(found):
    if not found:
        return "-"
    return ("≤ " if found.bound else "") + f"{1e3 * found.seconds:.3g}"


def ratio_cell(problem, theirs, level):
    ours = problem.at("HEERK4", level)
    if not ours:
        return "-"
    return f"{theirs[1].seconds / ours.seconds:.3g} ({theirs[0]})" if theirs else "none reaches it"


def problem_table(problem):
    rows = []
    for method in problem.methods():
        at = {level: problem.at(method, level) for level in LEVELS}
        if not any(at.values()):
            continue
        settings = list(dict.fromkeys(a.setting for a in at.values() if a and a.setting))
        bold = "**" if method == "HEERK4" else ""
        rows.append([f"{bold}{method}{bold}"] + [f"{bold}{milliseconds(at[level])}{bold}" for level in LEVELS] + ["; ".join(settings)])
    plain = problem.without_structure()
    for label, pool, methods in (("best library / HEERK4", problem, LIBRARIES), ("best library without solver for S / HEERK4", plain, LIBRARIES),
                                 ("best alternative / HEERK4", problem, LIBRARIES + OTHERS)):
        rows.append([label] + [ratio_cell(problem, pool.fastest(methods, level), level) for level in LEVELS] + [""])
    return table(["CPU time [ms] at error"] + [power(level) for level in LEVELS] + ["best setting"], rows)


def least(problem, method, level):
    """The fastest point measured that is at least as accurate as `level`, or None."""
    points = [p for s in problem.settings(method) for p in problem.curves[method, s] if p.error <= level]
    return min(points, key=lambda p: p.seconds) if points else None


def evaluations_note(problem):
    """Right-hand sides that HEERK4 and the best library spend at 1e-5."""
    ours, best = least(problem, "HEERK4", 1e-5), problem.fastest(LIBRARIES, 1e-5)
    theirs = least(problem, best[0], 1e-5) if best else None
    if not ours or not theirs:
        return ""
    return (f"For 10⁻⁵ HEERK4 evaluates the right-hand side {ours.evaluations} times ({1e6 * ours.seconds / ours.evaluations:.2g} µs each, all else included), "
            f"{best[0]} {theirs.evaluations} times ({1e6 * theirs.seconds / theirs.evaluations:.2g} µs).")


def exceptions(problem):
    """Where HEERK4 is not the fastest, in words."""
    lines = []
    for level in LEVELS:
        ours = problem.at("HEERK4", level)
        if not ours:
            lines.append(f"HEERK4 does not reach {power(level)} within the limits of the sweep.")
            continue
        for methods, what in ((LIBRARIES + OTHERS, ""), (OURS[1:], "of our own methods ")):
            theirs = problem.fastest(methods, level)
            if theirs and theirs[1].seconds < ours.seconds:
                setting = f" ({theirs[1].setting})" if theirs[1].setting else ""
                lines.append(f"At {power(level)} {what}{theirs[0]}{setting} is faster: {theirs[1].seconds / ours.seconds:.2f} of HEERK4's time.")
    return " ".join(lines)


def machine(root):
    def output(*command):
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, universal_newlines=True, check=False)
        return result.stdout.strip()
    match = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    compiler = output("c++", "--version").splitlines()
    flags = root / "build/sundials/BUILD_FLAGS"
    return "; ".join([match.group(1).strip() if match else "unknown processor", compiler[0] if compiler else "unknown compiler",
                      "commit " + (output("git", "-C", str(root), "rev-parse", "--short", "HEAD") or "unknown"),
                      flags.read_text(encoding="utf-8").strip() if flags.is_file() else "SUNDIALS as CMake found it", datetime.date.today().isoformat()])


def builds_text(folder):
    rows = builds.read(folder)
    if not rows:
        return ""
    intro = """Debian's binary of the same release in place of ours: median ratio of the CPU times of equal integrations. The right-hand side and the solver for S are
the same code in both, so the ratio is largest where the library's own vector and matrix work weighs most."""
    cells = [[title(r["problem"]), r["method"], r["setting"], r["points"], r["median_time_ratio"]] for r in rows]
    return f"### Debian's SUNDIALS against an optimised build\n\n{prose(intro)}\n\n" + table(["problem", "method", "setting", "points", "Debian / optimised"], cells)


def missed(study):
    """[(problem, level, other method)] of the ratios that are below target, with what both spend."""
    rows = []
    for name, problem in study.items():
        for level in TARGET_LEVELS:
            ours = problem.at("HEERK4", level)
            others, factor = (LIBRARIES, AT_MOST[kind(name)]) if kind(name) in AT_MOST else (("Newmark",), AT_MOST_OF_NEWMARK)
            theirs = problem.fastest(others, level)
            if not ours or not theirs or theirs[1].seconds >= factor * ours.seconds:
                continue
            cells = [capital(title(name)), power(level), f"{theirs[1].seconds / ours.seconds:.3g}"]
            for method in ("HEERK4", theirs[0]):
                point = least(problem, method, level)
                cells.append(f"{method}: {point.steps} steps, {point.evaluations} evaluations")
            rows.append(cells)
    return rows


def why_text(study):
    """Where ratios miss their target: the work of both sides, and the reason."""
    rows = missed(study)
    if not rows:
        return ""
    header = ["problem", "error", "ratio of times", "HEERK4", "best library or Newmark"]
    return "### Where ratios are below target, and why\n\n" + table(header, rows) + "\n" + prose(WHY) + "\n"


def text(study, images, found, folder, root, quick):
    parts = ["## Error against CPU time, beside what a user would pick instead\n",
             prose(f"Generated by `scripts/work_precision.py{' --quick' if quick else ''}` ({machine(root)}). "
                   f"{len(found.rows) - found.failed} of {len(found.rows)} targets met (end of this part)."), "", prose(METHOD), "", prose(SETTINGS), ""]
    last = ""
    for name, problem in study.items():
        if kind(name) != last:
            last = kind(name)
            parts.append(f"### {KINDS[last]}\n\n{prose(MEANINGS[last])}\n")
        parts.append(f"#### {capital(title(name))}\n")
        if not name.endswith(ALL):
            parts.append(f"![Error against CPU time, {title(name)}]({images[name]})\n")
        parts.append(prose(f"Distance of the two references ({problem.reference}): {problem.distance:.1e}. {evaluations_note(problem)}") + "\n")
        parts.append(problem_table(problem))
        if exceptions(problem):
            parts.append(prose(exceptions(problem)) + "\n")
    parts.append(builds_text(folder))
    parts.append(why_text(study))
    parts.append("### Targets\n\n" + table(["target", "found", ""], found.rows))
    return "\n".join(part for part in parts)
