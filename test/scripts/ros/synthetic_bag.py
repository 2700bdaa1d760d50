"""A recording whose damping, harmonics and gaps are known exactly."""
import math

import rosbag
import rospy
from heerk_rotor.msg import RotorState

ROTOR_SPEED = 41.0                      # [rad/s]
STEP = math.radians(1.0) / ROTOR_SPEED  # [s] one degree
BLADES = 4
REGRESSIVE = (-0.8, -0.62 * ROTOR_SPEED, 0.010)    # growth [1/s], frequency [rad/s], amplitude [rad] of the lag whirl
PROGRESSIVE = (-1.5, 1.38 * ROTOR_SPEED, 0.004)
COLLECTIVE = (-1.2, 0.38 * ROTOR_SPEED, 0.006)
THRUST_4REV = 900.0                     # [N]


def mode(parameters, t):
    growth, frequency, amplitude = parameters
    size = amplitude * math.exp(growth * t)
    return size * math.cos(frequency * t), size * math.sin(frequency * t)


def state(step):
    """The message of one step."""
    t = step * STEP
    m = RotorState()
    m.header.stamp = rospy.Time.from_sec(1000.0 + t)
    m.header.frame_id = "hub_link"
    m.step, m.sim_time, m.azimuth, m.rotor_speed = step, t, ROTOR_SPEED * t, ROTOR_SPEED
    regressive, progressive = mode(REGRESSIVE, t), mode(PROGRESSIVE, t)
    m.lag_collective = -0.01 + mode(COLLECTIVE, t)[0]
    m.lag_cosine, m.lag_sine = (regressive[i] + progressive[i] for i in (0, 1))
    psi = [m.azimuth + 2 * math.pi * k / BLADES for k in range(BLADES)]
    m.lag = [m.lag_collective + m.lag_cosine * math.cos(p) + m.lag_sine * math.sin(p) for p in psi]
    m.flap_collective, m.flap_cosine, m.flap_sine = 0.05, 0.01, -0.004
    m.flap = [m.flap_collective + m.flap_cosine * math.cos(p) + m.flap_sine * math.sin(p) for p in psi]
    m.lag_rate = m.flap_rate = m.tip_twist = [0.0] * BLADES
    m.collective = math.radians(8.0 if t > 0.1 else 7.0)
    m.lateral_cyclic, m.longitudinal_cyclic = math.radians(1.0), math.radians(-2.0)
    m.pitch = [m.collective] * BLADES
    m.hub.force.x = 250.0 * m.lag_sine / 0.01
    m.hub.force.y = 250.0 * m.lag_cosine / 0.01
    m.hub.force.z = 22e3 + THRUST_4REV * math.cos(4 * m.azimuth + 0.3)
    m.hub.torque.x = 120.0 * math.cos(4 * m.azimuth) + 30.0 * math.sin(8 * m.azimuth)
    m.hub.torque.z = -9.0e3
    m.fuselage_pose.orientation.w = 1.0
    m.fuselage_pose.position.x, m.fuselage_pose.position.y = 0.02 * m.lag_cosine, -0.02 * m.lag_sine
    m.fuselage_twist.linear.x = 0.4 * m.lag_sine
    m.command_source = "ros"
    return m


def write(file, duration, every=4, lost=(), topic="/rotor/state"):
    """Writes `duration` [s] of states, every `every`-th step, without the steps in `lost`; the number of states written."""
    count = 0
    with rosbag.Bag(str(file), "w") as bag:
        for step in range(0, int(duration / STEP), every):
            if step not in lost:
                message = state(step)
                bag.write(topic, message, message.header.stamp)
                count += 1
    return count
