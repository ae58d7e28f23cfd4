"""Views of the cabin: viewpoints that decide which faces are hidden, texel density, preview cameras."""
from mathutils import Vector

from cabin.dimensions import CENTRE_X, CLUSTER_CENTRE, EYE, KNOB_CENTRE

VIEWPOINTS = [
    (0.0, -0.05, 0.635),
    (-0.15, 0.05, 0.60),
    (0.15, 0.05, 0.70),
    (0.0, 0.20, 0.45),
    (-0.25, 0.25, 0.15),
    (0.33, 0.10, 0.50),
    (0.20, 0.15, 0.30),
    (0.33, 0.45, 0.60),
    (0.67, -0.05, 0.60),
    (0.93, -0.30, 0.80),
    (0.90, 0.25, 0.15),
    (0.67, 0.45, 0.10),
    (0.0, 0.60, -0.05),
    (0.33, -0.60, 0.70),
    (0.33, 0.75, 0.75),
    (0.07, 0.20, 0.36),  # this and the next three are cameras of app/cabin/stage: lever, gate, cluster, gearbox
    (0.235, 0.175, 0.275),
    (0.0, 0.475, 0.455),
    (0.56, 0.12, 0.45),
    (-0.10, -0.12, 0.58),  # this and the next two are other head positions of the driver
    (0.12, 0.10, 0.62),
    (0.0, 0.05, 0.72),
    (0.33, 0.47, 0.79),  # the interior mirror
]
# Moving parts: they hide no other faces and keep all their own, because a different pose may reveal any of these.
MOVING = ("SteeringWheel", "Pedal", "Handbrake", "Lever", "Knob", "Boot", "TachNeedle", "SpeedNeedle", "SunVisor")
NEAR = ("Knob", "Boot", "GatePlate", "Lever", "Cluster", "Tach", "Speed", "Gear", "SteeringWheel")
CLOSE = (
    "Console",
    "CentreStack",
    "Climate",
    "Radio",
    "Hazard",
    "Handbrake",
    "Stalk",
    "Column",
    "Vents",
    "Dash",
    "Pedal",
)
FAR = ("Roof", "Pillars", "Rear", "Floor", "Tunnel", "SunVisor", "Wipers", "Belt")


def density(name):
    """Texels along an edge, relative to an ordinary part."""
    for k, names in ((2.2, NEAR), (1.5, CLOSE), (0.5, FAR)):
        if name.startswith(names):
            return k
    return 0.9


CAMERAS = {  # position, target, horizontal field of view [deg]
    "driver": (EYE, Vector((0.10, 0.70, 0.42)), 82),
    "lever": (EYE + Vector((0.03, 0.06, 0.0)), Vector((0.29, 0.33, 0.07)), 50),
    "quarter": (Vector((0.93, -0.30, 0.80)), Vector((0.06, 0.46, 0.20)), 88),
    "ahead": (EYE, EYE + Vector((0, 1, -0.08)), 95),
    "gate": (KNOB_CENTRE + Vector((-0.09, -0.19, 0.20)), KNOB_CENTRE + Vector((0, 0, -0.04)), 50),
    "cluster": (EYE, CLUSTER_CENTRE, 28),
    "down": (EYE, Vector((0, 0.75, -0.1)), 75),
    "left": (EYE, Vector((-0.5, 0.5, 0.35)), 85),
    "outside": (Vector((-1.6, 2.6, 1.2)), Vector((0.33, 0.2, 0.3)), 45),
    "seats": (Vector((0.33, 0.75, 0.75)), Vector((0.33, -0.4, 0.15)), 90),
    "top": (Vector((CENTRE_X, -0.2, 3.2)), Vector((CENTRE_X, 0.25, 0)), 45),
}

HIDDEN = {"top": ("RoofLining", "SunVisor"), "gate": ("Boot",)}  # parts left out, by preview camera
