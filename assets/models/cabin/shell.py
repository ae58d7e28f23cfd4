"""Inner shell: pillars, roof lining with visors, floor, sills, mats."""
import numpy as np
from mathutils import Vector

from cabin.dimensions import (
    CENTRE_X,
    FLOOR_Z,
    HALF_BELT,
    HALF_ROOF,
    PILLAR_FOOT,
    ROOF_RAIL,
    ROOF_Z,
    SEAT_X,
    side_x,
)
from craft.geometry import frame, lerp, rounded, smooth_path
from craft.part import Part


def build():
    build_pillars()
    build_roof()
    for name, side in (("Left", -1), ("Right", 1)):
        build_visor(name, side)
    build_floor()
    for name, x in SEAT_X.items():
        build_mat(name, x)


def build_pillars():
    part = Part("Pillars", parent="Cabin", smooth=55)
    for side in (-1, 1):
        add_a_pillar(part, side)
        add_b_pillar(part, side)
        rail = [(side_x(side, z) + side * 0.004, y, z + 0.008) for y, z in [(0.47, 0.845)] + ROOF_RAIL]
        part.tube(smooth_path(rail, 3), 0.034, "Headliner", n=10)
        rear = [(side_x(side, z), y, z) for y, z in ((-0.98, 0.40), (-1.07, 0.60), (-1.22, 0.84))]
        part.tube(smooth_path(rear, 4), 0.055, "Headliner", n=10)
    half = [(HALF_ROOF, 0.425, 0.868), (0.3, 0.455, 0.880)]
    header = [(CENTRE_X - x, y, z) for x, y, z in half] + [(CENTRE_X, 0.462, 0.884)]
    header += [(CENTRE_X + x, y, z) for x, y, z in half[::-1]]
    part.tube(smooth_path(header, 5), 0.022, "Headliner", n=10, flat=0.8)
    part.build()


def add_a_pillar(part, side):
    """Section (u along the glass, v into the cabin), foot sunk into the dashboard's corner."""
    foot = Vector((CENTRE_X + side * (HALF_BELT - 0.005), PILLAR_FOOT[0] + 0.02, PILLAR_FOOT[1]))
    head = Vector((CENTRE_X + side * (HALF_ROOF - 0.005), *ROOF_RAIL[0]))
    outline = [(-0.10, 0.55), (0.55, 0.60), (1.0, 0.10), (0.75, -0.75), (0.0, -1.0), (-0.80, -0.55)]
    rings = []
    for t in np.linspace(-0.10, 1.04, 6):
        w = lerp(0.046, 0.040, t)
        ring = []
        for u, v in outline:
            p = foot.lerp(head, t) + Vector((side * w * 0.35, 0, 0)) + Vector((0, 0.6, 0.4)) * w * v * 0.75
            p += Vector((-side * 0.85 * w * (u * 0.55 + v * 0.25), w * u * 0.525, w * u * 0.33))
            ring.append(tuple(p))
        rings.append(ring)
    part.loft(rings, "Headliner", sub=1)


def add_b_pillar(part, side):
    stations = (  # z, half width along the car, depth, y
        (FLOOR_Z, 0.10, 0.05, -0.40),
        (0, 0.09, 0.05, -0.40),
        (0.30, 0.085, 0.05, -0.395),
        (0.42, 0.075, 0.045, -0.39),
        (0.60, 0.062, 0.036, -0.375),
        (0.80, 0.058, 0.032, -0.36),
        (0.90, 0.075, 0.03, -0.355),
    )
    outline = ((0, -1), (0, 1), (0.55, 0.95), (0.95, 0.6), (1, 0), (0.95, -0.6), (0.55, -0.95))
    rings = []
    for z, half, depth, y in stations:
        x = side_x(side, z) - side * 0.006
        rings.append([(x - side * depth * u + side * 0.03, y + half * v, z) for u, v in outline])
    part.loft(rings, "Headliner", sub=1)


