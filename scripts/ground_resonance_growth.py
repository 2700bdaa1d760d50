#!/usr/bin/python3
"""Growth of the cyclic lag in config/ground_resonance.yaml after a kick of one blade, beside the multiplier of the linearised system.

Prints both growth rates and draws ground_resonance.png. Exit status: 0 they agree within 5 %, 1 not, 2 bad arguments.
"""
import argparse
import json
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
    sys.exit(f"ground_resonance_growth: {error}; on Debian: scripts/install_dependencies.sh plots")

ROOT = pathlib.Path(__file__).resolve().parent.parent
CONFIGURATION = str(ROOT / "config/ground_resonance.yaml")
BAR = 0.05          # of the growth rate
FROM, TO = 8, 20    # [s] where the slope is taken: before, other modes are still there
KICK = 0.01         # of the first lag mode of blade 1, 4 mm at the tip
BLADES = 4


def multiplier(program, overrides):
    """Growth rate [1/s] of the least stable mode about the trimmed motion, and the controls of the trim."""
    command = [program, CONFIGURATION, "--trim", "--json", "--quiet"] + overrides
    result = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    collective = result["trim"]["controls"]["swashplate.collective"]["value"]
    return math.log(result["floquet"]["spectral_radius"]) / result["trim"]["period"], collective


def cyclic_lag(program, overrides, collective):
    """Time [s], |2/N sum lag_k e^(i psi_k)| [rad] and sway of the hub [m] of a run from rest with a kick."""
    signals = [f"rotor.lag_{k + 1}" for k in range(BLADES)] + ["fuselage.hub_position_x", "fuselage.hub_position_y"]
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "run.csv"
        command = [program, CONFIGURATION, "--quiet", "--duration", str(TO), "--every", "45", "--output", str(output), "--signals", ",".join(signals),
                   "--set", f"subsystems.rotor.initial.L1_1={KICK}", "--set", f"subsystems.swashplate.trim_collective={collective!r}"]
        subprocess.run(command + overrides, check=True)
        data = np.genfromtxt(output, delimiter=",", skip_header=1)
    azimuth = data[:, 2, None] + 2 * np.pi * np.arange(BLADES) / BLADES
    return data[:, 1], np.abs(np.sum(data[:, 3:3 + BLADES] * np.exp(1j * azimuth), axis=1)) * 2 / BLADES, np.hypot(data[:, -2], data[:, -1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/devel/lib/heerk_rotor/simulate", help="simulate (default: the one in build/)")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "docs/validation", metavar="DIR", help="where the plot goes (default: docs/validation)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="override of the configuration; repeatable")
    arguments = parser.parse_args()
    if not arguments.program.is_file():
        parser.error(f"no program {arguments.program}; build simulate first or give --program")
    arguments.output.mkdir(parents=True, exist_ok=True)
    overrides = [word for override in arguments.set for word in ("--set", override)]

    expected, collective = multiplier(str(arguments.program), overrides)
    t, lag, sway = cyclic_lag(str(arguments.program), overrides, collective)
    window = t >= FROM
    growth, start = np.polyfit(t[window], np.log(lag[window]), 1)
    print(f"growth rate [1/s]: multiplier {expected:.4f}, simulation {growth:.4f} ({100 * (growth / expected - 1):+.1f} %)")

    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    axes.semilogy(t, np.degrees(lag), label="cyclic lag, simulation [deg]")
    axes.semilogy(t, 1000 * np.maximum(sway, 1e-6), label="sway of the fuselage, simulation [mm]")
    axes.semilogy(t, np.degrees(np.exp(start + growth * FROM + expected * (t - FROM))), "k--", label=f"slope of the multiplier, {expected:.3f} 1/s")
    axes.set(xlabel="time [s]", ylabel="amplitude", title="Ground resonance after a kick of one blade")
    axes.legend()
    axes.grid(alpha=0.3, which="both")
    figure.savefig(arguments.output / "ground_resonance.png", dpi=110)
    return 0 if abs(growth / expected - 1) <= BAR else 1


if __name__ == "__main__":
    sys.exit(main())
