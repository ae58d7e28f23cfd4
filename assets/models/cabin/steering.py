"""Steering wheel, column shroud and stalks."""
from math import cos, pi, radians, sin

import numpy as np
from mathutils import Matrix

from cabin.dimensions import RIM_R, WHEEL_CENTRE, WHEEL_D, WHEEL_TILT
from craft import scene
from craft.geometry import at, bump, frame, lerp, rounded, smooth_path, superellipse
from craft.part import Part, bezel, round_section

F = frame(WHEEL_CENTRE, WHEEL_TILT)
RADIUS = WHEEL_D / 2 - RIM_R  # from the wheel's centre to the centre of the rim's cross section
# Spokes: angle [deg]; width at the hub and at the rim [m].
SPOKES = ((-8, 0.056, 0.036), (188, 0.056, 0.036), (270, 0.060, 0.046))


def build():
    scene.empty("SteeringColumn", F, "Cabin")
    part = Part("SteeringWheel", F, "SteeringColumn", smooth=50)
    add_rim(part)
    for spoke in SPOKES:
        add_spoke(part, *spoke)
    for side in (-1, 1):
        add_buttons(part, side)
    add_airbag(part)
    part.build()
    build_shroud()
    for name, side in (("StalkIndicator", -1), ("StalkWiper", 1)):
        build_stalk(name, side)


def add_rim(part):
    n = 56
    angles = [2 * pi * i / n for i in range(n)]
    grips = radians(38), radians(142)
    radii = [RIM_R * (1 + 0.13 * sum(bump(a, g, 0.16) for g in grips)) for a in angles]
    part.tube([at(F, RADIUS * cos(a), 0, RADIUS * sin(a)) for a in angles], radii, "Leather", n=12, loop=True)
    inner = RADIUS - RIM_R
    seam = [at(F, inner * cos(2 * pi * i / 60), 0, inner * sin(2 * pi * i / 60)) for i in range(60)]
    part.tube(seam, 0.0011, "Stitch", n=3, loop=True)


def add_spoke(part, angle, w0, w1):
    """Flat loft from the hub to the rim."""
    a = radians(angle)
    rings = []
    for t in (0, 0.25, 0.5, 0.75, 1):
        r, depth = lerp(0.035, RADIUS - 0.004, t), lerp(-0.030, -0.001, t**0.8)
        half_w, thick = lerp(w0, w1, t) / 2, lerp(0.010, 0.0075, t)
        ring = []
        for k in range(12):
            b = 2 * pi * k / 12
            s = round_section(cos(b), 0.6) * half_w
            ring.append(at(F, r * cos(a) - s * sin(a), depth + sin(b) * thick, r * sin(a) + s * cos(a)))
        rings.append(ring)
    part.loft(rings, "PlasticHard", sub=1)
    if sin(a) < -0.5:
        add_lower_inlay(part)


def add_lower_inlay(part):
    """Satin brackets around a black plate on the lower spoke."""
    for side in (-1, 1):
        path = []
        for t in np.linspace(0.34, 0.96, 6):
            r = lerp(0.035, RADIUS - 0.004, t)
            x = side * lerp(0.0195, 0.0150, t)
            path.append(at(F, x, lerp(-0.030, -0.001, t**0.8) + lerp(0.010, 0.0075, t) - 0.0006, -r))
        part.tube(path, [0.0032] * 6, "MetalSatin", n=6)
    plate = []
    for t in np.linspace(0.40, 0.95, 4):
        r, depth = lerp(0.035, RADIUS - 0.004, t), lerp(-0.030, -0.001, t**0.8) + lerp(0.0101, 0.0077, t)
        plate.append([at(F, x * lerp(0.0165, 0.0125, t), depth, -r) for x in (-1, 0, 1)])
    part.sheet(plate, "PlasticGloss", thick=0.002)


