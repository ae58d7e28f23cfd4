"""Front doors: panel with armrest, pull, pocket and speaker, window frame, glass."""
from mathutils import Vector

from cabin.dimensions import BELT_Z, CENTRE_X, HALF_BELT, PILLAR_FOOT, RAIL_Z, ROOF_RAIL, side_x
from cabin.mirrors import build_door_mirror
from craft import scene
from craft.geometry import interpolate, lerp, rounded, side_frame, smooth_path
from craft.part import Part, bezel

STATIONS = (-0.46, -0.44, -0.34, -0.12, 0.0, 0.12, 0.24, 0.34, 0.44, 0.60, 0.78, 0.93, 0.95)
ARMREST = [(-0.46, 0.25), (-0.34, 0.8), (-0.1, 1), (0.25, 1), (0.45, 0.55), (0.62, 0.1), (0.95, 0)]
POCKET = [(-0.42, 0.3), (-0.3, 1), (0.55, 1), (0.8, 0.4)]
SHOULDER = [(-0.5, 0.03), (0.4, 0.012), (0.95, -0.002)]
STRIPS = ["PlasticHard"] * 9 + ["Leather"] * 4 + ["Fabric"] * 2 + ["PlasticHard"] + ["PlasticSoft"] * 4
STRIPS += ["PlasticHard"] * 3


def build():
    for name, side in (("Left", -1), ("Right", 1)):
        hinge = Vector((CENTRE_X + side * (HALF_BELT + 0.04), 0.92, 0.1))
        scene.empty("Door" + name, hinge, "Cabin")
        build_panel(name, side, hinge)
        build_frame(name, side, hinge)
        build_glass(name, side, hinge)
        build_door_mirror(name, side)


def on_wall(side, y, z, depth):
    """Frame on the door at a depth from the wall into the cabin."""
    return side_frame((CENTRE_X + side * (HALF_BELT - depth), y, z), side)


def section(side, y):
    arm, pocket, shoulder = interpolate(ARMREST, y), interpolate(POCKET, y), interpolate(SHOULDER, y)
    profile = (  # depth from the wall into the cabin, z
        (-0.05, -0.25),
        (0.010, -0.25),
        (0.045 * pocket + 0.012, -0.245),
        (0.062 * pocket + 0.012, -0.20),
        (0.060 * pocket + 0.012, -0.105),
        (0.045 * pocket + 0.010, -0.092),
        (0.018, -0.085),
        (0.014, 0.0),
        (0.016, 0.10),
        (0.014 + 0.055 * arm, 0.118),
        (0.018 + 0.066 * arm, 0.140),
        (0.018 + 0.064 * arm, 0.160),
        (0.018 + 0.05 * arm, 0.170),
        (0.016 + 0.004 * arm, 0.176),
        (0.012, 0.20),
        (0.012, 0.285),
        (0.018, 0.300),
        (0.026, 0.330),
        (0.034, 0.385),
        (0.028, BELT_Z - 0.005 + shoulder),
        (0.008, BELT_Z + 0.008 + shoulder),
        (-0.02, BELT_Z + 0.004 + shoulder),
        (-0.05, BELT_Z - 0.01 + shoulder),
    )
    return [(CENTRE_X + side * (HALF_BELT - d), y, z) for d, z in profile]


def build_panel(name, side, hinge):
    part = Part("Door%sPanel" % name, hinge, "Door" + name, smooth=50)
    part.loft([section(side, y) for y in STATIONS], "PlasticHard", strip_mats=STRIPS, sub=1)
    add_handle(part, side)
    add_speaker(part, side)
    add_pull(part, side)
    add_trim(part, side)
    for y in (0.17, 0.23) if side < 0 else (0.20,):
        switch = (CENTRE_X + side * (HALF_BELT - 0.052), y, 0.166)
        part.box(switch, (0.026, 0.038, 0.014), "PlasticGloss", bevel=0.004)
    part.build()


def add_handle(part, side):
    """Door opener in its bowl."""
    F = on_wall(side, 0.44, 0.243, 0.013)
    bezel(part, F, rounded(0.135, 0.062, 0.02), rounded(0.118, 0.046, 0.014), -0.004, 0.009, 0.0, "MetalSatin")
    part.panel(F, rounded(0.119, 0.047, 0.014), -0.003, 0.001, "PlasticGloss", bevel=0)
    part.panel(F, rounded(0.085, 0.022, 0.008, cx=0.008 * side), 0.0, 0.013, "MetalSatin", bevel=0.004)


