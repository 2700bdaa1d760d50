"""Lag damping of a recording: which part is a free response, which modes its multiblade lag coordinates show."""
import dataclasses

import numpy as np

from . import modes


@dataclasses.dataclass
class LagMode:
    coordinate: str                    # 'collective lag' or 'cyclic lag' (cosine + i sine)
    mode: modes.Mode
    check: modes.MovingBlock           # None where the record is too short for it
    forced: bool                       # a steady multiple of 1/rev: vibration, not a free motion


@dataclasses.dataclass
class LagDamping:
    part: slice         # of the recording
    rotor_speed: float  # [rad/s] mean over it
    found: list         # LagMode, strongest first per coordinate
    note: str           # how the part was chosen


def free_part(recording):
    """The longest stretch without gap, from the last change of the command on; all of it when that leaves under 40 %."""
    stretch = recording.stretches[0]
    commands = np.column_stack([recording.collective, recording.lateral_cyclic, recording.longitudinal_cyclic])[stretch]
    changes = np.flatnonzero(np.any(np.diff(commands, axis=0) != 0.0, axis=1))
    if len(changes) == 0:
        return stretch, "no command changed"
    start = stretch.start + int(changes[-1]) + 1
    if stretch.stop - start < 0.4 * (stretch.stop - stretch.start):
        return stretch, "the command changes within it: forced response included, damping is indicative only"
    return slice(start, stretch.stop), "after the last change of command"


def lag_damping(recording):
    """LagDamping, or a sentence saying why there is none."""
    part, note = free_part(recording)
    time = recording.sim_time[part]
    rotor_speed = float(np.mean(recording.rotor_speed[part]))
    if abs(rotor_speed) < 1e-3:
        return "the rotor does not turn, so modes cannot be told from vibration"
    revolution = 2 * np.pi / abs(rotor_speed)
    if time[-1] - time[0] < 5 * revolution:
        return f"{time[-1] - time[0]:.3g} s without gap or command are too short; expected 5 revolutions, {5 * revolution:.3g} s"
    dt = (time[-1] - time[0]) / (len(time) - 1)
    if 2 * np.pi / dt < 8 * abs(rotor_speed):
        return f"{1 / dt:.3g} states per second are too few; expected 8 per revolution"
    found = []
    for name, signal in (("collective lag", recording.lag_collective[part]),
                         ("cyclic lag", recording.lag_cosine[part] + 1j * recording.lag_sine[part])):
        if np.ptp(signal.real) < 1e-9 and np.ptp(np.imag(signal)) < 1e-9:
            continue
        thinned, step = modes.decimated(signal, dt, 2 * abs(rotor_speed))
        poles = modes.matrix_pencil(thinned[:1500], step)
        # Constant and slow parts would leak into the moving block of a weak mode.
        slow = [m for m in poles if abs(m.frequency) < 0.02 * abs(rotor_speed)]
        moving = thinned - (np.mean(thinned) if slow else 0.0)
        oscillating = [m for m in poles if 0.02 * abs(rotor_speed) <= abs(m.frequency) <= 2.2 * abs(rotor_speed)]
        strongest = max((m.amplitude for m in oscillating), default=0.0)
        for mode in oscillating:
            if mode.amplitude < 0.02 * strongest or mode.damping_ratio > 0.5:
                continue
            per_rev = mode.frequency / rotor_speed
            forced = abs(per_rev - round(per_rev)) < 0.01 and abs(mode.growth) < 0.002 * abs(rotor_speed)
            found.append(LagMode(name, mode, modes.moving_block(moving, step, mode.frequency), forced))
    return LagDamping(part, rotor_speed, found, note) if found else "the lag angles do not oscillate"
