"""Figures of the report and the fits in them. Each writes a PNG file and returns Markdown."""
import math
import re

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np

from lag_rotor_study.text import table
from performance_study.tables import MACHINES, PARTS, STARTUP, STARTUP_PARTS, time_text

COLOURS = ["#3b6ea5", "#c8553d", "#5b8e4c", "#8d6aa8", "#9a9a9a"]
GROUPS = {"lag rotor": COLOURS[0], "elastic rotor": COLOURS[1], "dual disc": COLOURS[2]}

# (title, program, benchmark, what is counted, largest exponent or None)
SCALINGS = [
    ("elements per blade", "scaling", "elements", "elements", 2.0),
    ("sections per blade", "scaling", "sections", "sections", 1.1),
    ("blades", "scaling", "blades", "blades", 1.1),
    ("subsystems in a chain", "subsystems", "chain", "subsystems", None),
    ("subsystems in a ring (one loop)", "subsystems", "ring", "subsystems", None),
]


PLAIN = matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}")  # 100, not 10^2


def save(figure, folder, name, alt):
    figure.savefig(folder / name, dpi=110)
    plt.close(figure)
    return f"![{alt}](performance/{name})\n"


def exponent(sizes, times):
    """Least-squares slope of log time over log size."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])


def steps(results, folder):
    found = [(label, results.get(program, name)) for label, program, name in MACHINES]
    found = [(label, m) for label, m in found if m]
    if not found:
        return ""
    figure, axis = plt.subplots(figsize=(9, 0.32 * len(found) + 1.2), layout="constrained")
    for row, (label, m) in enumerate(reversed(found)):
        colour = next(colour for group, colour in GROUPS.items() if label.startswith(group))
        axis.barh(row, 1e6 * m.best, color=colour, height=0.7)
        axis.text(1.08e6 * m.best, row, time_text(m.best), va="center", fontsize=8)
    axis.set_yticks(range(len(found)), [label for label, _ in reversed(found)], fontsize=8)
    axis.set_xscale("log")
    axis.set_xlim(0.5e6 * min(m.best for _, m in found), 2.5e6 * max(m.best for _, m in found))
    axis.xaxis.set_major_formatter(PLAIN)
    axis.set_ylim(-0.6, len(found) - 0.4)
    axis.set_xlabel("one step [µs]")
    axis.grid(axis="x", alpha=0.3)
    axis.set_axisbelow(True)
    return save(figure, folder, "steps.png", "Cost of a step")


def stacked(axis, labels, groups, values, unit):
    """Horizontal bars made of parts; values[part][bar]. Numbers stand in parts that have room for them."""
    left = np.zeros(len(labels))
    total = np.sum(values, axis=0)
    for part, (group, colour) in enumerate(zip(groups, COLOURS)):
        axis.barh(labels, values[part], left=left, color=colour, label=group, height=0.55)
        for bar, value in enumerate(values[part]):
            if value > 0.06 * max(total):
                axis.text(left[bar] + value / 2, bar, f"{value:.3g}", ha="center", va="center", fontsize=8, color="white")
        left += values[part]
    for bar, value in enumerate(total):
        axis.text(value + 0.01 * max(total), bar, f"{value:.3g} {unit}", va="center", fontsize=8)
    axis.set_xlim(right=1.13 * max(total))
    axis.invert_yaxis()
    axis.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=5 if len(groups) > 4 else 4, fontsize=8, frameon=False)


def stacked_figure(results, folder, bars, groups, height, unit, caption, name, alt):
    """One bar for each (label, program, benchmark) that has a result, made of the counters (key, label) of `groups`."""
    found = [(label, results.get(program, benchmark)) for label, program, benchmark in bars]
    found = [(label, m) for label, m in found if m]
    if not found:
        return ""
    figure, axis = plt.subplots(figsize=(9, height * len(found) + 1.4), layout="constrained")
    stacked(axis, [label for label, _ in found], [label for _, label in groups], [[m.counters[key] for _, m in found] for key, _ in groups], unit)
    axis.set_xlabel(caption)
    return save(figure, folder, name, alt)


def parts(results, folder):
    bars = [("10 sections", "fe_rotor_step", "parts/bo105"), ("20 sections", "fe_rotor_step", "parts/bo105_20_sections")]
    return stacked_figure(results, folder, bars, PARTS, 0.7, "µs", "one step of the elastic rotor [µs]", "parts.png", "Parts of a step of the elastic rotor")


def startup(results, folder):
    bars = [(config, "startup", f"toFirstStep/{config}") for config in STARTUP]
    return stacked_figure(results, folder, bars, STARTUP_PARTS, 0.5, "ms", "from the YAML file to the first step [ms]", "startup.png", "Start-up")


def scaling(results, folder, checks):
    found = [(entry, results.series(entry[1], entry[2])) for entry in SCALINGS]
    found = [(entry, series) for entry, series in found if len(series) > 2]
    if not found:
        return ""
    rows = []
    figure, axes = plt.subplots(2, 2, figsize=(10, 7.5), layout="constrained")
    panels = {"elements": axes[0, 0], "sections": axes[0, 1], "blades": axes[1, 0], "subsystems": axes[1, 1]}
    for panel in panels.values():
        panel.set_visible(False)
    for index, ((title, _, name, unit, bound), series) in enumerate(found):
        sizes, times = np.array([n for n, _ in series], float), np.array([m.best for _, m in series])
        slope = exponent(sizes, times)
        half = sizes >= math.sqrt(sizes[0] * sizes[-1]) * 0.999
        upper = exponent(sizes[half], times[half])
        if bound:
            checks.add(f"time grows with {title} with an exponent of at most {bound:g}", slope <= bound, f"{slope:.2f} from {int(sizes[0])} to {int(sizes[-1])}")
        residuals = " .. ".join(f"{m.counters.get('residuals/solve', 0.0):.1f}" for m in (series[0][1], series[-1][1]))
        rows.append([title, f"{int(sizes[0])} .. {int(sizes[-1])}", time_text(times[0]), time_text(times[-1]), residuals, f"{slope:.2f}", f"{upper:.2f}", f"<= {bound:g}" if bound else ""])
        axis = panels[unit]
        axis.set_visible(True)
        colour = COLOURS[index % len(COLOURS)]
        label = f"{name}: " if unit == "subsystems" else ""
        axis.loglog(sizes, 1e6 * times, "o", color=colour, ms=5, label=f"{label}measured")
        middle = math.exp(np.mean(np.log(times)) - slope * np.mean(np.log(sizes)))
        axis.loglog(sizes, 1e6 * middle * sizes ** slope, "-", color=colour, lw=1.2, label=f"{label}fit, exponent {slope:.2f}")
        if bound:
            axis.loglog(sizes, 1e6 * times[0] * (sizes / sizes[0]) ** bound, ":", color="black", lw=1.0, label=f"exponent {bound:g} from the smallest")
        axis.set_xlabel(title if unit != "subsystems" else "subsystems")
        axis.set_ylabel("one step [µs]")
        axis.set_xticks(sizes, [f"{int(n)}" for n in sizes])
        axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        low, high = axis.get_ylim()
        decades = [value for value in (c * 10.0 ** e for e in range(-3, 7) for c in (1, 2, 5)) if low <= value <= high]
        axis.set_yticks(decades, [f"{value:g}" for value in decades])
        axis.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    text = table(["grows with", "from .. to", "smallest", "largest", "residuals per solve", "exponent", "upper half", "bound"], rows)
    return save(figure, folder, "scaling.png", "Growth of the cost of a step") + "\n" + text


def table_size(results, folder):
    points = []
    for name, m in results.programs.get("airfoil_table", {}).items():
        match = re.fullmatch(r"lookupOfSize/alpha:(\d+)/mach:(\d+)", name)
        if match and m.times:
            alpha, mach = int(match.group(1)), int(match.group(2))
            points.append((alpha * mach * 32 / 1024.0, f"{alpha} x {mach}", 1e9 * m.counters["time/item"]))
    if len(points) < 2:
        return ""
    points.sort()
    figure, axis = plt.subplots(figsize=(7, 3.6), layout="constrained")
    axis.semilogx([p[0] for p in points], [p[2] for p in points], "o-", color=COLOURS[0])
    for size, label, value in points:
        axis.annotate(label, (size, value), textcoords="offset points", xytext=(0, 7), ha="center", fontsize=8)
    axis.xaxis.set_major_formatter(PLAIN)
    axis.set_ylim(0, 1.25 * max(p[2] for p in points))
    axis.set_xlim(0.6 * points[0][0], 1.7 * points[-1][0])
    axis.set_xlabel("table, alpha x Mach points of 32 bytes [KiB]")
    axis.set_ylabel("lookup per blade, four lanes [ns]")
    axis.grid(alpha=0.3)
    return save(figure, folder, "table_size.png", "Lookup against table size")
