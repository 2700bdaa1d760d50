"""Reads the state messages of a bag, of a rotor or of a shaft, into arrays and finds out where messages are missing."""
import dataclasses
import pathlib

import numpy as np
import rosbag

SCALARS = ("lag_collective", "lag_cosine", "lag_sine", "flap_collective", "flap_cosine",
           "flap_sine", "collective", "lateral_cyclic", "longitudinal_cyclic", "thrust_coefficient", "advance_ratio")
SHAFT_SCALARS = ("journal_x", "journal_y", "eccentricity_ratio", "bearing_force_x", "bearing_force_y", "film_force_x", "film_force_y")


class RecordingError(Exception):
    """The bag cannot be analysed; the message says what is wrong and what was expected."""


@dataclasses.dataclass
class Gap:
    """Messages missing between two neighbours of one epoch."""
    time: float    # [s] simulation time of the last message before it
    step: int      # [-] its step number
    missing: int   # [-] messages that should lie between


class StateSeries:
    """The state messages of one topic in order of arrival. SI units and radians, axes of the message.

    step, epoch (n,) int; sim_time, azimuth, rotor_speed (n,).
    stride: step difference of neighbours without loss. gaps: where messages are missing. stretches: slices of neighbours
    without gap, change of epoch or disorder, the longest first.
    """

    def __init__(self, topic, messages):
        self.topic = topic
        self.step = np.array([m.step for m in messages], dtype=np.int64)
        self.epoch = np.array([m.epoch for m in messages], dtype=np.int64)
        for name in ("sim_time", "azimuth", "rotor_speed"):
            setattr(self, name, np.array([getattr(m, name) for m in messages]))

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


class Recording(StateSeries):
    """Of a rotor: the names of SCALARS (n,); lag, flap, tip_twist, pitch (n, blades); force, moment, position, velocity (n, 3)."""

    def __init__(self, topic, messages):
        super().__init__(topic, messages)
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

    @property
    def blades(self):
        return self.lag.shape[1]

    @property
    def parts(self):
        return f"{self.blades} blades"


class ShaftRecording(StateSeries):
    """Of a shaft: the names of SHAFT_SCALARS (n,); disc_x, disc_y (n, discs)."""

    def __init__(self, topic, messages):
        super().__init__(topic, messages)
        for name in SHAFT_SCALARS:
            setattr(self, name, np.array([getattr(m, name) for m in messages]))
        discs = {len(m.disc_x) for m in messages}
        if len(discs) != 1:
            raise RecordingError(f"{topic}: the number of discs changes within the bag: {sorted(discs)}; expected one shaft")
        self.disc_x, self.disc_y = np.array([m.disc_x for m in messages]), np.array([m.disc_y for m in messages])

    @property
    def discs(self):
        return self.disc_x.shape[1]

    @property
    def parts(self):
        return f"{self.discs} discs"

    def orbits(self):
        """(name, x, y) of the discs and the journal [m]."""
        return [(f"disc {k + 1}", self.disc_x[:, k], self.disc_y[:, k]) for k in range(self.discs)] + [("journal", self.journal_x, self.journal_y)]


TYPES = {"heerk_rotor/RotorState": Recording, "heerk_rotor/ShaftState": ShaftRecording}


def read(file, topic=None, begin=None, end=None):
    """The recording in `file`, of `topic` or of the only topic with state messages, between two simulation times [s].

    Raises RecordingError: no such file, not a bag, no such messages, or too few of them."""
    if not pathlib.Path(file).is_file():
        raise RecordingError(f"{file}: no such file")
    try:
        with rosbag.Bag(str(file)) as bag:
            types = {name: info.msg_type for name, info in bag.get_type_and_topic_info().topics.items()}
            topics = [name for name, msg_type in types.items() if msg_type in TYPES]
            if topic is None and len(topics) > 1:
                raise RecordingError(f"{file}: several topics carry states: {', '.join(sorted(topics))}; choose with --topic")
            if not topics or (topic is not None and topic not in topics):
                found = ", ".join(f"{n} ({t})" for n, t in sorted(types.items())) or "no messages at all"
                raise RecordingError(f"{file}: no {' or '.join(TYPES)} on {topic or 'any topic'} (expected rotor/state or shaft/state); found {found}")
            chosen = topic or topics[0]
            messages = [m for _, m, _ in bag.read_messages(topics=[chosen])
                        if (begin is None or m.sim_time >= begin) and (end is None or m.sim_time <= end)]
    except rosbag.ROSBagUnindexedException:
        raise RecordingError(f"{file}: the recording was not closed properly; repair it with: rosbag reindex {file}") from None
    except rosbag.ROSBagException as error:
        raise RecordingError(f"{file}: not a readable bag: {error}") from None
    if len(messages) < 2:
        raise RecordingError(f"{file}: {len(messages)} messages of {chosen} in the chosen time; expected at least 2")
    return TYPES[types[chosen]](chosen, messages)
