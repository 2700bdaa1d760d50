"""Campbell diagram and run-up through the first two critical speeds. Each writes a PNG file and returns Markdown."""
import math

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import scipy.signal

from dual_disc_study.expected import CRITICALS
from dual_disc_study.runs import Case, DISC_1_TO_JOURNAL
from dual_disc_study.shaft import RPM, criticals, whirl

COMPARED = (5000, 40000, 80000)  # speeds at which `simulate` is asked for frequencies [rpm]


def frequencies(study, speed):
    """Those that --stability lists for the map of one step, without film and without the phasor [rad/s]."""
    case = Case(speed, "HEERK4", 3e-6, settings=("subsystems.film.viscosity=0.0",))
    _, result = study.execute(case.model() + ["--stability"])
    return [2.0 * math.pi * mode["frequency"] for mode in result["stability"]["modes"] if not mode["state"].startswith("shaft.nominal")]


def campbell(study, folder, checks):
    speeds = np.arange(0.0, 80001.0, 500.0)
    lines = np.array([whirl(speed * RPM)[:16] for speed in speeds]) / (2.0 * math.pi)
    found = criticals()[:3] / RPM
    figure, panels = plt.subplots(1, 2, figsize=(14, 6.2), gridspec_kw={"width_ratios": (1, 1.25)})
    for axis, end, top in zip(panels, (16000, 80000), (600, 1600)):
        for sign, colour, name in ((1, "tab:red", "forward whirl"), (-1, "tab:blue", "backward whirl")):
            branches = np.array([np.sort(sign * row[sign * row > 0.0])[:5] for row in lines])  # whirl of one sense never crosses
            axis.plot(speeds, branches, color=colour, lw=1.3, label=[name] + ["_"] * (branches.shape[1] - 1))
        axis.plot(speeds, speeds / 60.0, color="0.4", lw=1.0, label="1x")
        for speed in found[found < end]:
            axis.plot(speed, speed / 60.0, "o", color="black", ms=7, mfc="none")
            side = {"xytext": (8, -15)} if speed < 0.8 * end else {"xytext": (-8, -16), "ha": "right"}
            axis.annotate(f"{speed:.0f} rpm", (speed, speed / 60.0), textcoords="offset points", fontsize=9, **side)
        axis.set(xlabel="speed [rpm]", ylabel="natural frequency [Hz]", xlim=(0, end), ylim=(0, top))
        axis.grid(alpha=0.3)
    panels[0].legend(loc="lower right", fontsize=9)
    figure.tight_layout()
    figure.savefig(folder / "campbell.png", dpi=80)
    plt.close(figure)
    worst, count = 0.0, 0
    for speed in COMPARED:
        known = np.abs(whirl(speed * RPM))
        for value in frequencies(study, speed):
            worst, count = max(worst, np.min(np.abs(known - value)) / value), count + 1
    checks.add(f"natural frequencies of `simulate` at {len(COMPARED)} speeds agree with those of the second assembly within 10⁻⁶", worst < 1e-6, f"{worst:.1e} ({count} frequencies)")
    checks.add("critical speeds of forward whirl: 4231, 10793, 76576 rpm within 1 rpm", max(abs(a - b) for a, b in zip(found, CRITICALS)) < 1.0, ", ".join(f"{speed:.1f}" for speed in found))
    rest = np.abs(whirl(0.0, 0.0))[:8:2]
    return f"""## Campbell diagram

![Natural frequencies over speed](campbell.png)

Without film, from the shaft assembled a second time (`scripts/dual_disc_study/shaft.py`). Natural frequencies at rest: {", ".join(f"{value:.3f}" for value in rest)} rad/s (each twice).
Critical speeds of forward whirl: {", ".join(f"{speed:.0f}" for speed in found)} rpm. The discs' polar inertia is larger than their diametral one: forward whirl of the two modes in
which they tilt rises faster than 1x, and the third critical speed comes only where it veers into the next bending mode.
`simulate --stability` lists frequencies that differ by at most {worst:.1e}.
"""


INITIAL, FINAL, RATE, STEP = 500.0, 15000.0, 2500.0, 2e-5  # run-up [rpm, rpm, rpm/s], [s]
ORBITS = (3000, 4231, 7000, 10793, 14000)                   # [rpm]
CONSTANT = (1000, 2000, 3000, 3500, 4000, 4231, 4500, 5000, 6000, 7000, 8000, 9000, 10000, 10793, 11500, 12500, 14000)


