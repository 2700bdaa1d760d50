#!/usr/bin/python3
"""Plots a recording of the node. Of a rotor: time histories, multiblade coordinates, harmonics of the hub loads, lag damping; of a
shaft: time histories, orbits, spectra.

Reads the heerk_rotor/RotorState or ShaftState messages of a bag and writes PNG files; prints what it found, gaps in the step numbers first.
Exit status: 0 done, 2 bad arguments or a bag that cannot be analysed.
"""
import argparse
import pathlib
import sys

try:
    import numpy as np
    from rotor_analysis import recording as recordings
except ImportError as error:
    sys.exit(f"analyze_bag: {error}; on Debian: scripts/install_dependencies.sh plots")

LEAST_REVOLUTIONS = 2   # below, nothing but time histories could be shown


def describe(recording):
    """What was recorded and what is missing, as text."""
    duration = recording.sim_time[-1] - recording.sim_time[0]
    lines = [f"{recording.topic}: {len(recording.step)} states, steps {recording.step[0]}..{recording.step[-1]} by {recording.stride}, "
             f"{duration:.3f} s, {np.ptp(recording.azimuth) / (2 * np.pi):.1f} revolutions, {recording.parts}"]
    missing = sum(gap.missing for gap in recording.gaps)
    if recording.gaps:
        lines.append(f"gaps: {len(recording.gaps)}, {missing} messages missing ({100 * missing / (missing + len(recording.step)):.2g} %)")
        lines += [f"  after step {gap.step} (t = {gap.time:.4f} s): {gap.missing} missing" for gap in recording.gaps[:10]]
        if len(recording.gaps) > 10:
            lines.append(f"  and {len(recording.gaps) - 10} more")
    else:
        lines.append("gaps: none")
    if recording.disordered:
        lines.append(f"{recording.disordered} messages are out of order or doubled")
    if recording.epoch[0] != recording.epoch[-1]:
        lines.append(f"epochs {recording.epoch[0]}..{recording.epoch[-1]}: the state was reset or loaded in between")
    if len(recording.stretches) > 1:
        part = recording.stretches[0]
        lines.append(f"harmonics, damping, orbits and spectra use the longest part without interruption: t = {recording.sim_time[part.start]:.3f}.."
                     f"{recording.sim_time[part.stop - 1]:.3f} s")
    return "\n".join(lines)


def describe_damping(damping):
    if isinstance(damping, str):
        return f"lag damping: none; {damping}"
    lines = [f"lag damping ({damping.note}; frequencies in the non-rotating frame, negative: regressive):"]
    for lag in damping.found:
        check = "" if lag.check is None else f", moving block {lag.check.growth:+.4f}"
        kind = "  (steady vibration)" if lag.forced else ""
        lines.append(f"  {lag.coordinate}: {lag.mode.frequency:+.4f} rad/s ({lag.mode.frequency / damping.rotor_speed:+.3f}/rev), growth by matrix "
                     f"pencil {lag.mode.growth:+.4f} 1/s{check}, damping ratio {100 * lag.mode.damping_ratio:+.3f} %{kind}")
    return "\n".join(lines)


def plot_rotor(recording, arguments, output):
    """The files written."""
    from rotor_analysis import damping as lag_modes, harmonics, plots
    written = []

    def picture(name):
        written.append(output / name)
        return written[-1]

    plots.time_histories(recording, f"{arguments.bag.name}: time histories", picture("time_histories.png"))
    plots.multiblade(recording, f"{arguments.bag.name}: multiblade coordinates", picture("multiblade.png"))
    part = recording.stretches[0]
    loads = harmonics.per_revolution(recording.azimuth[part], np.hstack([recording.force, recording.moment])[part], arguments.highest)
    if loads is None:
        print("hub load harmonics: none; less than one revolution without interruption, or too few states per revolution")
    else:
        plots.hub_harmonics(loads, recording.blades, f"{arguments.bag.name}: hub loads over the last {loads.revolutions} revolutions, by azimuth",
                            picture("hub_load_harmonics.png"))
    damping = lag_modes.lag_damping(recording)
    print(describe_damping(damping))
    if not isinstance(damping, str):
        plots.lag_damping(recording, damping, f"{arguments.bag.name}: lag damping by matrix pencil (Prony) and moving block",
                          picture("lag_damping.png"))
    return written


def plot_shaft(recording, arguments, output):
    """The files written."""
    from rotor_analysis import shaft_plots
    written = [output / name for name in ("time_histories.png", "orbits.png", "spectrum.png")]
    shaft_plots.time_histories(recording, f"{arguments.bag.name}: time histories", written[0])
    shaft_plots.orbits(recording, f"{arguments.bag.name}: orbits", written[1])
    shaft_plots.spectra(recording, f"{arguments.bag.name}: whirl spectra", written[2])
    return written


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bag", type=pathlib.Path, help="recording made by rosbag record, record.launch or simulate --output")
    parser.add_argument("--output", type=pathlib.Path, metavar="DIR", help="where the plots go (default: <bag>_plots beside the bag)")
    parser.add_argument("--topic", help="topic of the states, when the bag has several (default: the only one)")
    parser.add_argument("--from", type=float, dest="begin", metavar="T", help="[s] simulated time to begin at")
    parser.add_argument("--to", type=float, dest="end", metavar="T", help="[s] simulated time to end at")
    parser.add_argument("--highest", type=int, default=12, metavar="K", help="highest harmonic per revolution (default 12)")
    arguments = parser.parse_args()

    try:
        recording = recordings.read(arguments.bag, arguments.topic, arguments.begin, arguments.end)
        revolutions = np.ptp(recording.azimuth) / (2 * np.pi)
        if np.ptp(recording.rotor_speed) == 0 and recording.rotor_speed[0] == 0:
            raise recordings.RecordingError(f"{arguments.bag}: it stands still; expected a turning rotor or shaft")
        if revolutions < LEAST_REVOLUTIONS:
            raise recordings.RecordingError(f"{arguments.bag}: too short: {revolutions:.2f} revolutions in {len(recording.step)} states;"
                                            f" expected at least {LEAST_REVOLUTIONS}")
        output = arguments.output or arguments.bag.with_name(arguments.bag.stem + "_plots")
        output.mkdir(parents=True, exist_ok=True)
    except recordings.RecordingError as error:
        print(f"analyze_bag: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"analyze_bag: cannot write to {arguments.output}: {error}", file=sys.stderr)
        return 2

    print(describe(recording))
    plot = plot_shaft if isinstance(recording, recordings.ShaftRecording) else plot_rotor
    try:
        written = plot(recording, arguments, output)
    except ImportError as error:  # scipy and matplotlib, which take seconds to load
        sys.exit(f"analyze_bag: {error}; on Debian: scripts/install_dependencies.sh plots")
    print("written:", *written, sep="\n  ")
    return 0


if __name__ == "__main__":
    sys.exit(main())
