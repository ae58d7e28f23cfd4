"""Instrument cluster: hood, dials with needles, gear display, warning lamps, cover glass."""
from math import cos, pi, radians, sin

import numpy as np
from mathutils import Matrix

from cabin.dimensions import CLUSTER_CENTRE, CLUSTER_TILT, DIAL_DX, DIAL_R, DIAL_SWEEP
from craft import prints, scene
from craft.geometry import circle, frame, rounded, super_power
from craft.part import Part, bezel

F = frame(CLUSTER_CENTRE, CLUSTER_TILT)


def shifted(x, y, z):
    return F @ Matrix.Translation((x, y, z))


def build():
    build_hood()
    scene.empty("Cluster", F, "Dashboard")
    build_face()
    for name, side in (("Tach", -1), ("Speed", 1)):
        build_dial(name, side)
    build_gear_display()
    for lamp in LAMPS:
        build_lamp(*lamp)
    build_cover()


def arch(y, half_w, top, foot, n=30, e=3.2):
    angles = [pi - pi * i / n for i in range(n + 1)]
    return [(half_w * super_power(cos(a), e), y, foot + (top - foot) * super_power(max(0, sin(a)), e)) for a in angles]


def build_hood():
    """Hood: arches from the inner back over the lip to the outer back."""
    sections = (
        (0.715, 0.158, 0.436, 0.300),
        (0.66, 0.163, 0.446, 0.297),
        (0.612, 0.169, 0.452, 0.293),
        (0.602, 0.172, 0.455, 0.291),
        (0.598, 0.176, 0.459, 0.289),
        (0.602, 0.180, 0.463, 0.288),
        (0.615, 0.184, 0.466, 0.287),
        (0.67, 0.189, 0.468, 0.288),
        (0.74, 0.193, 0.463, 0.30),
        (0.82, 0.198, 0.450, 0.34),
        (0.90, 0.195, 0.425, 0.36),
    )
    part = Part("ClusterHood", parent="Dashboard", smooth=50)
    part.loft([arch(*s) for s in sections], "PlasticSoft", closed=False)
    part.build()


def build_face():
    part = Part("ClusterFace", F, "Cluster")
    part.panel(F, rounded(0.335, 0.150, 0.03), -0.02, 0, "PlasticGloss", bevel=0.001, seg=1)
    ring = [(0.0065, 0), (0.006, 0.008), (0.004, 0.0105), (0.0015, 0.009), (0, 0.002)]
    for side in (-1, 1):
        part.lathe(shifted(side * DIAL_DX, 0, 0), [(DIAL_R + r, d) for r, d in ring], "MetalSatin", n=48)
    ledge = [(-0.165, -0.080), (0.165, -0.080), (0.165, -0.056), (-0.165, -0.056)]
    part.panel(F, ledge, 0, 0.022, "PlasticHard", bevel=0.003)
    part.build()


def build_dial(name, side):
    D = shifted(side * DIAL_DX, -0.0015, 0)
    scene.empty(name + "Dial", D, "Cluster")
    face = Part(name + "Face", D, name + "Dial")
    size = 2 * DIAL_R * 256 / 250  # the printed dial face covers 250 of the picture's 256 px
    face.flat(D, circle(DIAL_R + 0.0008, 48), 0, "Prints", (prints.rect(name.lower()), D, size, size))
    face.build()
    needle = Part(name + "Needle", D, name + "Dial")
    blade = [(-0.0017, -0.005), (0.0017, -0.005), (0.0007, DIAL_R * 0.89), (-0.0007, DIAL_R * 0.89)]
    needle.panel(D, blade, 0.0045, 0.0056, "Needle", bevel=0.0003, seg=1)
    cap = [(0.0085, 0.001), (0.0085, 0.0065), (0.0075, 0.008), (0.0002, 0.0083)]
    needle.lathe(D, cap, "PlasticGloss", n=18)
    needle.build()
    # At rest the needle points to zero. It turns about Blender's -Y axis, which is +Z in glTF.
    scene.rest_rotation(name + "Needle", Matrix.Rotation(radians(-DIAL_SWEEP / 2), 4, "Y"))


def build_gear_display():
    G = shifted(0, -0.0012, 0.020)
    panel = Part("GearPanel", G, "Cluster")
    panel.flat(G, rounded(0.038, 0.038, 0.005), 0, "Prints", (prints.rect("gear"), G, 0.038, 0.038))
    panel.build()
    rim = Part("GearPanelFrame", G, "Cluster")
    bezel(rim, G, rounded(0.043, 0.043, 0.007), rounded(0.038, 0.038, 0.005), 0, 0.0022, 0, "PlasticHard")
    rim.build()


