"""Parts of the cut-away gearbox in their neutral positions."""
from math import cos, pi, radians, sin

from mathutils import Matrix, Vector

from craft import scene
from craft.geometry import frame, lerp
from craft.materials import material
from craft.part import Part
from gearbox import dimensions as d
from gearbox.shapes import helical_gear, spline_teeth, turned


def build():
    material("Steel", (0.56, 0.57, 0.58), 0.28, metal=1.0, occlusion=False)
    material("GearSteel", (0.36, 0.37, 0.39), 0.38, metal=1.0, occlusion=False)
    material("Brass", (0.80, 0.58, 0.24), 0.30, metal=1.0, occlusion=False)
    material("CastAluminium", (0.50, 0.51, 0.52), 0.62, metal=0.9, two_sided=True, occlusion=False)
    material("CutFace", (0.42, 0.025, 0.015), 0.55, occlusion=False)
    material("PaintedFork", (0.05, 0.10, 0.20), 0.45, metal=0.3, occlusion=False)
    scene.empty("Gearbox", Matrix(), None)
    build_shaft()
    build_hub()
    build_sleeve()
    for name, way in (("Forward", 1), ("Back", -1)):
        build_ring(name, way)
        build_gear(name, way)
    build_rail()
    build_fork()
    build_finger()
    build_detent()
    build_housing()


def along(way, profile):
    """Profile [(radius, distance from the middle)] for the gear in front (+1) or behind (-1)."""
    return [(r, way * y) for r, y in profile]


def build_shaft():
    part = Part("Shaft", parent="Gearbox", smooth=40)
    r, end = d.SHAFT_R, d.SHAFT_HALF
    profile = [
        (0.0002, -end),
        (r - 0.0015, -end),
        (r, -end + 0.0015),
        (r, end - 0.0015),
        (r - 0.0015, end),
        (0.0002, end),
    ]
    turned(part, profile, "Steel", n=32)
    part.build()


def build_hub():
    """Hub, splined to the shaft; carries the sleeve; three keys press the rings."""
    part = Part("Hub", parent="Gearbox", smooth=35)
    h = d.HUB_HALF
    bore, web, rim = d.SHAFT_R + 0.0005, d.SHAFT_R + 0.005, d.SPLINE_R - 0.0055
    base = d.SPLINE_R - d.SPLINE_DEPTH * 1.4
    half = [(bore, h), (web, h), (web + 0.001, h - 0.005), (rim, h - 0.005), (rim + 0.001, h), (base, h)]
    turned(part, half + [(r, -y) for r, y in half[::-1]], "GearSteel", n=28)
    spline_teeth(part, -h, h, "GearSteel", pointed=(False, False))
    for k in range(3):
        turn = Matrix.Rotation(radians(60 + 120 * k), 4, "Y")
        size = (0.0075, 2 * h + 0.005, 0.0058)
        part.box((0, 0, d.SPLINE_R - 0.0018), size, "Steel", turn, bevel=0.0012)
    part.build()


def build_sleeve():
    """Sleeve with internal teeth and a groove for the fork; a sector is cut out and its faces painted."""
    part = Part("Sleeve", parent="Gearbox", smooth=35)
    h, g, c = d.SLEEVE_HALF, d.GROOVE_HALF, 0.0012
    base = d.SPLINE_R + d.SPLINE_DEPTH * 1.4
    profile = [(base, -h), (d.SLEEVE_R - c, -h), (d.SLEEVE_R, -h + c), (d.SLEEVE_R, -g), (d.GROOVE_R, -g)]
    profile += [(r, -y) for r, y in profile[::-1]]
    turned(part, profile, "Steel", n=48, a0=d.CUT[1], a1=d.CUT[0] + 360, caps="CutFace")
    spline_teeth(part, -d.SLEEVE_TOOTH_HALF, d.SLEEVE_TOOTH_HALF, "Steel", inward=True, sector=d.CUT)
    part.build()


def build_ring(name, way):
    """Brass ring: cone inside, blocking teeth outside."""
    middle = way * (d.RING_NEAR + d.RING_FAR) / 2
    part = Part("Ring" + name, (0, middle, 0), "Gearbox", smooth=35)
    base = d.SPLINE_R - d.SPLINE_DEPTH * 1.4
    profile = [(0.0262, 0.0112), (0.0290, 0.0112), (0.0290, d.RING_NEAR), (base, d.RING_NEAR), (base, d.RING_FAR)]
    turned(part, along(way, profile + [(0.0250, d.RING_FAR)]), "Brass", n=28)
    ends = sorted((way * d.RING_NEAR, way * d.RING_FAR))
    spline_teeth(part, *ends, "Brass", pointed=(way > 0, way < 0), tip=0.0012)
    part.build()


