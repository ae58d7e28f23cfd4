"""Rear: bench, side trim, tailgate, rear and quarter glass."""
import numpy as np

from cabin.dimensions import CENTRE_X, FLOOR_Z, HALF_BELT, side_x
from craft.geometry import smooth_path
from craft.part import Part


def build():
    build_bench()
    build_trim()
    build_glass()


def build_bench():
    part = Part("RearBench", parent="Cabin", smooth=70)
    across = np.linspace(-1, 1, 9)
    seat = ((-1.20, -0.20), (-1.20, -0.03), (-0.95, -0.02), (-0.78, 0.005), (-0.72, -0.03), (-0.73, -0.20))
    part.loft([[(CENTRE_X + u * 0.64, y, z - 0.03 * abs(u) ** 3) for y, z in seat] for u in across], "Fabric", sub=1)
    back = ((-1.15, -0.04), (-1.07, -0.02), (-1.10, 0.20), (-1.20, 0.46), (-1.25, 0.50), (-1.32, 0.46), (-1.28, 0.0))
    part.loft([[(CENTRE_X + u * 0.64, y, z - 0.05 * abs(u) ** 4) for y, z in back] for u in across], "Fabric", sub=1)
    part.build()


def build_trim():
    part = Part("RearTrim", parent="Cabin", smooth=50)
    profile = ((-0.03, FLOOR_Z), (0.02, FLOOR_Z), (0.02, 0.15), (0.06, 0.17), (0.06, 0.20), (0.015, 0.23), (0.03, 0.40))
    profile += ((0.0, 0.435), (-0.03, 0.43))
    for side in (-1, 1):
        rings = []
        for y in (-0.45, -0.50, -0.8, -1.2, -1.35):
            rings.append([(CENTRE_X + side * (HALF_BELT - d), y, z) for d, z in profile])
        part.loft(rings, "PlasticHard", sub=1)
    tailgate = ((-1.34, FLOOR_Z), (-1.38, 0.20), (-1.42, 0.42), (-1.40, 0.46))
    part.sheet([[(CENTRE_X + u * 0.66, y, z) for u in (-1, 0, 1)] for y, z in tailgate], "PlasticHard", thick=0.02)
    header = [(CENTRE_X - 0.56, -1.22, 0.84), (CENTRE_X, -1.24, 0.885), (CENTRE_X + 0.56, -1.22, 0.84)]
    part.tube(smooth_path(header, 6), 0.04, "Headliner", n=10)
    part.build()


def build_glass():
    part = Part("GlassRear", parent="Cabin")
    across = (-1, -0.5, 0, 0.5, 1)
    rows = [[(CENTRE_X + u * 0.58, -1.41, 0.45), (CENTRE_X + u * 0.53, -1.25, 0.86)] for u in across]
    part.sheet(rows, "Glass", thick=0)
    outline = ((-0.42, 0.43), (-0.40, 0.86), (-0.8, 0.855), (-1.1, 0.83), (-1.02, 0.6), (-0.95, 0.43))
    for side in (-1, 1):
        pane = [(side_x(side, z) + side * 0.012, y, z) for y, z in outline]
        part.piece(pane, [tuple(range(6))], "Glass")
    part.build()
