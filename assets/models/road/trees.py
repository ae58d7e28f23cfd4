"""A broad-leaved tree, a spruce and a bush: a dark body surrounded by cards with drawn leaves."""
from math import cos, pi, sin

import numpy as np
from mathutils import Vector

from road.colours import BOUGH, SPRUCE
from road.pieces import Thing

_random = np.random.default_rng(11)


def lump(part, centre, radius, squash, n=7, rows=4):
    """Uneven ball: the darkness between the boughs."""
    rings = []
    for j in range(rows + 1):
        t = pi * (j / rows - 0.5)
        ring = []
        for i in range(n):
            a = 2 * pi * (i + 0.5 * (j % 2)) / n
            r = radius * (1 + 0.10 * _random.standard_normal()) * (cos(t) if 0 < j < rows else 0.05)
            ring.append((centre[0] + r * cos(a), centre[1] + r * sin(a), centre[2] + radius * squash * sin(t)))
        rings.append(ring)
    part.tint(part.loft(rings, "Leaves", caps=False), "shade")


def bough(part, centre, size, heading, lean):
    """Square card around a centre, rotated at random in its plane. heading [rad] about the vertical, lean [rad] up."""
    facing = Vector((cos(heading) * cos(lean), sin(heading) * cos(lean), sin(lean)))
    x = Vector((-sin(heading), cos(heading), 0))
    y = facing.cross(x)
    turn = _random.uniform(-0.6, 0.6)
    x, y = cos(turn) * x + sin(turn) * y, cos(turn) * y - sin(turn) * x
    half = size / 2
    corners = [Vector(centre) + half * (a * x + b * y) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    part.card([tuple(c) for c in corners], BOUGH)


def trunk(part, height, r0, r1, lean=0.0):
    path = [(lean * t * t, 0.3 * lean * t, height * t - 0.1) for t in (0, 0.5, 1)]
    part.tint(part.tube(path, [r0 * 1.25, r0, r1], "Roadside", n=6, caps=False), "bark")


def build_broad_leaved():
    part = Thing("TreeBroad", smooth=80)
    trunk(part, 4.2, 0.17, 0.08, 0.15)
    for x, y, z in ((1.1, -0.3, 4.0), (-1.0, 0.4, 4.1), (0.1, 1.0, 4.4)):
        part.tint(part.tube([(0.06, 0.02, 2.3), (x, y, z)], [0.07, 0.03], "Roadside", n=3, caps=False), "bark")
    crown = (0.1, 0.1, 4.7)
    lump(part, crown, 1.35, 1.0)
    golden = pi * (3 - 5**0.5)
    n = 15
    for i in range(n):
        z = -0.62 + 1.57 * i / (n - 1)
        r = (1 - (z * 0.95) ** 2) ** 0.5
        a = i * golden
        k = 1.22 * _random.uniform(0.85, 1.15)
        middle = (crown[0] + k * r * cos(a), crown[1] + k * r * sin(a), crown[2] + 1.45 * z)
        bough(part, middle, _random.uniform(2.0, 2.5), a + _random.uniform(-0.7, 0.7), 0.5 * z)
    for i in range(3):  # upright cards through the stem, for a full outline from every side
        bough(part, (crown[0], crown[1], crown[2] + 0.2), 3.4, pi * i / 3 + 0.3, 0.0)
    part.build()
    part.light_leaves_from((crown[0], crown[1], crown[2] - 0.5))


def build_spruce():
    """Five upright pictures of the whole tree through its stem."""
    part = Thing("TreeSpruce", smooth=60)
    trunk(part, 1.4, 0.16, 0.13)
    low, high, half = 0.35, 9.2, 2.15
    for i in range(5):
        a = pi * i / 5
        k = _random.uniform(0.92, 1.06)
        x, y = half * k * cos(a), half * k * sin(a)
        part.card([(-x, -y, low), (x, y, low), (x, y, high), (-x, -y, high)], SPRUCE)
    part.build()
    part.light_leaves_from((0, 0, 2.0), 0.5)


def build_bush():
    part = Thing("Bush", smooth=80)
    lump(part, (0, 0, 0.40), 0.55, 0.8, 6, 3)
    for x, y, z, size, a in ((0, 0, 0.62, 1.7, 0.2), (0.55, 0.15, 0.5, 1.4, 1.3), (-0.5, -0.1, 0.48, 1.35, 2.3)):
        bough(part, (x, y, z), size, a, 0.15)
        bough(part, (x, y, z), size * 0.95, a + pi / 2, -0.1)
    part.build()
    part.light_leaves_from((0, 0, 0.1))


def build():
    build_broad_leaved()
    build_spruce()
    build_bush()
