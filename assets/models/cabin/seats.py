"""Front seats: cushion, backrest and headrest with bolsters, seams, recliner; seat belts."""
from math import radians

from mathutils import Matrix, Vector

from cabin.dimensions import CENTRE_X, FLOOR_Z, HALF_BELT, SEAT_TILT, SEAT_W, SEAT_X
from craft import scene
from craft.geometry import frame, rounded, smooth_path, superellipse
from craft.part import Part

HALF_W = SEAT_W / 2
STRIPS = ["Fabric"] * 5 + ["Leather"] * 7
STRIPS = STRIPS + STRIPS[::-1]  # cloth in the middle, leather on the bolsters

# Cross sections of the cushion: y, height in the middle, bolster height above the middle, height of the underside,
# width factor, depth of the cross seam.
CUSHION = [
    (-0.20, -0.10, 0.010, -0.17, 0.93, 0),
    (-0.185, -0.075, 0.020, -0.19, 0.97, 0),
    (-0.10, -0.073, 0.035, -0.20, 1, 0),
    (0.006, -0.068, 0.044, -0.20, 1, 0),
    (0.018, -0.068, 0.045, -0.20, 1, 0.009),
    (0.030, -0.067, 0.045, -0.20, 1, 0),
    (0.128, -0.053, 0.045, -0.20, 1, 0),
    (0.140, -0.052, 0.045, -0.20, 1, 0.009),
    (0.152, -0.050, 0.045, -0.20, 1, 0),
    (0.238, -0.038, 0.039, -0.19, 1, 0),
    (0.250, -0.036, 0.038, -0.19, 1, 0.009),
    (0.262, -0.035, 0.037, -0.19, 1, 0),
    (0.315, -0.030, 0.028, -0.17, 0.99, 0),
    (0.355, -0.040, 0.016, -0.15, 0.975, 0),
    (0.372, -0.075, 0.0, -0.125, 0.95, 0),
]
# Cross sections of the backrest: height along the back, forward offset, bolster depth, half width, thickness, depth of
# the cross seam.
BACK = [
    (-0.04, -0.02, 0.01, 0.225, 0.09, 0),
    (-0.02, -0.005, 0.03, 0.238, 0.11, 0),
    (0.08, 0.010, 0.052, 0.25, 0.13, 0),
    (0.128, 0.014, 0.055, 0.25, 0.13, 0),
    (0.140, 0.015, 0.056, 0.25, 0.13, 0.009),
    (0.152, 0.016, 0.057, 0.25, 0.13, 0),
    (0.20, 0.018, 0.060, 0.25, 0.13, 0),
    (0.268, 0.014, 0.058, 0.249, 0.125, 0),
    (0.280, 0.013, 0.058, 0.249, 0.125, 0.009),
    (0.292, 0.012, 0.057, 0.249, 0.125, 0),
    (0.32, 0.010, 0.056, 0.248, 0.12, 0),
    (0.403, -0.002, 0.044, 0.242, 0.108, 0),
    (0.415, -0.004, 0.042, 0.241, 0.106, 0.009),
    (0.427, -0.005, 0.041, 0.239, 0.104, 0),
    (0.50, -0.016, 0.026, 0.222, 0.09, 0),
    (0.555, -0.026, 0.014, 0.195, 0.075, 0),
    (0.590, -0.038, 0.004, 0.168, 0.055, 0),
    (0.604, -0.055, 0.0, 0.14, 0.03, 0),
]


def build():
    for name, x in SEAT_X.items():
        scene.empty("Seat" + name, (x, 0, 0), "Cabin")
        build_cushion(name, x)
        B = Matrix.Translation((x, -0.150, -0.075)) @ Matrix.Rotation(radians(SEAT_TILT), 4, "X")
        build_back(name, B)
        build_headrest(name, B)
        build_belt(name, x)


def outboard(x):
    """Direction of the seat's door along x: -1 for the driver's seat, +1 for the passenger's."""
    return -1 if x < CENTRE_X else 1


def whole(half):
    return half + [(-x, z) for x, z in half[-2:0:-1]]


def cushion_ring(xc, y, top, bolster, bottom, k, seam):
    mid = top - seam
    half = [(0.0, mid), (0.055, mid + 0.004), (0.062, mid - 0.003), (0.069, mid + 0.004), (0.150, mid + 0.008)]
    half += [(0.165, top - 0.003), (0.195, top + bolster), (0.232, top + bolster), (HALF_W, top - 0.005)]
    half += [(HALF_W + 0.004, top - 0.06), (HALF_W - 0.02, bottom), (0.10, bottom - 0.005), (0, bottom - 0.005)]
    return [(xc + x * k, y, z) for x, z in whole(half)]


def build_cushion(name, xc):
    part = Part("Seat%sCushion" % name, (xc, 0, 0), "Seat" + name, smooth=70)
    part.loft([cushion_ring(xc, *s) for s in CUSHION], "Leather", strip_mats=STRIPS, sub=1)
    for side in (-1, 1):
        edge = [
            (xc + side * 0.1685 * k, y, top + 0.0015 + 0.125 * bolster) for y, top, bolster, _, k, _ in CUSHION[1:-1]
        ]
        part.seam(smooth_path(edge, 2), width=0.005, normal=(side * -0.5, 0, 1))
    part.box((xc, 0.02, -0.215), (0.40, 0.44, 0.05), "PlasticHard", bevel=0.012)
    for side in (-1, 1):
        part.box((xc + side * 0.19, 0.02, FLOOR_Z + 0.012), (0.045, 0.56, 0.03), "MetalSatin", bevel=0.006)
    add_recliner(part, xc)
    part.build()