def build_gear(name, way):
    """Loose gear: dog teeth and cone towards the hub, helical teeth outside."""
    middle = way * (d.GEAR_NEAR + d.GEAR_FAR) / 2
    part = Part("Gear" + name, (0, middle, 0), "Gearbox", smooth=32)
    dog_base, root = d.SPLINE_R - d.SPLINE_DEPTH * 1.4, d.GEAR_ROOT_R - 0.0035
    near, far, web = d.GEAR_NEAR, d.GEAR_FAR, 0.004
    bore = d.SHAFT_R + 0.0004
    profile = [(bore, 0.0118), (0.0252, 0.0118), (0.0240, d.DOG_NEAR), (dog_base, d.DOG_NEAR), (dog_base, near)]
    profile += [(0.0335, near + web), (root - 0.003, near + web), (root - 0.002, near), (root, near)]
    profile += [
        (root, far),
        (root - 0.002, far),
        (root - 0.003, far - web),
        (0.024, far - web),
        (0.023, far),
        (bore, far),
    ]
    turned(part, along(way, profile), "GearSteel", n=28)
    ends = sorted((way * d.DOG_NEAR, way * d.DOG_FAR))
    spline_teeth(part, *ends, "Steel", pointed=(way > 0, way < 0))
    y0, y1 = sorted((way * near, way * far))
    helical_gear(part, y0, y1, d.GEAR_TEETH, d.GEAR_TIP_R, d.GEAR_ROOT_R, way * d.GEAR_HELIX, "GearSteel")
    part.build()


def rail_frame(y=0.0):
    """Frame that faces along the shaft: x right, z up, depth backwards."""
    return frame((d.RAIL[0], y, d.RAIL[1]))


def build_rail():
    """Rod with three detent notches; two lugs on top take the selector finger."""
    part = Part("Rail", (d.RAIL[0], 0, d.RAIL[1]), "Gearbox", smooth=40)
    profile = [(0.0002, -d.RAIL_HALF), (d.RAIL_R - 0.001, -d.RAIL_HALF), (d.RAIL_R, -d.RAIL_HALF + 0.001)]
    for k in (-1, 0, 1):
        y = d.DETENT_Y + k * d.TRAVEL
        profile += [(d.RAIL_R, y - 0.0026), (d.RAIL_R - 0.0022, y), (d.RAIL_R, y + 0.0026)]
    profile += [(d.RAIL_R, d.RAIL_HALF - 0.001), (d.RAIL_R - 0.001, d.RAIL_HALF), (0.0002, d.RAIL_HALF)]
    part.lathe(rail_frame(), [(r, -y) for r, y in profile], "Steel", n=24)
    for way in (-1, 1):
        lug = (d.RAIL[0], way * 0.0088, d.RAIL[1] + 0.0105)
        part.box(lug, (0.012, 0.006, 0.015), "PaintedFork", bevel=0.0012)
    part.box((d.RAIL[0], 0, d.RAIL[1] + 0.002), (0.015, 0.030, 0.012), "PaintedFork", bevel=0.002)
    part.build()


def build_fork():
    """Horseshoe in the sleeve's groove, centred on the direction of the rail."""
    part = Part("Fork", (d.RAIL[0], 0, d.RAIL[1]), "Gearbox", smooth=40)
    inner, outer, thick = d.GROOVE_R + 0.0006, d.GROOVE_R + 0.0105, d.GROOVE_HALF - 0.0007
    reach, n = 78.0, 20
    angles = [radians(d.RAIL_ANGLE - reach + 2 * reach * i / n) for i in range(n + 1)]
    width = []
    for i in range(n + 1):
        t = abs(2 * i / n - 1)
        width.append(lerp(0.0065, 0.0, t) + 0.012 * max(0.0, 1 - (t / 0.22) ** 2))  # wider in the middle, near the rail
    outline = [(inner * cos(a), inner * sin(a)) for a in angles[::-1]]
    outline += [((outer + w) * cos(a), (outer + w) * sin(a)) for a, w in zip(angles, width)]
    part.panel(frame((0, 0, 0)), outline, -thick, thick, "PaintedFork", bevel=0.0007, seg=1)
    boss = [(d.RAIL_R + 0.0003, -0.012), (0.0115, -0.012), (0.0125, -0.011), (0.0125, 0.011), (0.0115, 0.012)]
    part.lathe(rail_frame(), boss + [(d.RAIL_R + 0.0003, 0.012)], "PaintedFork", n=24)
    for a in (angles[0], angles[-1]):  # brass pads, on which the fork slides
        turn = Matrix.Rotation(-a, 4, "Y")
        part.box((inner + 0.003, 0, 0), (0.006, 2 * thick + 0.0008, 0.010), "Brass", turn, bevel=0.0006, seg=1)
    part.build()


