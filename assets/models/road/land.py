"""The distant landscape, which does not move: a patchwork of fields, and rings of hills paled by haze."""
from math import cos, pi, sin

import numpy as np

from road.pieces import Thing

FIELD_R = 460.0
LEVEL = -0.5  # [m] height of the fields, which are below the verges
_random = np.random.default_rng(5)


def build_fields():
    """Sectors and rings of plain colour."""
    part = Thing("Fields", smooth=60)
    radii, n = (0.0, 45.0, 90.0, 170.0, 290.0, FIELD_R), 20
    colours = ("field_a", "field_b", "field_c")
    for k, (r0, r1) in enumerate(zip(radii, radii[1:])):
        for i in range(n):
            a, b = 2 * pi * i / n, 2 * pi * (i + 1) / n
            corners = [(r * cos(t), r * sin(t), LEVEL) for r, t in ((r0, a), (r1, a), (r1, b), (r0, b))]
            colour = "field_a" if k < 1 else colours[_random.integers(3)]
            part.face(corners if r0 else corners[:1] + corners[1:3], colour)
    part.build()


def ridge(n, low, high):
    """A closed height profile from a few harmonics."""
    a = 2 * pi * np.arange(n) / n
    h = sum(_random.standard_normal() * np.cos(k * a + 2 * pi * _random.random()) / k**0.7 for k in range(2, 15))
    h = (h - h.min()) / (h.max() - h.min())
    return low + (high - low) * h


def build_hills():
    part = Thing("Hills", smooth=80)
    n = 64
    for radius, low, high, colour in ((660, 60, 128, "wood_far"), (540, 22, 70, "wood_mid"), (430, 6, 30, "wood_near")):
        angles = [2 * pi * i / n for i in range(n)]
        foot = [(radius * cos(a), radius * sin(a), LEVEL - 4) for a in angles]
        top = [(1.12 * radius * cos(a), 1.12 * radius * sin(a), z) for a, z in zip(angles, ridge(n, low, high))]
        walls = [((i + 1) % n, i, n + i, n + (i + 1) % n) for i in range(n)]
        part.tint(part.piece(foot + top, walls, "Roadside", recalc=False), colour)
    part.build()


def build():
    build_fields()
    build_hills()
