#!/usr/bin/python3
"""Prints the URDF of the configured rotor: urdf/fuselage.urdf scaled to its radius, with hub and blades; of a shaft with discs its frame.

rotor_joint's position is the azimuth psi in the sense of rotation: 0 puts blade 1 over the tail. Blade frames: x outboard, z up; positive
joint angles are flap up, lead, nose up, also on a clockwise rotor, whose blades follow each other the other way round. Blade 1 has the
orange tip. Elastic blades are drawn by the node (rotor/blades, blade 1 with an orange shank); here they have only their grips.
A configuration that cannot be read is the node's to complain about: the picture of a usual rotor takes its place.
"""
import argparse
import math
import pathlib
import sys
import xml.etree.ElementTree as xml

import yaml

DRAWN_RADIUS = 5.0     # [m] of the rotor that the fuselage was drawn for
COWLING_TOP = 0.65     # [m] in that drawing: the mast comes out of it


def override(configuration, assignment):
    """`a.b.0=value`, as the node's ~set."""
    path, _, value = assignment.partition("=")
    *parents, last = [int(key) if key.isdigit() else key for key in path.split(".")]
    for key in parents:
        configuration = configuration[key]
    configuration[last] = yaml.safe_load(value)


class Rotor:
    """Sizes [m] and angles [rad] of the picture, from whatever subsystem gives the key; the rotor of Section 3 for what none gives."""

    def __init__(self, configuration):
        subsystems = [s for s in (configuration.get("subsystems") or {}).values() if isinstance(s, dict)]

        def find(key, fallback):
            return next((s[key] for s in subsystems if key in s), fallback)
        blades = [s for s in subsystems if s.get("type") == "fe_rotor"]
        self.elastic = bool(blades)
        self.blades = int(blades[0].get("blades", 4)) if blades else 4
        if not 2 <= self.blades <= 8:
            raise ValueError(f"{self.blades} blades, expected 2 to 8")
        nodes = blades[0].get("nodes", [0.2, 4.91]) if blades else []
        self.hinge = 0.0 if blades else float(find("hinge_offset", 0.2))
        self.radius = float(nodes[-1] if blades else find("radius", self.hinge + 2.0 * float(find("blade_length", 2.4))))
        self.cutout = float(find("root_cutout", 0.16 * self.radius))
        chord = find("chord", self.radius / 16.0)
        self.chord = float(chord[-1] if isinstance(chord, list) else chord)
        self.hub = [float(v) for v in find("hub_offset", [0.0, 0.0, 1.5])]
        self.tilt = math.radians(float(find("shaft_tilt_forward_deg", 0.0)))
        self.sense = -1 if find("rotation", "ccw") == "cw" else 1


def text(*numbers):
    return " ".join(f"{number:.6g}" for number in numbers)


def add_visual(link, shape, size, material, xyz=(0, 0, 0), rpy=(0, 0, 0)):
    visual = xml.SubElement(link, "visual")
    xml.SubElement(visual, "origin", xyz=text(*xyz), rpy=text(*rpy))
    xml.SubElement(xml.SubElement(visual, "geometry"), shape, {key: text(*value) if isinstance(value, tuple) else text(value) for key, value in size.items()})
    xml.SubElement(visual, "material", name=material)


def add_joint(robot, name, kind, parent, child, xyz=(0, 0, 0), rpy=(0, 0, 0), axis=None):
    joint = xml.SubElement(robot, "joint", name=name, type=kind)
    xml.SubElement(joint, "parent", link=parent)
    xml.SubElement(joint, "child", link=child)
    xml.SubElement(joint, "origin", xyz=text(*xyz), rpy=" ".join(repr(float(angle)) for angle in rpy))
    if axis is not None:
        xml.SubElement(joint, "axis", xyz=text(*axis))
    if kind == "revolute":
        xml.SubElement(joint, "limit", lower="-0.8", upper="0.8", effort="0", velocity="100")
    return xml.SubElement(robot, "link", name=child)


def scale_fuselage(robot, scale):
    for element in robot.iter():
        for key in ("xyz", "size", "radius", "length"):
            if key in element.attrib:
                element.set(key, text(*(scale * float(number) for number in element.get(key).split())))


