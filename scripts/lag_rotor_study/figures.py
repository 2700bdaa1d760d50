"""Figures of the report. Each declares its runs, writes a PNG file, and returns Markdown."""
import math

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from lag_rotor_study.eigenvalues import hub_inertia, largest_eigenvalues
from lag_rotor_study.runs import Case, DEGREE, DURATION, GRID, STIFFNESSES, reference

BLADE_COLOURS = ("tab:blue", "tab:red", "tab:green", "hotpink")  # blades 1..4, as in the paper


def figure_3(study, folder):
    cases = {k: Case(k, "HEERK4", "absolute_lag", GRID, blades=4) for k in STIFFNESSES[:3]}
    study.run_all(cases.values())
    figure, axes = plt.subplots(3, 2, figsize=(12, 9), gridspec_kw={"width_ratios": (2.2, 1)})
    for row, (k, case) in zip(axes, cases.items()):
        lag = 1e3 * study.runs[case].lag
        t = np.arange(len(lag)) * case.step
        periods = 6 * 2 * math.pi / largest_eigenvalues(k)[1]
        for axis, end, blades, width in ((row[0], DURATION, (3, 2, 1, 0), 0.9), (row[1], periods, (3, 2, 1), 1.3)):  # lowest number on top
            for blade in blades:
                axis.plot(t[t <= end], lag[t <= end, blade], color=BLADE_COLOURS[blade], lw=width, label=f"blade {blade + 1}")
            axis.set_xlim(0, end)
            axis.grid(alpha=0.3)
        row[0].set_ylim(-11, 11)
        row[0].set_title(f"$\\omega_s$ = {math.sqrt(k / hub_inertia()):.2f} rad/s  ($K_s$ = {k:,.0f} N m/rad)".replace(",", " "), loc="left", fontsize=11)
        row[1].set_title("blades 2 to 4, first six fast periods", loc="left", fontsize=11)
        row[0].set_ylabel(r"lag angle $\varphi_i$ [mrad]")
    for axis in axes[-1]:
        axis.set_xlabel("time [s]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles[::-1], labels[::-1], loc="upper right", ncol=4, frameon=False)
    figure.suptitle("Motion of the four blades", x=0.01, ha="left")
    figure.tight_layout()
    figure.savefig(folder / "figure_3.png", dpi=80)
    return """## Figure 3

![Motion of the four blades for three mast stiffnesses](figure_3.png)

Blade 1 starts at 10 mrad, the others at rest. The softer the mast, the stronger the fast common motion of hub and blades; the motion of
the fuselage passes the slow motion on to the other blades, first to the opposite one.
"""


def figure_4(study, folder):
    cases = {m: Case(3e4, m, "printed", 1e-2) for m in ("HERK4", "HEERK4")}
    study.run_all(cases.values())
    fine = study.runs[reference(cases["HERK4"])].lag[:, 0] * 1e3
    series = [("reference", "tab:blue", np.arange(len(fine)) * GRID, fine)]
    series += [(f"{m}, h = 0.01 s", colour, np.arange(len(study.runs[c].lag)) * c.step, 1e3 * study.runs[c].lag[:, 0])
               for (m, c), colour in zip(cases.items(), ("tab:red", "tab:green"))]
    figure = plt.figure(figsize=(12, 7.5))
    grid = figure.add_gridspec(2, 2)
    for place, span in ((grid[0, :], (0, 10)), (grid[1, 0], (0, 1)), (grid[1, 1], (9, 10))):
        axis = figure.add_subplot(place)
        for name, colour, t, value in series:
            line = (1.0 if span[1] - span[0] > 1 else 1.4) * (2.5 if name == "reference" else 1.0)  # visible below the others
            inside = (t >= span[0] - 1e-9) & (t <= span[1] + 1e-9)
            axis.plot(t[inside], value[inside], color=colour, lw=line, alpha=0.6 if name == "reference" else 1.0, label=name)
        axis.set(xlim=span, xlabel="time [s]", ylabel=r"$\varphi_1$ [mrad]")
        axis.grid(alpha=0.3)
        if span == (0, 10):
            axis.legend(loc="upper center", bbox_to_anchor=(0.5, 1.16), ncol=3, frameon=False)
    figure.tight_layout()
    figure.savefig(folder / "figure_4.png", dpi=80)
    return """## Figure 4

![Reference, HERK4 and HEERK4 at h = 0.01 s](figure_4.png)

As in the paper: HERK4 follows the fast mast mode at first and damps it away, HEERK4 keeps it but drifts in phase (K_s = 3·10⁴, `printed`).
"""


def work_precision(study, folder):
    steps = [GRID * n for n in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)]
    cases = {(form, k): [Case(k, "HEERK4", form, h) for h in steps] for form in ("printed", "absolute_lag") for k in (3e4, 3e6, 3e8)}
    study.run_all([c for series in cases.values() for c in series])
    figure, axis = plt.subplots(figsize=(9, 6.5))
    colours, styles = {3e4: "tab:blue", 3e6: "tab:red", 3e8: "tab:green"}, {"printed": "o--", "absolute_lag": "s-"}
    for (form, k), series in cases.items():
        points = [(c.step, study.error(c)) for c in series]
        h, error = np.array([p for p in points if p[1] is not None]).T
        axis.loglog(h, error, styles[form], color=colours[k], ms=5, lw=1.4, mfc="white" if form == "printed" else None,
                    label=f"{form}, $K_s$ = {k / 10 ** int(math.log10(k)):g}$\\cdot$10$^{int(math.log10(k))}$")
        lost = [p[0] for p in points if p[1] is None]
        axis.plot(lost, [4.0 * 1.7 ** -sorted(colours).index(k)] * len(lost), "x", color=colours[k], ms=6)
    slope = np.array([3e-4, 3e-3])
    axis.loglog(slope, 3e-12 * (slope / slope[0]) ** 4, color="0.5", lw=1)
    axis.text(1.2e-3, 1.5e-10, "order 4", color="0.4")
    axis.axvline(DEGREE, color="0.6", lw=0.8, ls=":")
    axis.text(DEGREE * 1.06, 3e-13, "one degree of azimuth", color="0.4")
    axis.set(xlabel="step h [s]", ylabel=r"RMS error of $\varphi_1$ (x: not converged)", ylim=(1e-13, 10), title="HEERK4: error against step")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=9, loc="lower right")
    figure.tight_layout()
    figure.savefig(folder / "work_precision.png", dpi=80)
    return "## Error against step\n\n![RMS error against step for both formulations](work_precision.png)\n"
