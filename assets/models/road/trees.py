"""A broad-leaved tree and a spruce of lumps and tiers."""
from math import cos, pi, sin

import numpy as np

from road.pieces import Thing

_random = np.random.default_rng(11)


def lump(part, centre, radius, squash, n=9, rows=6):
    """Uneven ball of leaves."""
    rings = []
    for j in range(rows + 1):
        t = pi * (j / rows - 0.5)
        ring = []
        for i in range(n):
            a = 2 * pi * (i + 0.5 * (j % 2)) / n
            r = radius * (1 + 0.16 * _random.standard_normal()) * (cos(t) if 0 < j < rows else 0.02)
            height = radius * squash * sin(t) * (1 + 0.08 * _random.standard_normal())
            ring.append((centre[0] + r * cos(a), centre[1] + r * sin(a), centre[2] + height))
        rings.append(ring)
    part.loft(rings, "Leaves")


def trunk(part, height, r0, r1, lean=0.0):
    path = [(lean * t * t, 0.3 * lean * t, height * t - 0.1) for t in (0, 0.35, 0.7, 1)]
    radii = [r0 * 1.25, r0, (r0 + r1) / 2, r1]
    part.tint(part.tube(path, radii, "Roadside", n=7), "bark")


def build_broad_leaved():
    part = Thing("TreeBroad", smooth=80)
    trunk(part, 3.2, 0.17, 0.11, 0.15)
    for x, y, z, r in ((0.1, 0.1, 5.0, 1.75), (-1.1, 0.3, 4.1, 1.15), (1.2, -0.3, 4.2, 1.25), (0.2, 1.0, 4.2, 1.15)):
        lump(part, (x, y, z), r, 0.92)
    for x, y, z, r in ((-0.2, -1.1, 4.0, 1.1), (0.5, 0.3, 6.2, 1.1)):
        lump(part, (x, y, z), r, 0.85, 8, 5)
    part.build()


def build_spruce():
    part = Thing("TreeSpruce", smooth=60)
    trunk(part, 1.6, 0.16, 0.14)
    tiers = 6
    for k in range(tiers):
        low, radius = 1.0 + 1.25 * k, 1.9 * (1 - k / (tiers + 0.4)) + 0.12
        n = 13
        rings = []
        for r, z in ((radius * 0.25, low + 0.35), (radius, low), (radius * 0.45, low + 0.85), (0.03, low + 1.9)):
            ring = []
            for i in range(n):
                a = 2 * pi * (i + 0.37 * k) / n
                k_r = r * (
                    1 + (0.22 if r == radius else 0.05) * (1 if i % 2 else -1) + 0.05 * _random.standard_normal()
                )
                ring.append((k_r * cos(a), k_r * sin(a), z - (0.16 if r == radius and i % 2 else 0)))
            rings.append(ring)
        part.loft(rings, "Leaves", caps=False)
    part.build()


def build_bush():
    part = Thing("Bush", smooth=80)
    for x, y, z, r in ((0, 0, 0.55, 0.75), (0.8, 0.2, 0.42, 0.58), (-0.7, -0.1, 0.40, 0.52)):
        lump(part, (x, y, z), r, 0.8, 8, 5)
    part.build()


def build():
    build_broad_leaved()
    build_spruce()
    build_bush()
