"""The four pictures of analyze_bag.py."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402

COLOURS = ["#0b5fa5", "#e07b00", "#2a9d5c", "#b8336a", "#6c5bb5", "#8a6d3b", "#3b8ea5", "#777777"]
plt.rcParams.update({
    "figure.dpi": 120, "font.size": 9, "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.6,
    "axes.spines.top": False, "axes.spines.right": False, "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "lines.linewidth": 1.0, "legend.frameon": False, "legend.fontsize": 8, "axes.titlesize": 10, "axes.titlelocation": "left",
    "figure.constrained_layout.use": True, "agg.path.chunksize": 20000})


def broken(recording, values):
    """Time and values with a NaN wherever messages are missing, so that no line bridges it."""
    ends = np.sort([s.stop for s in recording.stretches])[:-1]
    return np.insert(recording.sim_time, ends, np.nan), np.insert(values, ends, np.nan)


def draw(axis, recording, curves, label, note=None):
    """curves: (name, values) pairs."""
    for name, values in curves:
        axis.plot(*broken(recording, values), label=name)
    axis.set_ylabel(label)
    if len(curves) > 1:
        axis.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=1.2)
    if note:
        axis.set_title(note)


def mark_gaps(axes, recording):
    for axis in axes:
        for gap in recording.gaps:
            axis.axvline(gap.time, color="#cc2222", linewidth=0.8, alpha=0.6)


def save(figure, file):
    figure.savefig(file)
    plt.close(figure)


def time_histories(recording, title, file):
    degrees = 180 / np.pi
    force, moment = recording.force * 1e-3, recording.moment * 1e-3
    displacement = (recording.position - recording.position[0]) * 1e3
    elastic = np.any(recording.flap) or np.any(recording.tip_twist)
    rows = 5 if elastic else 4
    figure, axes = plt.subplots(rows, 2, sharex=True, figsize=(14, 2.5 * rows))

    def per_blade(values):
        return [(f"blade {k + 1}", values[:, k] * degrees) for k in range(recording.blades)]
    figure.suptitle(title, x=0.01, ha="left")
    draw(axes[0, 0], recording, [("collective", recording.collective * degrees), ("lateral", recording.lateral_cyclic * degrees),
                                 ("longitudinal", recording.longitudinal_cyclic * degrees)], "[deg]", "Command in effect")
    draw(axes[0, 1], recording, per_blade(recording.lag), "[deg]",
         "Lag angles, lead positive")
    draw(axes[1, 0], recording, [("forward", force[:, 0]), ("left", force[:, 1])], "[kN]", "In-plane hub force on the fuselage")
    draw(axes[1, 1], recording, [("thrust", force[:, 2])], "[kN]", "Thrust")
    draw(axes[2, 0], recording, [("roll right", moment[:, 0]), ("nose down", moment[:, 1])], "[kN m]", "Hub moment on the fuselage")
    draw(axes[2, 1], recording, [("nose left", moment[:, 2])], "[kN m]", "Yaw moment on the fuselage, nose left positive")
    draw(axes[3, 0], recording, [(name, displacement[:, i]) for i, name in enumerate("xyz")], "[mm]",
         "Fuselage displacement since the start, odom")
    draw(axes[3, 1], recording, [(name, recording.velocity[:, i]) for i, name in enumerate(("forward", "left", "up"))], "[m/s]",
         "Fuselage velocity, base_link")
    if elastic:
        draw(axes[4, 0], recording, per_blade(recording.flap), "[deg]", "Flap angles, up positive")
        draw(axes[4, 1], recording, per_blade(recording.tip_twist), "[deg]", "Elastic twist of the tips, nose up positive")
    for axis in axes[-1]:
        axis.set_xlabel("simulated time [s]" + ("     red lines: missing messages" if recording.gaps else ""))
    mark_gaps(axes.flat, recording)
    figure.align_ylabels(axes)
    save(figure, file)


def whirl_spectrum(axis, recording, cosine, sine):
    """Amplitude over signed frequency per revolution, from the longest part without interruption."""
    part = recording.stretches[0]
    count = part.stop - part.start
    speed = np.mean(recording.rotor_speed[part])
    if count < 16 or not np.any(np.ptp([cosine[part], sine[part]], axis=1) > 0):
        axis.text(0.5, 0.5, "no motion", transform=axis.transAxes, ha="center", color="#777777")
        axis.set(xticks=[], yticks=[])
        return
    whirl = (cosine + 1j * sine)[part]
    window = np.hanning(count)
    amplitude = np.abs(np.fft.fft((whirl - np.average(whirl, weights=window)) * window)) / window.sum() * 180 / np.pi
    dt = (recording.sim_time[part][-1] - recording.sim_time[part][0]) / (count - 1)
    frequency = np.fft.fftfreq(count, dt) * 2 * np.pi / speed
    shown = np.argsort(frequency)
    shown = shown[np.abs(frequency[shown]) <= recording.blades + 1]
    axis.semilogy(frequency[shown], np.maximum(amplitude[shown], amplitude.max() * 1e-5))
    axis.set_xticks(range(-recording.blades - 1, recording.blades + 2))


def multiblade(recording, title, file):
    degrees = 180 / np.pi
    moving = [name for name in ("lag", "flap") if name == "lag" or np.any(recording.flap_collective) or np.any(recording.flap_cosine)]
    figure, axes = plt.subplots(len(moving), 2, figsize=(13, 0.6 + 3.6 * len(moving)), squeeze=False,
                                gridspec_kw={"width_ratios": [2, 1.2]})
    figure.suptitle(title, x=0.01, ha="left")
    for row, name in zip(axes, moving):
        collective, cosine, sine = (getattr(recording, f"{name}_{part}") for part in ("collective", "cosine", "sine"))
        for label, values in (("collective", collective), ("cosine", cosine), ("sine", sine)):
            row[0].plot(*broken(recording, values * degrees), label=label)
        row[0].set(ylabel="[deg]", title=f"Multiblade {name} coordinates", xlabel="simulated time [s]")
        row[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderaxespad=0.2)
        row[1].set(title=f"Spectrum of the {name} whirl (cosine + i sine)", ylabel="amplitude [deg]",
                   xlabel="frequency [1/rev], negative: regressive")
        whirl_spectrum(row[1], recording, cosine, sine)
    mark_gaps(axes[:, 0], recording)
    save(figure, file)


def hub_harmonics(harmonics, blades, title, file):
    """harmonics: of the columns Fx, Fy, Fz [N], Mx, My, Mz [N m]."""
    figure, axes = plt.subplots(2, 3, figsize=(13, 6.5), sharex=True)
    figure.suptitle(title, x=0.01, ha="left")
    names = ("Force forward", "Force left", "Thrust", "Moment roll right", "Moment nose down", "Moment nose left")
    orders = np.arange(1, len(harmonics.amplitude))
    # Round-off of the largest load is not a harmonic.
    floor = np.repeat([1e-9 * np.abs(harmonics.amplitude[:, :3]).max(), 1e-9 * np.abs(harmonics.amplitude[:, 3:]).max()], 3)
    for column, (axis, name) in enumerate(zip(axes.flat, names)):
        unit = "N" if column < 3 else "N m"
        amplitude = harmonics.amplitude[1:, column]
        axis.bar(orders, amplitude, color=[COLOURS[1] if k % blades == 0 else COLOURS[0] for k in orders], width=0.7)
        axis.set(title=name, ylabel=f"amplitude [{unit}]", ylim=(0, 1.22 * amplitude.max() if amplitude.max() > floor[column] else 1.0))
        axis.text(0.99, 0.99, f"mean {harmonics.amplitude[0, column]:.4g} {unit}\nnot in these harmonics {harmonics.residual[column]:.2g} {unit} rms",
                  transform=axis.transAxes, ha="right", va="top", fontsize=8, color="#555555")
        axis.grid(axis="x", visible=False)
        axis.set_axisbelow(True)
    for axis in axes[1]:
        axis.set_xticks(orders)
        axis.set_xlabel(f"harmonic [1/rev] (orange: multiples of {blades})")
    save(figure, file)


def lag_damping(recording, damping, title, file):
    degrees = 180 / np.pi
    figure = plt.figure(figsize=(12, 7.5))
    figure.suptitle(title, x=0.01, ha="left")
    top, middle, table = figure.subplots(3, 1, gridspec_kw={"height_ratios": [1, 1.1, 0.16 + 0.07 * len(damping.found)]})
    time = recording.sim_time[damping.part]
    for name in ("collective", "cosine", "sine"):
        top.plot(time, getattr(recording, f"lag_{name}")[damping.part] * degrees, label=name)
    top.set(title=f"Multiblade lag coordinates: {damping.note}", ylabel="[deg]", xlabel="simulated time [s]")
    top.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderaxespad=0.2)

    rows = []
    for number, lag in enumerate(damping.found):
        colour = COLOURS[number % len(COLOURS)]
        frequency = f"{lag.mode.frequency / damping.rotor_speed:+.3f}"
        check = "record too short"
        if lag.check is not None:
            check = f"{lag.check.growth:+.4f} (scatter {lag.check.scatter:.1g})"
            middle.plot(time[0] + lag.check.time, lag.check.logarithm, color=colour, linewidth=2.2, alpha=0.6,
                        label=f"{lag.coordinate} at {frequency}/rev")
            middle.plot(time[0] + lag.check.time, lag.check.growth * lag.check.time + lag.check.offset, "--", color=colour)
        rows.append([lag.coordinate, f"{lag.mode.frequency:+.3f}", frequency, f"{lag.mode.growth:+.4f}",
                     f"{100 * lag.mode.damping_ratio:+.2f} %", check, "steady vibration" if lag.forced else
                     "growing" if lag.mode.growth > 0 else "damped"])
    middle.set(title="Moving block: logarithm of the amplitude [rad] and its straight line", ylabel="ln amplitude", xlabel="centre of the block [s]")
    if any(lag.check is not None for lag in damping.found):
        middle.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8)
    else:
        middle.text(0.5, 0.5, "fewer than two periods per block", transform=middle.transAxes, ha="center", color="#777777")
    table.axis("off")
    cells = table.table(cellText=rows, loc="upper center", cellLoc="center", edges="horizontal", bbox=[0, 0, 1, 1], colLabels=[
        "coordinate", "frequency [rad/s]", "per rev", "growth, matrix pencil [1/s]", "damping ratio", "growth, moving block [1/s]", "kind"])
    cells.auto_set_font_size(False)
    cells.set_fontsize(8.5)
    save(figure, file)