def ring_of_quads(r, w, n=16):
    quads = []
    for i in range(n):
        a, b = 2 * pi * i / n, 2 * pi * (i + 1) / n
        quads.append([(q * cos(t), q * sin(t)) for q, t in ((r, a), (r, b), (r - w, b), (r - w, a))])
    return quads


def bar(x, z, w, h):
    return [(x - w / 2, z - h / 2), (x + w / 2, z - h / 2), (x + w / 2, z + h / 2), (x - w / 2, z + h / 2)]


def mirrored(outline):
    return [(-x, z) for x, z in outline]


ARROW = [(-5, 0), (0, 4.2), (0, 1.7), (4.5, 1.7), (4.5, -1.7), (0, -1.7), (0, -4.2)]
OIL_CAN = [(-4, -2.2), (2.5, -2.2), (6, 1.6), (5.2, 2.0), (2.5, 0.2), (2, 1.5), (-1, 1.5), (-1, 2.6), (-2, 2.6)]
OIL_CAN += [(-2, 1.5), (-4, 1.5), (-5.5, 0.6), (-5, -0.2), (-4, 0.3)]
DROP = [(6.2, -0.2), (6.8, -1.3), (6.2, -1.9), (5.6, -1.3)]
BATTERY = [bar(0, -2.9, 9, 0.9), bar(0, 2.1, 9, 0.9), bar(-4.1, -0.4, 0.9, 4.3), bar(4.1, -0.4, 0.9, 4.3)]
BATTERY += [bar(-2.6, 3, 1.8, 1), bar(2.6, 3, 1.8, 1), bar(-2, -0.4, 2.2, 0.7), bar(2, -0.4, 2.2, 0.7)]
BATTERY += [bar(2, -0.4, 0.7, 2.2)]
BRACKET = [(4.2, 2.6), (5.2, 0), (4.2, -2.6), (4.9, -2.9), (6.1, 0), (4.9, 2.9)]
BRAKE = ring_of_quads(3.3, 0.8) + [bar(0, 0.6, 0.9, 2.6), bar(0, -1.6, 0.9, 0.9), BRACKET, mirrored(BRACKET)]
ENGINE = [(-4, -2.6), (2, -2.6), (3.2, -1.4), (4.4, -1.4), (4.4, 1.2), (3.2, 1.2), (2, 2.2), (-3, 2.2), (-4, 1.0)]
ENGINE += [(-5.6, 1.0), (-5.6, -1.4), (-4, -1.4)]
TRIANGLE_LEG = [(0, 3.4), (-4, -2.8), (-2.9, -2.8), (0, 1.7)]
STALL = [TRIANGLE_LEG, mirrored(TRIANGLE_LEG), bar(0, -2.5, 6.4, 0.7), bar(0, -0.3, 0.8, 1.8), bar(0, -1.6, 0.8, 0.6)]
LAMPS = (  # node, colour field in the print atlas, x and z in the cluster [mm], outlines [mm]
    ("LampTurnLeft", "green", -26, 45, [ARROW]),
    ("LampTurnRight", "green", 26, 45, [mirrored(ARROW)]),
    ("LampOil", "red", -13, -21, [OIL_CAN, DROP]),
    ("LampBattery", "red", 0, -11, BATTERY),
    ("LampHandbrake", "red", 13, -21, BRAKE),
    ("LampEngine", "amber", -8, -32, [ENGINE, bar(-0.5, 3, 4, 0.8)]),
    ("LampStall", "amber", 8, -32, STALL),
)


def counter_clockwise(outline):
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(outline, outline[1:] + outline[:1]))
    return outline if area > 0 else outline[::-1]


def build_lamp(name, colour, x, z, outlines):
    """One node, lit separately by its emission; all lamps share a material whose picture gives the colour."""
    L = shifted(x / 1e3, -0.0012, z / 1e3)
    field = (prints.rect(colour), L, 0.03, 0.03)
    part = Part(name, L, "Cluster")
    for outline in outlines:
        part.flat(L, [(a / 1e3, b / 1e3) for a, b in counter_clockwise(outline)], 0, "Lamp", field)
    part.build()


def build_cover():
    """Clear cover in front of the dials, leaning towards the driver at its top."""
    part = Part("ClusterGlass", F, "Cluster")
    rows = [
        [(x, 0.632 - 0.012 * cos(x / 0.16 * pi / 2), 0.449), (x, 0.662, 0.305)] for x in np.linspace(-0.162, 0.162, 9)
    ]
    part.sheet(rows, "Glass", thick=0)
    part.build()
