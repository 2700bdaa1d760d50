"""Reads the RotorState messages of a bag into arrays and finds out where messages are missing."""
import dataclasses
import pathlib

import numpy as np
import rosbag

TYPE = "heerk_rotor/RotorState"
SCALARS = ("sim_time", "azimuth", "rotor_speed", "lag_collective", "lag_cosine", "lag_sine", "flap_collective", "flap_cosine",
           "flap_sine", "collective", "lateral_cyclic", "longitudinal_cyclic", "thrust_coefficient", "advance_ratio")


class RecordingError(Exception):
    """The bag cannot be analysed; the message says what is wrong and what was expected."""


@dataclasses.dataclass
class Gap:
    """Messages missing between two neighbours of one epoch."""
    time: float    # [s] simulation time of the last message before it
    step: int      # [-] its step number
    missing: int   # [-] messages that should lie between


class Recording:
    """The state messages of one topic in order of arrival. SI units and radians, axes of RotorState.msg.

    step, epoch (n,) int; the names of SCALARS (n,); lag, flap, tip_twist, pitch (n, blades); force, moment, position, velocity (n, 3).
    stride: step difference of neighbours without loss. gaps: where messages are missing. stretches: slices of neighbours
    without gap, change of epoch or disorder, the longest first.
    """

    def __init__(self, topic, messages):
        self.topic = topic
        self.step = np.array([m.step for m in messages], dtype=np.int64)
        self.epoch = np.array([m.epoch for m in messages], dtype=np.int64)
        for name in SCALARS:
            setattr(self, name, np.array([getattr(m, name) for m in messages]))
        blades = {len(m.lag) for m in messages}
        if len(blades) != 1:
            raise RecordingError(f"{topic}: the number of blades changes within the bag: {sorted(blades)}; expected one rotor")
        self.lag = np.array([m.lag for m in messages])
        self.flap, self.tip_twist = np.array([m.flap for m in messages]), np.array([m.tip_twist for m in messages])
        self.pitch = np.array([m.pitch for m in messages])

        def vector(get):
            return np.array([(get(m).x, get(m).y, get(m).z) for m in messages])
        self.force, self.moment = vector(lambda m: m.hub.force), vector(lambda m: m.hub.torque)
        self.position, self.velocity = vector(lambda m: m.fuselage_pose.position), vector(lambda m: m.fuselage_twist.linear)

        difference = np.diff(self.step)
        regular = (np.diff(self.epoch) == 0) & (difference > 0)
        if not regular.any():
            raise RecordingError(f"{topic}: step numbers never increase within one epoch; expected consecutive states")
        values, counts = np.unique(difference[regular], return_counts=True)
        self.stride = int(values[np.argmax(counts)])
        jumps = np.flatnonzero(regular & (difference > self.stride))
        self.gaps = [Gap(self.sim_time[i], int(self.step[i]), int(round(difference[i] / self.stride)) - 1) for i in jumps]
        self.disordered = int(np.count_nonzero((np.diff(self.epoch) == 0) & (difference <= 0)))
        ends = np.flatnonzero(~regular | (difference != self.stride)) + 1
        borders = [0, *ends, len(self.step)]
        self.stretches = sorted((slice(a, b) for a, b in zip(borders, borders[1:])), key=lambda s: s.start - s.stop)

    @property
    def blades(self):
        return self.lag.shape[1]


def read(file, topic=None, begin=None, end=None):
    """The recording in `file`, of `topic` or of the only topic with RotorState messages, between two simulation times [s].

    Raises RecordingError: no such file, not a bag, no such messages, or too few of them."""
    if not pathlib.Path(file).is_file():
        raise RecordingError(f"{file}: no such file")
    try:
        with rosbag.Bag(str(file)) as bag:
            types = {name: info.msg_type for name, info in bag.get_type_and_topic_info().topics.items()}
            topics = [name for name, msg_type in types.items() if msg_type == TYPE]
            if topic is None and len(topics) > 1:
                raise RecordingError(f"{file}: several topics carry {TYPE}: {', '.join(sorted(topics))}; choose with --topic")
            if not topics or (topic is not None and topic not in topics):
                found = ", ".join(f"{n} ({t})" for n, t in sorted(types.items())) or "no messages at all"
                raise RecordingError(f"{file}: no {TYPE} on {topic or 'any topic'} (expected rotor/state); found {found}")
            chosen = topic or topics[0]
            messages = [m for _, m, _ in bag.read_messages(topics=[chosen])
                        if (begin is None or m.sim_time >= begin) and (end is None or m.sim_time <= end)]
    except rosbag.ROSBagUnindexedException:
        raise RecordingError(f"{file}: the recording was not closed properly; repair it with: rosbag reindex {file}") from None
    except rosbag.ROSBagException as error:
        raise RecordingError(f"{file}: not a readable bag: {error}") from None
    if len(messages) < 2:
        raise RecordingError(f"{file}: {len(messages)} messages of {chosen} in the chosen time; expected at least 2")
    return Recording(chosen, messages)