def run_up(study, folder, checks):
    ramp = tuple(f"subsystems.drive.{key}={value}" for key, value in (("initial_speed_rpm", INITIAL), ("final_speed_rpm", FINAL), ("acceleration_rpm_per_s", RATE)))
    signals = DISC_1_TO_JOURNAL + ("film.eccentricity_ratio", "shaft.rotor_speed")
    case = Case(7750.0, "HEERK4", STEP, signals=signals, duration=(FINAL - INITIAL) / RATE, grid=2e-4, settings=ramp)
    steady = {speed: Case(speed, "HEERK4", STEP, signals=signals, duration=0.6, grid=1e-4) for speed in CONSTANT}
    study.run_all([case, *steady.values()])
    rows = study.run(case).rows
    disc, journal, eccentricity, speed = rows[:, 1:3] * 1e6, rows[:, 3:5] * 1e6, rows[:, 5], rows[:, 6] / RPM
    level = {s: np.max(np.hypot(*(study.run(c).rows[-1500:, 1:3].T * 1e6))) for s, c in steady.items()}

    figure = plt.figure(figsize=(14, 11))
    top, bottom = figure.subfigures(2, 1, height_ratios=(2.0, 1))
    amplitude, waterfall = top.subplots(2, 1, sharex=True)
    amplitude.plot(speed, np.hypot(*disc.T), color="tab:blue", lw=0.7, label="disc 1")
    amplitude.plot(speed, np.hypot(*journal.T), color="tab:orange", lw=0.7, label="journal")
    amplitude.plot(level.keys(), level.values(), "o", color="black", ms=4, mfc="none", label="disc 1, largest at constant speed")
    amplitude.set(ylabel="distance from rest [µm]", xlim=(INITIAL, FINAL), ylim=(0, None))
    amplitude.legend(fontsize=9, loc="upper right", ncol=3)
    length = 1024
    frequency, at, density = scipy.signal.spectrogram(disc[:, 0], fs=1.0 / 2e-4, window="hann", nperseg=length, noverlap=length - 64, scaling="spectrum", mode="psd")
    shown = frequency <= 800.0
    picture = waterfall.pcolormesh(INITIAL + RATE * at, frequency[shown], 10.0 * np.log10(2.0 * density[shown] + 1e-12), vmin=-60, vmax=35, cmap="viridis", shading="nearest", rasterized=True)
    for order in (1, 2, 3):
        waterfall.plot((INITIAL, FINAL), (order * INITIAL / 60.0, order * FINAL / 60.0), color="white", lw=0.6, ls=":")
        waterfall.text(13000, order * 13000 / 60.0 + 28, f"{order}x", color="white", fontsize=9, ha="right")
    waterfall.set(ylabel="disc 1, x: frequency [Hz]", ylim=(0, 800), xlabel="speed [rpm]")
    top.subplots_adjust(left=0.06, right=0.9, top=0.97, bottom=0.09, hspace=0.08)
    box = waterfall.get_position()
    top.colorbar(picture, cax=top.add_axes([0.915, box.y0, 0.012, box.height]), label="amplitude [dB of 1 µm]")
    for critical in CRITICALS[:2]:
        amplitude.axvline(critical, color="0.5", lw=0.8, ls="--")
        amplitude.text(critical + 60, amplitude.get_ylim()[1] * 0.04, f"{critical:.0f} rpm", color="0.4", fontsize=9)
    panels = bottom.subplots(1, len(ORBITS), sharex=True, sharey=True)
    reach = 0.0
    for axis, wanted in zip(panels, ORBITS):
        part = np.abs(speed - wanted) < 0.5 * RATE * 3.0 * 60.0 / wanted  # three revolutions
        for motion, colour, name in ((disc, "tab:blue", "disc 1"), (journal, "tab:orange", "journal")):
            axis.plot(*motion[part].T, color=colour, lw=1.0, label=name)
            reach = max(reach, 1.1 * np.max(np.abs(motion[part])))
        axis.set(title=f"{wanted} rpm", xlabel="x [µm]")
        axis.set_aspect("equal")
        axis.grid(alpha=0.3)
    panels[0].set(xlim=(-reach, reach), ylim=(-reach, reach), ylabel="y [µm]")
    panels[0].legend(fontsize=8, loc="upper left")
    bottom.subplots_adjust(left=0.06, right=0.98, top=0.93, bottom=0.14, wspace=0.12)
    figure.savefig(folder / "run_up.png", dpi=80)
    plt.close(figure)

    size = np.hypot(*disc.T)
    first = speed[np.argmax(np.where(speed < 7000, size, 0.0))]
    second = speed[np.argmax(np.where(speed > 7000, size, 0.0))]
    checks.add("run-up: the film never touches (eccentricity ratio below 1)", eccentricity.max() < 1.0, f"{eccentricity.max():.3f}")
    return f"""## Run-up through two critical speeds

![Run-up: amplitude, waterfall, orbits](run_up.png)

From {INITIAL:.0f} to {FINAL:.0f} rpm at {RATE:.0f} rpm/s, HEERK4 with {STEP:.0e} s, half film. Disc 1 is farthest from rest at {first:.0f} rpm, and above 7000 rpm at {second:.0f} rpm; largest eccentricity ratio
{eccentricity.max():.3f}. Circles: constant speeds.
"""
