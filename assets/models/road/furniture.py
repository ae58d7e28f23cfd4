"""Reflector post, speed sign, guard rail, telegraph pole, hay bale. They face the driver: -y."""
from math import cos, pi, sin

from craft.geometry import circle, frame
from road.colours import SIGN
from road.pieces import Thing


def build_post():
    """Roadside post with a slanted black band and reflectors."""
    part = Thing("Post", smooth=30)
    w, d, h = 0.06, 0.05, 1.0
    outline = ((-w, -d), (w, -d), (0, d))
    levels = ((0, 0, "white"), (0.70, 0.66, "black"), (0.92, 0.88, "white"), (h, h - 0.06, None))
    for (z0, z0b, colour), (z1, z1b, _) in zip(levels, levels[1:]):
        rings = [[(x, y, za if y < 0 else zb) for x, y in outline] for za, zb in ((z0, z0b), (z1, z1b))]
        part.tint(part.loft(rings, "Roadside", caps=(False, z1 == h)), colour)
    x, y = 0.0225, -d - 0.004
    part.face([(-x, y, 0.725), (x, y, 0.725), (x, y, 0.875), (-x, y, 0.875)], "orange")
    part.build()


def build_sign():
    part = Thing("Sign", smooth=40)
    part.tint(part.tube([(0, 0, -0.1), (0, 0, 2.7)], 0.032, "Roadside", n=6, caps=False), "steel")
    F = frame((0, -0.04, 2.35))
    part.flat(F, circle(0.30, 20), 0.006, "Roadside", (SIGN, F, 0.60, 0.60))
    part.tint(part.flat(F, circle(0.302, 20)[::-1], 0.0, "Roadside"), "grey")
    part.build()


def build_rail():
    """Four metres of guard rail along y, its face towards -x (place it on the right), post in the middle."""
    part = Thing("GuardRail", smooth=50)
    wave = ((0.0, 0.46), (-0.055, 0.50), (-0.055, 0.545), (0.0, 0.605), (-0.055, 0.665), (-0.055, 0.71), (0.0, 0.75))
    for (x0, z0), (x1, z1) in zip(wave, wave[1:]):
        part.face([(x0, 2.0, z0), (x0, -2.0, z0), (x1, -2.0, z1), (x1, 2.0, z1)], "steel")
    post = [(0.01, -0.03), (0.11, -0.03), (0.11, 0.03), (0.01, 0.03)]
    for (x0, y0), (x1, y1) in ((post[3], post[0]), (post[0], post[1]), (post[2], post[3])):
        part.face([(x0, y0, -0.1), (x1, y1, -0.1), (x1, y1, 0.70), (x0, y0, 0.70)], "steel")
    part.build()


def build_pole():
    part = Thing("Pole", smooth=50)
    part.tint(part.tube([(0, 0, -0.2), (0, 0, 7.5)], [0.14, 0.10], "Roadside", n=6, caps=(False, True)), "wood")
    part.block((0, 0, 7.0), (1.5, 0.10, 0.10), "wood")
    for x in (-0.65, -0.25, 0.25, 0.65):
        part.tint(part.tube([(x, 0, 7.05), (x, 0, 7.18)], 0.035, "Roadside", n=3, caps=(False, True)), "white")
    part.build()


def build_bale():
    """Round bale lying across."""
    part = Thing("Bale", smooth=50)
    n = 14
    ring = [(0.6 * cos(2 * pi * i / n), 0.6 + 0.6 * sin(2 * pi * i / n)) for i in range(n)]
    part.tint(part.loft([[(x, y, z) for y, z in ring] for x in (-0.6, 0.6)], "Roadside"), "hay")
    part.build()


def build():
    for one in (build_post, build_sign, build_rail, build_pole, build_bale):
        one()
