"""The view through the windscreen: the screen itself, wipers, bonnet and wings."""
from math import pi, sin

import numpy as np

from cabin.dimensions import CENTRE_X, HALF_BELT, HALF_ROOF, SCREEN_BASE, SCREEN_HEAD
from craft.geometry import bump, lerp
from craft.part import Part


def build():
    build_windscreen()
    build_wipers()
    build_bonnet()


def build_windscreen():
    part = Part("Windscreen", parent="Cabin")
    rows = []
    for t in np.linspace(0, 1, 7):
        half, bulge, row = lerp(HALF_BELT - 0.005, HALF_ROOF, t), sin(pi * t), []
        for u in np.linspace(-1, 1, 13):
            y = lerp(SCREEN_BASE[0] - 0.105 * u * u, SCREEN_HEAD[0] + 0.035 - 0.045 * u * u, t) + 0.02 * bulge
            z = lerp(SCREEN_BASE[1], SCREEN_HEAD[1] + 0.006 - 0.012 * u * u, t) + 0.028 * bulge
            row.append((CENTRE_X + u * half, y, z))
        rows.append(row)
    part.sheet(rows, "Glass", thick=0)
    part.build()


def build_wipers():
    """Cowl and two wiper blades at rest."""
    part = Part("Wipers", parent="Cabin")
    foot = SCREEN_BASE[0]
    cowl = []
    for dy, z in ((-0.02, 0.398), (0.06, 0.392), (0.12, 0.400)):
        cowl.append([(CENTRE_X + u * 0.70, foot + dy - 0.105 * u * u, z) for u in np.linspace(-1, 1, 9)])
    part.sheet(cowl, "PlasticHard", thick=0.008)
    for start in (-0.22, 0.38):
        path = []
        for t in (0, 0.3, 0.6, 1):
            x = start + 0.52 * t
            path.append((x, 1.23 - 0.05 * t - 0.10 * ((x - CENTRE_X) / 0.7) ** 2, 0.418 + 0.012 * t))
        part.tube(path, [0.007, 0.006, 0.005, 0.004], "PlasticHard", n=8)
    part.build()


def build_bonnet():
    """Bonnet with a crowned middle and two swage lines, and the wings."""
    part = Part("Bonnet", parent="Cabin", smooth=60)
    stations = (
        (1.30, 0.415, 0.70),
        (1.34, 0.424, 0.71),
        (1.50, 0.428, 0.715),
        (1.70, 0.410, 0.70),
        (1.90, 0.365, 0.67),
    )
    stations += ((2.02, 0.300, 0.63), (2.06, 0.235, 0.60))
    rows = []
    for y, z, half in stations:
        row = []
        for u in np.linspace(-1, 1, 21):
            swage = 0.014 * bump(abs(u), 0.62, 0.09) - 0.006 * bump(abs(u), 0.48, 0.06)
            back = 0.06 * u * u * (y > 1.8) + 0.09 * u * u * (y < 1.45)
            row.append((CENTRE_X + u * half, y - back, z - 0.055 * abs(u) ** 3 + swage))
        rows.append(row)
    part.sheet(rows, "BodyPaint", thick=0, sub=1)
    edge = ((1.10, 0.44, 0.71), (1.3, 0.43, 0.71), (1.55, 0.405, 0.715), (1.80, 0.365, 0.69), (1.98, 0.30, 0.64))
    edge += ((2.05, 0.2, 0.60),)
    outline = ((0.004, -0.05), (0.05, -0.075), (0.085, -0.14), (0.09, -0.40))
    for side in (-1, 1):
        wing = [[(CENTRE_X + side * (half + d), y, z + dz) for d, dz in outline] for y, z, half in edge]
        part.sheet(wing, "BodyPaint", thick=0, sub=1)
    part.build()