def build_roof():
    """Lining, dome light, grab handle on the passenger's side."""
    part = Part("RoofLining", parent="Cabin", smooth=60)
    stations = (  # y, height at the rails, height in the middle
        (0.455, 0.870, 0.884),
        (0.40, 0.878, 0.902),
        (0.25, 0.895, 0.930),
        (0, 0.900, ROOF_Z),
        (-0.4, 0.900, ROOF_Z),
        (-0.8, 0.885, 0.930),
        (-1.22, 0.85, 0.89),
    )
    across = np.linspace(-1, 1, 13)
    rows = []
    for y, rail, middle in stations:
        rows.append([(CENTRE_X + u * (HALF_ROOF + 0.02), y, lerp(middle, rail, abs(u) ** 2.6)) for u in across])
    part.sheet(rows, "Headliner", thick=0)
    F = frame((CENTRE_X, 0.34, 0.902), -78)
    dome = [(0.0005, 0.020), (0.040, 0.018), (0.062, 0.012), (0.066, 0.004), (0.066, -0.02)]
    part.lathe(F, dome, "Headliner", n=24)
    part.lathe(F, [(0.0005, 0.0215), (0.036, 0.0195), (0.038, 0.016), (0.038, -0.01)], "PlasticHard", n=20)
    bends = ((0.10, 0.885), (0.09, 0.858), (0.0, 0.850), (-0.09, 0.858), (-0.10, 0.885))
    grip = [(CENTRE_X + HALF_ROOF - 0.028, y, z) for y, z in bends]
    part.tube(smooth_path(grip, 4), 0.0085, "Headliner", n=10)
    part.build()


def build_visor(name, side):
    hinge = Vector((CENTRE_X + side * 0.30, 0.425, 0.876))
    part = Part("SunVisor" + name, hinge, "Cabin")
    outline = rounded(0.36, 0.135, 0.035, 5, cx=0, cy=0.075)
    part.panel(frame(hinge, -74), outline, -0.012, 0.006, "Headliner", bevel=0.007, seg=2)
    part.build()


def build_floor():
    """Floor, toe board, bulkhead, sills."""
    part = Part("Floor", parent="Cabin", smooth=50)
    across = (-HALF_BELT - 0.01, -0.3, 0, 0.3, HALF_BELT + 0.01)
    along = ((-1.35, FLOOR_Z + 0.03), (-0.5, FLOOR_Z), (0.62, FLOOR_Z), (0.72, FLOOR_Z + 0.01), (0.92, -0.12))
    along += ((1.0, 0.0), (1.03, 0.30), (1.02, 0.38))
    part.sheet([[(CENTRE_X + x, y, z) for x in across] for y, z in along], "Carpet", thick=0.01)
    for side in (-1, 1):
        sill = [(CENTRE_X + side * (HALF_BELT - 0.01), y, FLOOR_Z + 0.015) for y in (-0.5, 0, 0.5, 0.95)]
        part.tube(sill, 0.035, "PlasticHard", n=12)
        x = CENTRE_X + side * HALF_BELT
        part.sheet([[(x, y, z) for z in (FLOOR_Z, 0.1, 0.41)] for y in (0.90, 1.0, 1.15)], "PlasticHard", thick=0.01)
    part.build()


def build_mat(name, xc):
    part = Part("FloorMat" + name, (xc, 0.50, FLOOR_Z), "Cabin")
    w = 0.40
    F = frame((xc + (-0.05 if xc < CENTRE_X else 0.05), 0.53, FLOOR_Z + 0.006), 90)
    part.panel(F, rounded(w, 0.36, 0.05, 4), 0, 0.007, "Carpet", bevel=0.003, seg=1)
    hem = [tuple(F @ Vector((x, -0.0065, z))) for x, z in rounded(w - 0.006, 0.354, 0.048, 3)]
    part.tube(hem, 0.0042, "PlasticSoft", n=4, loop=True)
    part.panel(F, rounded(0.22, 0.20, 0.03, 4, cy=0.02), 0.006, 0.009, "PlasticSoft", bevel=0.0015)
    for i in range(7):
        rib = rounded(0.19, 0.008, 0.003, 2, cy=0.02 + (i - 3) * 0.026)
        part.panel(F, rib, 0.008, 0.0115, "PlasticSoft", bevel=0)
    part.build()