def add_hub(robot, rotor, scale):
    hub = add_joint(robot, "hub_joint", "fixed", "base_link", "hub_link", rotor.hub, (0.0, rotor.tilt, 0.0))
    mast = max((rotor.hub[2] - COWLING_TOP * scale) / math.cos(rotor.tilt), 0.1)
    add_visual(hub, "cylinder", {"radius": 0.09 * scale, "length": mast}, "metal", (0, 0, -0.5 * mast))
    turning = add_joint(robot, "rotor_joint", "continuous", "hub_link", "rotor_link", rpy=(0.0, 0.0, math.pi), axis=(0, 0, rotor.sense))
    add_visual(turning, "cylinder", {"radius": 0.17 * scale, "length": 0.2 * scale}, "metal")
    add_visual(turning, "sphere", {"radius": 0.13 * scale}, "dark", (0, 0, 0.1 * scale))


def add_blade(robot, rotor, number, scale):
    angle = rotor.sense * 2.0 * math.pi * (number - 1) / rotor.blades
    name = f"blade_{number}"
    position = (rotor.hinge * math.cos(angle), rotor.hinge * math.sin(angle), 0.0)
    add_joint(robot, f"{name}_flap_joint", "revolute", "rotor_link", f"{name}_flap_link", position, (0.0, 0.0, angle), (0, -1, 0))
    hinge = add_joint(robot, f"{name}_lag_joint", "revolute", f"{name}_flap_link", f"{name}_lag_link", axis=(0, 0, rotor.sense))
    blade = add_joint(robot, f"{name}_pitch_joint", "revolute", f"{name}_lag_link", f"{name}_link", axis=(rotor.sense, 0, 0))
    along = (0.0, math.pi / 2, 0.0)
    if rotor.elastic:  # the node's picture of the blade begins at 0.04 R
        grip = 0.06 * rotor.radius
        add_visual(blade, "cylinder", {"radius": 0.055 * scale, "length": grip}, "metal", (0.5 * grip, 0, 0), along)
        return
    cuff, span, tip = rotor.cutout - rotor.hinge, rotor.radius - rotor.cutout, 0.07 * rotor.radius
    add_visual(hinge, "cylinder", {"radius": 0.07 * scale, "length": 0.16 * scale}, "metal")
    add_visual(blade, "cylinder", {"radius": 0.05 * scale, "length": cuff}, "metal", (0.5 * cuff, 0, 0), along)
    # A little slimmer than the node's markers, which show the load on the blade, but for the tip.
    add_visual(blade, "box", {"size": (0.98 * (span - tip), 0.87 * rotor.chord, 0.08 * rotor.chord)}, "blade", (cuff + 0.5 * (span - tip), 0, 0))
    add_visual(blade, "box", {"size": (tip, 1.03 * rotor.chord, 0.175 * rotor.chord)}, "tip_of_blade_1" if number == 1 else "tip",
               (cuff + span - 0.5 * tip, 0, 0))


def describe(rotor, fuselage):
    robot = xml.parse(fuselage).getroot()
    scale = rotor.radius / DRAWN_RADIUS
    scale_fuselage(robot, scale)
    add_hub(robot, rotor, scale)
    for number in range(1, rotor.blades + 1):
        add_blade(robot, rotor, number, scale)
    return xml.tostring(robot, encoding="unicode")


def is_shaft(configuration):
    return any(isinstance(s, dict) and s.get("type") == "shaft_rotor" for s in (configuration.get("subsystems") or {}).values())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("config", help="configuration file")
    parser.add_argument("--set", default="[]", metavar="LIST", help="overrides as in rotor.launch, e.g. ['subsystems.rotor.blades=5']")
    arguments = parser.parse_args()
    try:
        configuration = yaml.safe_load(pathlib.Path(arguments.config).read_text())
        for assignment in yaml.safe_load(arguments.set) or []:
            override(configuration, assignment)
        if is_shaft(configuration):  # which the node draws (shaft/orbit)
            print('<robot name="shaft"><link name="shaft_link"/></robot>')
            return
        rotor = Rotor(configuration)
    except (OSError, yaml.YAMLError, ValueError, TypeError, KeyError, IndexError, AttributeError) as error:
        print(f"robot_description: {arguments.config}: {error}; drawing a usual rotor", file=sys.stderr)
        rotor = Rotor({})
    print(describe(rotor, pathlib.Path(__file__).resolve().parent.parent / "urdf" / "fuselage.urdf"))


if __name__ == "__main__":
    main()