def add_buttons(part, side):
    turn = Matrix.Rotation(radians(7 * side), 4, "Y") @ Matrix.Rotation(radians(-16 * side), 4, "Z")
    S = F @ Matrix.Translation((side * 0.108, 0.010, -0.010)) @ turn
    part.panel(S, rounded(0.052, 0.036, 0.012), -0.004, 0.0055, "PlasticGloss", bevel=0.002)
    bezel(part, S, rounded(0.056, 0.040, 0.014), rounded(0.050, 0.034, 0.011), -0.003, 0.0068, 0.004, "MetalSatin")
    for j in (-1, 0, 1):
        button = rounded(0.013, 0.010 if j else 0.014, 0.003, cx=j * 0.0155)
        part.panel(S, button, 0.004, 0.0075, "PlasticHard", bevel=0.001, seg=1)


def add_airbag(part):
    def ring(k, depth):
        points = []
        for x, z in superellipse(0.062 * k, 0.052 * k, 2.8, 32):
            wide = 1 + 0.10 * max(z, 0) / 0.052
            drop = 0.008 * (1 - abs(x) / 0.07) * k if z < 0 else 0
            points.append(at(F, x * wide, depth, z - 0.002 - drop))
        return points

    profile = ((0.80, -0.062), (0.97, -0.040), (1.0, -0.022), (0.985, -0.010), (0.95, -0.003), (0.90, 0.001))
    groove = ((0.885, -0.001), (0.87, -0.001), (0.855, 0.0022))
    profile += groove + ((0.72, 0.0062), (0.50, 0.0090), (0.26, 0.0103), (0.06, 0.0106))
    part.loft([ring(*p) for p in profile], "PlasticSoft")
    emblem = F @ Matrix.Translation((0, -0.0103, 0.003))
    outer = [(0.0170, -0.003), (0.0170, 0.001), (0.0156, 0.0020), (0.0144, 0.0010), (0.0141, -0.0004)]
    part.lathe(emblem, outer, "MetalSatin", n=28)
    part.lathe(emblem, [(0.0142, -0.0002), (0.0075, 0.0006), (0.0002, 0.0008)], "PlasticGloss", n=24)
    for x in (-1, 0, 1):  # our own logo: a gate of three slots
        part.box((x * 0.0058, -0.0010, 0), (0.0016, 0.0012, 0.0140), "MetalSatin", emblem, bevel=0)
    part.box((0, -0.0010, 0), (0.0116, 0.0012, 0.0016), "MetalSatin", emblem, bevel=0)


def build_shroud():
    part = Part("ColumnShroud", F, "SteeringColumn", smooth=50)
    sections = ((-0.058, 0.046, 0.046), (-0.064, 0.052, 0.052), (-0.09, 0.055, 0.056), (-0.16, 0.058, 0.062))
    sections += ((-0.30, 0.062, 0.070),)
    rings = [[at(F, x, d, z - 0.008) for x, z in superellipse(a, b, 3.2, 24)] for d, a, b in sections]
    part.loft(rings, "PlasticHard")
    lock = F @ Matrix.Translation((0.062, 0.125, -0.012)) @ Matrix.Rotation(radians(60), 4, "Z")
    profile = [(0.015, -0.012), (0.015, 0.001), (0.013, 0.003), (0.009, 0.003), (0.008, 0), (0.0002, 0)]
    part.lathe(lock, profile, "MetalSatin", n=24)
    part.build()


def build_stalk(name, side):
    part = Part(name, F @ Matrix.Translation((side * 0.045, 0.082, 0.002)), "SteeringColumn")
    corners = ((0.045, -0.082, 0.002), (0.085, -0.080, 0.006), (0.125, -0.074, 0.012), (0.172, -0.066, 0.018))
    path = smooth_path([at(F, side * x, d, z) for x, d, z in corners], 4)
    radii = [0.0075, 0.0075, 0.0072, 0.007, 0.007, 0.007, 0.0075, 0.0085, 0.0092, 0.0095, 0.0095, 0.009, 0.0065]
    part.tube(path, radii, "PlasticHard", n=12, flat=0.8)
    part.tube([path[9], path[10]], 0.0102, "PlasticGloss", n=12, flat=0.8)
    part.build()
