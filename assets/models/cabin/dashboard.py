"""Dashboard: soft upper pad, lower part with glovebox, knee panel and trim strips, outer vents."""
import math

from mathutils import Matrix

from cabin.dimensions import CENTRE_X, DASH_NOSE_Y, DASH_TOP_Z, HALF_BELT, SCREEN_BASE
from craft.geometry import circle, frame, rounded, smooth_path
from craft.part import Part

RECESS_HALF_W = 0.180  # half width of the recess behind the cluster hood


def columns():
    """The sections' x: dense where the recess begins and ends."""
    left, right = CENTRE_X - HALF_BELT - 0.01, CENTRE_X + HALF_BELT + 0.01
    edges = {left, left + 0.03, left + 0.10, right - 0.10, right - 0.03, right, CENTRE_X, CENTRE_X + 0.13, 0.6, 0.75}
    for x in (0.08, 0.15, 0.178, 0.196, 0.235):
        edges |= {-x, x}
    return sorted(edges | {0})


def rounding(x):
    """How far the ends of the dashboard have turned towards the doors: 0 in the middle, 1 at the doors."""
    return abs((x - CENTRE_X) / HALF_BELT) ** 3


def pad_section(x):
    c = rounding(x)
    nose = 0.115 if abs(x) < RECESS_HALF_W else 0
    foot = SCREEN_BASE[0] + 0.015 - 0.11 * c
    front = DASH_NOSE_Y + nose
    profile = (
        (foot, 0.392),
        (1.04, 0.428),
        (0.84, DASH_TOP_Z),
        (0.715 + nose * 0.8, DASH_TOP_Z),
        (0.672 + nose, 0.438),
        (front, 0.421),
        (front + 0.004, 0.400),
        (0.70 + nose, 0.388),
        (0.95, 0.36),
        (foot, 0.34),
    )
    return [(x, y + 0.05 * c * (y < 1), z - 0.022 * c) for y, z in profile]


def lower_section(x):
    c = rounding(x)
    top = 0.296 if abs(x) < RECESS_HALF_W else 0.392
    profile = (
        (0.95, 0.392),
        (0.72, 0.392),
        (0.676, 0.388),
        (0.672, 0.372),
        (0.670, 0.335),
        (0.664, 0.325),
        (0.658, 0.316),
        (0.660, 0.25),
        (0.682, 0.17),
        (0.715, 0.10),
        (0.76, 0.075),
        (0.83, 0.07),
        (0.95, 0.10),
    )
    return [(x, y + 0.05 * c, min(z, top) - 0.0132 * c) for y, z in profile]


def build():
    pad = Part("DashTopPad", parent="Dashboard")
    pad.loft([pad_section(x) for x in columns()], "PlasticSoft", sub=1)
    edge = [(x, 0.673 + 0.05 * rounding(x), 0.4415 - 0.022 * rounding(x)) for x in (0.235, 0.40, 0.60, 0.80, 0.95)]
    pad.seam(smooth_path(edge, 4), width=0.0036, normal=(0, -0.4, 1))
    pad.build()
    lower = Part("DashLower", parent="Dashboard", smooth=45)
    lower.loft([lower_section(x) for x in columns()], "PlasticHard", sub=1)
    add_trim(lower)
    add_glovebox(lower)
    add_knee_panel(lower)
    lower.build()
    build_outer_vents()


def add_trim(part):
    """Satin strip on a black ground in front of the passenger."""
    F = frame((0.70, 0.668, 0.352), 4)
    part.panel(F, rounded(0.415, 0.038, 0.008, cx=-0.0175), -0.01, 0.005, "PlasticGloss", bevel=0.002)
    part.panel(F, rounded(0.407, 0.026, 0.005, cx=-0.0175), -0.01, 0.0075, "MetalSatin", bevel=0.002)


def add_glovebox(part):
    F = frame((0.72, 0.676, 0.205), -13)
    part.panel(F, rounded(0.40, 0.155, 0.02), -0.02, 0.012, "PlasticHard", bevel=0.006, seg=3)
    part.panel(F, rounded(0.095, 0.020, 0.008, cy=0.052), 0, 0.0145, "PlasticGloss", bevel=0.002)


def add_knee_panel(part):
    """Knee panel below the column, with the light switch on its left."""
    part.panel(
        frame((0, 0.682, 0.205), -13), rounded(0.44, 0.15, 0.03), -0.03, 0.010, "PlasticSoft", bevel=0.008, seg=3
    )
    part.panel(frame((-0.272, 0.664, 0.285)), rounded(0.10, 0.062, 0.012), -0.01, 0.008, "PlasticGloss", bevel=0.002)
    switch = [(0.021, 0), (0.021, 0.008), (0.018, 0.012), (0.0165, 0.012), (0.015, 0.017), (0.001, 0.0175)]
    part.lathe(frame((-0.272, 0.656, 0.285)), switch, "PlasticHard", n=28)


def add_slats(part, F, w, h, n, is_round=False):
    """Slats and a thumb vane inside a vent opening."""
    for i in range(n):
        z = -h / 2 + h * (i + 0.5) / n
        width = 2 * math.sqrt(max(0.0001, (w / 2) ** 2 - z * z)) - 0.004 if is_round else w
        tilt = Matrix.Rotation(math.radians(-18), 4, "X")
        part.box((0, 0.006, z), (width, 0.016, 0.0022), "PlasticHard", F, bevel=0.0008, seg=1, rot=tilt)
    part.box((0, -0.003, 0), (0.010, 0.008, 0.014), "PlasticGloss", F, bevel=0.0015)


def build_outer_vents():
    part = Part("VentsOuter", parent="Dashboard")
    ring = [(0.041, -0.01), (0.041, 0.012), (0.039, 0.016), (0.036, 0.017), (0.0335, 0.014), (0.033, -0.012)]
    for x in (-0.272, CENTRE_X * 2 + 0.272):
        F = frame((x, 0.684, 0.352), 6, yaw=-6 if x < 0 else 6)
        part.lathe(F, ring + [(0.0005, -0.014)], "MetalSatin", n=36)
        part.panel(F, circle(0.0325, 28), -0.0135, -0.0105, "PlasticGloss", bevel=0)
        add_slats(part, F, 0.062, 0.056, 6, True)
    part.build()