def add_recliner(part, xc):
    """Side shield on the door side with the height lever, and the wheel that tilts the back."""
    side = outboard(xc)
    F = frame((xc + side * 0.268, 0.0, -0.14), 0, yaw=90 * side)
    shield = [(-0.20, -0.035), (0.17, -0.035), (0.19, 0.0), (0.16, 0.030), (-0.08, 0.040), (-0.20, 0.062)]
    shield = [(x * side, z) for x, z in shield]
    part.panel(F, shield if side > 0 else shield[::-1], -0.02, 0.004, "PlasticHard", bevel=0.006)
    lever = rounded(0.15, 0.020, 0.008, cx=0.06 * side, cy=0.004)
    part.panel(F, lever, 0.004, 0.016, "PlasticSoft", bevel=0.004)
    hub = frame((xc + side * 0.268, -0.150, -0.105), 0, yaw=90 * side)
    wheel = [(0.036, 0.0), (0.036, 0.018), (0.033, 0.022), (0.020, 0.023), (0.018, 0.020), (0.0005, 0.020)]
    part.lathe(hub, wheel, "PlasticHard", n=24)


def back_ring(B, h, f, bolster, half_w, thick, seam):
    k, mid = half_w / HALF_W, f - seam
    half = [(0.0, mid), (0.055, mid + 0.004), (0.062, mid - 0.003), (0.069, mid + 0.004), (0.145, mid + 0.006)]
    half += [(0.160, f - 0.004), (0.190, f + bolster), (0.228, f + bolster * 0.9), (HALF_W, f - 0.02)]
    half += [(HALF_W, f - 0.07), (HALF_W - 0.035, f - thick), (0.10, f - thick - 0.006), (0, f - thick - 0.006)]
    return [tuple(B @ Vector((x * k, y, h))) for x, y in whole(half)]


def build_back(name, B):
    part = Part("Seat%sBack" % name, B, "Seat" + name, smooth=70)
    part.loft([back_ring(B, *s) for s in BACK], "Leather", strip_mats=STRIPS, sub=1)
    for side in (-1, 1):
        edge = [
            tuple(B @ Vector((side * 0.1637 * half_w / HALF_W, f + 0.0008 + 0.125 * bolster, h)))
            for h, f, bolster, half_w, _, _ in BACK[1:-1]
        ]
        normal = B.to_3x3() @ Vector((-0.5 * side, 1, 0))
        part.seam(smooth_path(edge, 2), width=0.005, normal=tuple(normal))
    part.build()


def build_headrest(name, B):
    part = Part("Seat%sHeadrest" % name, B @ Matrix.Translation((0, 0, 0.62)), "Seat" + name, smooth=70)
    for side in (-1, 1):
        post = [tuple(B @ Vector((side * 0.055, f, h))) for f, h in ((-0.055, 0.56), (-0.05, 0.66))]
        part.tube(post, 0.006, "MetalSatin", n=12)
    sections = (  # height, half width, half depth, forward
        (0.640, 0.085, 0.026, -0.05),
        (0.648, 0.110, 0.040, -0.048),
        (0.69, 0.132, 0.050, -0.036),
        (0.75, 0.135, 0.050, -0.034),
        (0.79, 0.120, 0.042, -0.040),
        (0.803, 0.095, 0.026, -0.046),
    )
    rings = [[tuple(B @ Vector((x, f + y, h))) for x, y in superellipse(a, t, 3, 16)] for h, a, t, f in sections]
    part.loft(rings, "Leather", sub=1)
    part.build()


def build_belt(name, xc):
    """Belt from its ring at the B-pillar to the floor, and the buckle beside the tunnel."""
    s = outboard(xc)
    x = CENTRE_X + s * (HALF_BELT - 0.055)
    part = Part("Belt" + name, (x, -0.33, 0.52), "Cabin")
    run = ((0.028, -0.345, 0.52), (0.005, -0.335, 0.38), (-0.010, -0.325, 0.0), (-0.010, -0.32, -0.24))
    webbing = [[(x + s * d, y - 0.024, z), (x + s * d, y + 0.024, z)] for d, y, z in run]
    part.sheet(webbing, "PlasticSoft", thick=0.0025)
    part.box((x + s * 0.012, -0.345, 0.53), (0.030, 0.075, 0.035), "PlasticHard", bevel=0.008)
    buckle = xc - s * 0.285
    lean = Matrix.Rotation(-0.209, 4, "X")
    part.box((buckle, -0.10, -0.06), (0.022, 0.045, 0.09), "PlasticHard", bevel=0.006, rot=lean)
    part.box((buckle, -0.107, -0.014), (0.014, 0.03, 0.006), "Stitch", bevel=0.001)
    part.build()