def add_speaker(part, side):
    """Grille with concentric ribs."""
    F = on_wall(side, 0.66, -0.01, 0.026)
    ribs = []
    for i in range(5):
        r, h = 0.079 - 0.0145 * i, 0.004 + 0.0012 * i
        ribs += [(r, h), (r - 0.0045, h + 0.0032), (r - 0.0095, h)]
    part.lathe(F, [(0.088, 0.004), (0.084, 0.010)] + ribs + [(0.0005, 0.010)], "PlasticHard", n=20)
    part.lathe(F, [(0.089, 0.002), (0.0905, 0.006), (0.0875, 0.0105), (0.0855, 0.0098)], "MetalSatin", n=28)


def add_pull(part, side):
    """Grab handle rising from the armrest."""
    bends = (
        (0.060, 0.24, 0.168),
        (0.078, 0.30, 0.185),
        (0.080, 0.36, 0.215),
        (0.066, 0.41, 0.250),
        (0.030, 0.445, 0.290),
    )
    path = [(CENTRE_X + side * (HALF_BELT - d), y, z) for d, y, z in bends]
    part.tube(smooth_path(path, 4), 0.0125, "PlasticSoft", n=10, flat=1.3)


def add_trim(part, side):
    """Satin line under the shoulder, red seam along the armrest."""
    line = [(CENTRE_X + side * (HALF_BELT - 0.0165), y, 0.292) for y in (-0.40, -0.1, 0.2, 0.5, 0.80)]
    part.tube(smooth_path(line, 3), 0.0032, "MetalSatin", n=6)
    seam = [
        (CENTRE_X + side * (HALF_BELT - 0.016 - 0.061 * interpolate(ARMREST, y)), y, 0.1655)
        for y in (-0.34, -0.25, -0.12, 0.0, 0.12, 0.24, 0.34, 0.42)
    ]
    part.seam(smooth_path(seam, 3), width=0.004, normal=(-side * 0.6, 0, 1))


def build_frame(name, side, hinge):
    part = Part("Door%sFrame" % name, hinge, "Door" + name, smooth=50)
    foot, head = (PILLAR_FOOT[0] - 0.06, BELT_Z + 0.005), ROOF_RAIL[0]
    along = [tuple(lerp(a, b, t) for a, b in zip(foot, head)) for t in (0, 0.33, 0.66)]
    along += [(0.36, 0.856)] + [(y, z - 0.016) for y, z in ROOF_RAIL[1:4] if y > -0.3] + [(-0.315, RAIL_Z - 0.014)]
    part.tube(smooth_path([(side_x(side, z) + side * 0.012, y, z) for y, z in along], 4), 0.017, "PlasticSoft", n=10)
    rear = ((-0.315, RAIL_Z - 0.014), (-0.36, 0.65), (-0.395, BELT_Z + 0.01))
    part.tube(smooth_path([(side_x(side, z) + side * 0.012, y, z) for y, z in rear], 5), 0.017, "PlasticSoft", n=10)
    corner = [(1.04, BELT_Z - 0.01), (0.72, BELT_Z), (0.76, 0.612), (0.725, 0.60)]  # mirror triangle
    a, b, c, d = [(side_x(side, z) + side * 0.010, y, z) for y, z in corner]
    part.sheet([[a, b], [c, d]], "PlasticSoft", thick=0.014, bevel=0.004)
    part.build()


def build_glass(name, side, hinge):
    part = Part("Glass" + name, hinge, "Door" + name)
    outline = (1.0, BELT_Z), (0.80, 0.57), (0.60, 0.725), (0.40, 0.85), (0.2, 0.868), (-0.05, 0.873), (-0.31, 0.873)
    outline += (-0.355, 0.65), (-0.39, BELT_Z)
    pane = [(side_x(side, z) + side * 0.014, y, z) for y, z in outline]
    part.piece(pane, [tuple(range(len(pane)))], "Glass")
    part.build()
