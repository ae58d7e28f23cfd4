"""Toothed rings around the shaft."""
from math import cos, pi, radians, sin, tan

from gearbox.dimensions import SPLINE_DEPTH, SPLINE_R, TEETH


def around(r, a, y):
    """The point at radius r and angle a [rad] from +x upwards."""
    return (r * cos(a), y, r * sin(a))


def turned(part, profile, mat, n=40, a0=0.0, a1=360.0, caps=None):
    """Closed profile [(radius, y)] revolved around the shaft, fully or from a0 to a1 degrees with capped ends."""
    whole = a1 - a0 >= 360
    steps = n if whole else max(3, round(n * (a1 - a0) / 360)) + 1
    span = radians(a1 - a0)
    angles = [radians(a0) + span * i / (n if whole else steps - 1) for i in range(steps)]
    rings = [[around(r, a, y) for r, y in profile] for a in angles]
    part.loft(rings, mat, loop=whole, caps=False)
    if not whole:
        for ring in (rings[0], rings[-1]):
            part.piece(ring, [tuple(range(len(ring)))], caps or mat)


def spline_teeth(part, y0, y1, mat, pointed=(True, True), inward=False, sector=None, tip=0.0016):
    """Prisms with roof-shaped ends along the shaft; on the outside of a ring, or inward on its bore."""
    half = pi / TEETH * 0.46
    inner, outer = SPLINE_R - SPLINE_DEPTH * (1.0 if inward else 1.4), SPLINE_R + SPLINE_DEPTH * (
        1.4 if inward else 1.0
    )
    free = inner if inward else outer
    base = outer if inward else inner
    for i in range(TEETH):
        a = 2 * pi * i / TEETH + (pi / TEETH if inward else 0)
        if sector and sector[0] - 3 < (a * 180 / pi) % 360 < sector[1] + 3:
            continue
        outline = [(-half, y0 + tip * pointed[0]), (-half, y1 - tip * pointed[1])]
        outline += [(0, y1)] if pointed[1] else []
        outline += [(half, y1 - tip * pointed[1]), (half, y0 + tip * pointed[0])]
        outline += [(0, y0)] if pointed[0] else []
        n = len(outline)
        taper = 0.78 if not inward else 0.9
        verts = [around(base, a + d, y) for d, y in outline] + [around(free, a + d * taper, y) for d, y in outline]
        walls = [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
        part.piece(verts, [tuple(range(n, 2 * n))] + walls, mat)


def helical_gear(part, y0, y1, teeth, tip_r, root_r, helix, mat):
    """Trapezoid teeth twisted along the face width; open towards the body."""
    pitch = 2 * pi / teeth
    shape = ((-0.36, root_r), (-0.16, tip_r), (0.16, tip_r), (0.36, root_r))
    twist = tan(radians(helix)) / ((tip_r + root_r) / 2)  # [rad/m] twist of the teeth along the shaft

    def ring(y, shrink=0.0):
        points = []
        for i in range(teeth):
            points += [around(r - shrink, pitch * (i + d) + twist * y, y) for d, r in shape]
        return points

    chamfer = 0.0009
    rings = [
        ring(y0, 0.004),
        ring(y0, chamfer),
        ring(y0 + chamfer),
        ring(y1 - chamfer),
        ring(y1, chamfer),
        ring(y1, 0.004),
    ]
    part.loft(rings, mat, caps=False)
