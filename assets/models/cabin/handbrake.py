"""Handbrake lever and its gaiter."""
from math import radians

from mathutils import Matrix, Vector

from cabin.dimensions import CENTRE_X, HANDBRAKE_PIVOT
from craft.geometry import rounded, smooth_path
from craft.part import Part

REST = 9.0  # [deg] angle at rest, at which the mesh is modelled


def build():
    F = Matrix.Translation(HANDBRAKE_PIVOT) @ Matrix.Rotation(radians(REST), 4, "X")

    def along(points):
        return [tuple(F @ Vector((0, y, z))) for y, z in points]

    part = Part("Handbrake", F, "Console", smooth=50)
    stem = ((-0.01, -0.012), (0.03, -0.004), (0.08, 0.008), (0.14, 0.022))
    part.tube(along(stem), 0.011, "MetalSatin", n=12, flat=0.9)
    grip = ((0.115, 0.017), (0.14, 0.022), (0.18, 0.031), (0.225, 0.040), (0.262, 0.046))
    path = smooth_path(along(grip), 3)
    radii = [0.0125, 0.0135, 0.0145, 0.015, 0.0153, 0.0155, 0.0158, 0.016, 0.0162, 0.0163, 0.016, 0.0155, 0.0145]
    part.tube(path, radii, "Leather", n=16, flat=1.1)
    end = along(((0.266, 0.0465), (0.272, 0.047)))
    part.tube([path[-1], *end], [0.0125, 0.0125, 0.011], "MetalSatin", n=20)
    button = along(((0.270, 0.047), (0.280, 0.049), (0.283, 0.0495)))
    part.tube(button, [0.0070, 0.0070, 0.005], "PlasticGloss", n=16)
    part.build()
    build_gaiter()


def build_gaiter():
    part = Part("HandbrakeGaiter", (CENTRE_X, HANDBRAKE_PIVOT.y, -0.04), "Console", smooth=60)
    base = rounded(0.05, 0.20, 0.02, 5)
    folds = (
        (1.0, 0, -0.043),
        (0.93, 0.002, -0.034),
        (0.86, 0.004, -0.034),
        (0.76, 0.010, -0.024),
        (0.62, 0.018, -0.022),
        (0.45, 0.03, -0.010),
    )
    rings = [[(CENTRE_X + x * k, -0.145 + y * k + forward, z) for x, y in base] for k, forward, z in folds]
    part.loft(rings, "Leather")
    part.build()
