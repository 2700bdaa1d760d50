#!/usr/bin/python3
"""Compares hover runs of `simulate` with measurements: Castles & Gray (NACA TN 2474) and Harrington's rotor 1 (NACA TN 2318).

Prints the tables of docs/validation.md and draws castles_gray.png and harrington.png. Exit status: 0 both within their bars, 1 not, 2 bad arguments.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as error:
    sys.exit(f"hover_validation: {error}; on Debian: scripts/install_dependencies.sh plots")

ROOT = pathlib.Path(__file__).resolve().parent.parent
DATA = ROOT / "docs" / "validation"
THRUST_BAR = 0.08            # Castles-Gray: root mean square of the relative error of CT
MERIT_BAR = 0.05             # Harrington: largest error of the figure of merit ...
MERIT_RANGE = (0.04, 0.12)   # ... between these CT/sigma
REVOLUTIONS = 40             # at low thrust the inflow settles slowly, in 1 / (1.5 pi lambda) radians
COEFFICIENTS = ("thrust_coefficient", "torque_coefficient", "blade_loading", "figure_of_merit")


def measured(name):
    """Rows of a data file as dictionaries of numbers, None where the table is empty."""
    with open(DATA / name, encoding="ascii") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return [{key: float(value) if value else None for key, value in row.items()} for row in rows]


class Hover:
    """Steady hover coefficients of a configuration at a collective pitch [rad], by `simulate`."""

    def __init__(self, program, configuration, overrides):
        self.command = [str(program), str(ROOT / "config" / configuration), "--quiet", "--revolutions", str(REVOLUTIONS), "--every", "180",
                        "--set", "simulation.start=none"]  # whose commands would win
        self.command += [word for override in overrides for word in ("--set", override)]

    def __call__(self, collective, *overrides):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "hover.csv"
            command = self.command + ["--output", str(output), "--signals", ",".join("coefficients." + name for name in COEFFICIENTS)]
            for override in (f"subsystems.swashplate.trim_collective={collective!r}", *overrides):
                command += ["--set", override]
            subprocess.run(command, check=True)
            last, before = np.genfromtxt(output, delimiter=",", skip_header=1)[[-1, -3], 3:]
        if not np.allclose(last, before, rtol=1e-4, atol=1e-6):
            sys.exit(f"hover_validation: not steady after {REVOLUTIONS} revolutions at {math.degrees(collective):.2f} deg: {before} -> {last}")
        return dict(zip(COEFFICIENTS, last))


def castles_gray(program, overrides, folder):
    hover = Hover(program, "castles_gray.yaml", overrides)
    rows = measured("castles_gray_1951_tn2474_hover.csv")
    at_zero_thrust = hover(0.0)["torque_coefficient"]
    print("run   rpm  pitch [deg]  CT measured  computed  error [%]  CQ - CQ0 measured  computed")
    errors, torque_errors = [], []
    for row in rows:
        now = hover(math.radians(row["theta075_deg"]), f"simulation.rotor_speed={row['rpm'] * math.pi / 30!r}")
        row["computed"] = now["thrust_coefficient"]
        errors.append(row["computed"] / row["CT"] - 1)
        torque = now["torque_coefficient"] - at_zero_thrust
        text = "        -"
        if row["dCQ"] is not None:
            torque_errors.append(torque / row["dCQ"] - 1)
            text = f"{row['dCQ']:9.6f}"
        print(f"{row['run']:3.0f}  {row['rpm']:4.0f}  {row['theta075_deg']:11.2f}  {row['CT']:11.4f}  {row['computed']:8.5f}  {100 * errors[-1]:+9.1f}  {text:>17s}  {torque:8.6f}")
    rms = math.sqrt(np.mean(np.square(errors)))
    print(f"CT: mean {100 * np.mean(errors):+.1f} %, rms {100 * rms:.1f} % (bar {100 * THRUST_BAR:.0f} %); "
          f"CQ - CQ0: mean {100 * np.mean(torque_errors):+.1f} %, rms {100 * math.sqrt(np.mean(np.square(torque_errors))):.1f} %")

    pitch = np.linspace(0, 12, 7)
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    axes.plot(pitch, [hover(math.radians(angle))["thrust_coefficient"] for angle in pitch], label="computed")
    for rpm, marker in ((1200, "o"), (1600, "s")):
        chosen = [row for row in rows if row["rpm"] == rpm]
        axes.plot([row["theta075_deg"] for row in chosen], [row["CT"] for row in chosen], marker, fillstyle="none", label=f"NACA TN 2474, {rpm} rpm")
    axes.set(xlabel="pitch at 0.75 R [deg]", ylabel="$C_T$", xlim=(0, 12), ylim=(0, None), title="Castles-Gray, constant chord, untwisted, hover")
    axes.legend()
    axes.grid(alpha=0.3)
    figure.savefig(folder / "castles_gray.png", dpi=110)
    return rms <= THRUST_BAR


def harrington(program, overrides, folder):
    hover = Hover(program, "harrington.yaml", overrides)
    rows = measured("harrington_1951_tn2318_rotor1_single.csv")
    polar = [hover(math.radians(angle)) for angle in np.arange(2.0, 14.1, 1.0)]
    loading = np.array([point["blade_loading"] for point in polar])
    merit = np.array([point["figure_of_merit"] for point in polar])
    print("CT/sigma  FM measured  computed   error")
    worst = 0.0
    for row in rows:
        computed = np.interp(row["ctsigma"], loading, merit)
        judged = MERIT_RANGE[0] <= row["ctsigma"] <= MERIT_RANGE[1]
        worst = max(worst, abs(computed - row["FM"])) if judged else worst
        print(f"{row['ctsigma']:8.3f}  {row['FM']:11.2f}  {computed:8.3f}  {computed - row['FM']:+.3f}{'' if judged else '  (outside the range)'}")
    print(f"FM: largest error {worst:.3f} for CT/sigma {MERIT_RANGE[0]} to {MERIT_RANGE[1]} (bar {MERIT_BAR})")

    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    axes.plot(loading, merit, label="computed")
    axes.errorbar([row["ctsigma"] for row in rows], [row["FM"] for row in rows], 0.01, fmt="o", fillstyle="none", capsize=2, label="NACA TN 2318, Figure 6 (read to $\\pm$0.01)")
    axes.axvspan(*MERIT_RANGE, alpha=0.08, label="range judged")
    axes.set(xlabel="$C_T/\\sigma$", ylabel="figure of merit", xlim=(0, 0.14), ylim=(0, 0.8), title="Harrington rotor 1, single, hover")
    axes.legend(loc="lower right")
    axes.grid(alpha=0.3)
    figure.savefig(folder / "harrington.png", dpi=110)
    return worst <= MERIT_BAR


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/devel/lib/heerk_rotor/simulate", help="simulate (default: the one in build/)")
    parser.add_argument("--output", type=pathlib.Path, default=DATA, metavar="DIR", help="where the plots go (default: docs/validation)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="override of both configurations, to see what a choice is worth; repeatable")
    arguments = parser.parse_args()
    if not arguments.program.is_file():
        parser.error(f"no program {arguments.program}; build simulate first or give --program")
    arguments.output.mkdir(parents=True, exist_ok=True)
    good = [compare(arguments.program, arguments.set, arguments.output) for compare in (castles_gray, harrington)]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