def build_finger():
    """Selector finger: turns about x above the rails; its tip is between the lugs of the selected rail."""
    axis = Vector((d.RAIL[0], 0, d.RAIL[1] + d.FINGER_AXIS))
    part = Part("Finger", axis, "Gearbox", smooth=40)
    F = frame(axis, yaw=90)  # the frame's -y axis points along +x
    part.lathe(
        F,
        [(0.0063, -0.008), (0.0105, -0.008), (0.0110, -0.007), (0.0110, 0.007), (0.0105, 0.008), (0.0063, 0.008)],
        "Steel",
        n=24,
    )
    reach = d.FINGER_REACH
    outline = [(-0.0075, -0.006), (-0.0048, -reach + 0.006), (-0.0052, -reach - 0.001), (-0.003, -reach - 0.0045)]
    outline += [(0.003, -reach - 0.0045), (0.0052, -reach - 0.001), (0.0048, -reach + 0.006), (0.0075, -0.006)]
    part.panel(F, outline, -0.0042, 0.0042, "Steel", bevel=0.0008, seg=1)
    part.build()
    rod = Part("SelectorShaft", axis, "Gearbox", smooth=40)
    ends = [(0.0002, -0.055), (0.0052, -0.055), (0.0060, -0.054), (0.0060, 0.054), (0.0052, 0.055), (0.0002, 0.055)]
    rod.lathe(F, ends, "GearSteel", n=20)
    rod.build()


def build_detent():
    """Ball in the middle notch, its spring and plug; fixed to the housing."""
    ball_r = 0.0042
    ball = Vector((d.RAIL[0], d.DETENT_Y, d.RAIL[1] + d.RAIL_R + ball_r - 0.0022))
    part = Part("Detent", ball, "Gearbox", smooth=60)
    up = frame(ball, 90)
    sphere = [(max(0.0002, ball_r * cos(t)), ball_r * sin(t)) for t in [pi * (i / 10 - 0.5) for i in range(11)]]
    part.lathe(up, sphere, "Steel", n=18)
    coil = []
    for i in range(6 * 8 + 1):
        a = 2 * pi * i / 8
        coil.append(tuple(ball + Vector((0.0030 * cos(a), 0.0030 * sin(a), ball_r - 0.0006 + 0.011 * i / 48))))
    part.tube(coil, 0.0005, "Steel", n=4)
    plug = ball_r + 0.011
    part.lathe(
        up,
        [(0.0002, plug), (0.0050, plug), (0.0055, plug + 0.0005), (0.0055, plug + 0.005), (0.0002, plug + 0.005)],
        "Brass",
        n=12,
    )
    part.build()


def build_housing():
    """Lower half of the casing with bearing walls; the cut faces are painted."""
    part = Part("Housing", parent="Gearbox", smooth=35)
    inner, wall, half = 0.0535, 0.0045, 0.060
    a0, a1 = 196.0, 344.0
    shell = [(inner, -half), (inner + wall, -half), (inner + wall, half), (inner, half)]
    turned(part, shell, "CastAluminium", n=48, a0=a0, a1=a1, caps="CutFace")
    for y in (-half + 0.003, half - 0.003):  # bearing walls
        bearing = [
            (d.SHAFT_R + 0.006, y - 0.003),
            (inner + 0.001, y - 0.003),
            (inner + 0.001, y + 0.003),
            (d.SHAFT_R + 0.006, y + 0.003),
        ]
        turned(part, bearing, "CastAluminium", n=48, a0=a0, a1=a1, caps="CutFace")
        race = [
            (d.SHAFT_R + 0.0002, y - 0.0045),
            (d.SHAFT_R + 0.0062, y - 0.0045),
            (d.SHAFT_R + 0.0062, y + 0.0045),
            (d.SHAFT_R + 0.0002, y + 0.0045),
        ]
        turned(part, race, "Steel", n=32)
    for y in (-0.036, -0.012, 0.012, 0.036):  # ribs
        rib = [
            (inner + wall - 0.0005, y - 0.0018),
            (inner + wall + 0.004, y - 0.0012),
            (inner + wall + 0.004, y + 0.0012),
            (inner + wall - 0.0005, y + 0.0018),
        ]
        turned(part, rib, "CastAluminium", n=36, a0=a0 + 6, a1=a1 - 6)
    part.build()


CAMERAS = {
    "gearbox": (Vector((-0.20, -0.17, 0.16)), Vector((0.0, 0.0, 0.022)), 42),
    "gearbox_side": (Vector((-0.27, 0.0, 0.05)), Vector((0.0, 0.0, 0.025)), 42),
}
