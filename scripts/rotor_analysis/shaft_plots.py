"""The three pictures of analyze_bag.py for a shaft."""
import numpy as np

from rotor_analysis.plots import COLOURS, draw, mark_gaps, plt, save

ORBIT_TURNS = 10     # shown in the picture of the orbits
HIGHEST = 4          # [1/rev] shown in the spectra
MICRO = 1e6


def time_histories(recording, title, file):
    figure, axes = plt.subplots(4, 2, sharex=True, figsize=(14, 10))
    figure.suptitle(title, x=0.01, ha="left")
    for column, axis_name in enumerate("xy"):
        draw(axes[0, column], recording, [(name, (x, y)[column] * MICRO) for name, x, y in recording.orbits()[:-1]], "[um]",
             f"Disc displacement {axis_name}")
        journal = recording.journal_y if column else recording.journal_x
        draw(axes[1, column], recording, [("journal", journal * MICRO)], "[um]", f"Journal displacement {axis_name}")
        draw(axes[2, column], recording, [("bearing", getattr(recording, f"bearing_force_{axis_name}")), ("film", getattr(recording, f"film_force_{axis_name}"))],
             "[N]", f"Force {axis_name} of left bearing and film on the shaft")
    draw(axes[3, 0], recording, [("eccentricity", recording.eccentricity_ratio)], "[-]", "Journal eccentricity from the housing centre, in clearances")
    draw(axes[3, 1], recording, [("speed", recording.rotor_speed * 30 / np.pi)], "[rpm]", "Rotor speed")
    for axis in axes[-1]:
        axis.set_xlabel("simulated time [s]" + ("     red lines: missing messages" if recording.gaps else ""))
    mark_gaps(axes.flat, recording)
    figure.align_ylabels(axes)
    save(figure, file)


def housing(recording):
    """(clearance, x, y) of the damper's housing [m], from positions and eccentricities of the journal; None without a damper.

    |p - centre|^2 = c^2 e^2 is linear in c^2, the centre and its square."""
    x, y = recording.journal_x, recording.journal_y
    size = max(np.ptp(x), np.ptp(y))
    if size == 0 or np.ptp(recording.eccentricity_ratio) == 0:
        return None
    columns = np.column_stack([recording.eccentricity_ratio**2, 2 * x / size, 2 * y / size, np.ones_like(x)])
    (square, centre_x, centre_y, _), *_ = np.linalg.lstsq(columns, (x**2 + y**2) / size**2, rcond=None)
    return (size * np.sqrt(square), size * centre_x, size * centre_y) if square > 0 else None


def last_turns(recording):
    """Slice of the last turns of the longest part without interruption."""
    part = recording.stretches[0]
    azimuth = recording.azimuth[part]
    begin = int(np.searchsorted(azimuth, azimuth[-1] - 2 * np.pi * ORBIT_TURNS))
    return slice(part.start + begin, part.stop)


def orbits(recording, title, file):
    part = last_turns(recording)
    shown = recording.orbits()
    figure, axes = plt.subplots(1, len(shown), figsize=(4.6 * len(shown), 5), squeeze=False)
    figure.suptitle(f"{title}, last {min(ORBIT_TURNS, np.ptp(recording.azimuth[part]) / (2 * np.pi)):.0f} turns", x=0.01, ha="left")
    for axis, colour, (name, x, y) in zip(axes[0], COLOURS, shown):
        axis.plot(x[part] * MICRO, y[part] * MICRO, color=colour)
        axis.plot(x[part][-1:] * MICRO, y[part][-1:] * MICRO, "o", color=colour, markersize=4)
        axis.set(title=f"Orbit of the {name}" if name == "journal" else f"Orbit of {name}", xlabel="x [um]", ylabel="y [um]", aspect="equal")
        axis.set_box_aspect(1)
        axis.margins(0.1)
    damper = housing(recording)
    if damper is not None:
        clearance, x, y = (MICRO * value for value in damper)
        axes[0, -1].add_patch(plt.Circle((x, y), clearance, fill=False, color="#444444", linewidth=1.2))
        axes[0, -1].plot([x], [y], "+", color="#444444")
        axes[0, -1].set(title=f"Orbit of the journal in its clearance of {clearance:.0f} um",
                        xlim=(x - 1.1 * clearance, x + 1.1 * clearance), ylim=(y - 1.1 * clearance, y + 1.1 * clearance))
    save(figure, file)


def spectra(recording, title, file):
    """Amplitude of x + i y over signed frequency per revolution, from the longest part without interruption."""
    part = recording.stretches[0]
    count = part.stop - part.start
    speed = np.mean(recording.rotor_speed[part])
    shown = recording.orbits()
    figure, axes = plt.subplots(len(shown), 1, sharex=True, figsize=(12, 2.6 * len(shown)), squeeze=False)
    figure.suptitle(title, x=0.01, ha="left")
    window = np.hanning(count)
    dt = (recording.sim_time[part][-1] - recording.sim_time[part][0]) / max(count - 1, 1)
    frequency = np.fft.fftfreq(count, dt) * 2 * np.pi / speed
    order = np.argsort(frequency)
    order = order[np.abs(frequency[order]) <= HIGHEST]
    for axis, colour, (name, x, y) in zip(axes[:, 0], COLOURS, shown):
        whirl = (x + 1j * y)[part]
        if count < 16 or not np.any(np.abs(whirl - whirl[0]) > 0):
            axis.text(0.5, 0.5, "no motion", transform=axis.transAxes, ha="center", color="#777777")
            continue
        amplitude = np.abs(np.fft.fft((whirl - np.average(whirl, weights=window)) * window)) / window.sum() * MICRO
        axis.semilogy(frequency[order], np.maximum(amplitude[order], amplitude.max() * 1e-6), color=colour)
        axis.set(title=f"Whirl of {name}", ylabel="amplitude [um]")
    axes[-1, 0].set(xlabel="frequency [1/rev], negative: backward whirl", xticks=range(-HIGHEST, HIGHEST + 1))
    save(figure, file)
