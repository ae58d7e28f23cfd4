"""Twelve metres of road, repeatable along y; x = 0 is the middle of the driver's lane (right-hand traffic)."""
from road.pieces import Thing

LENGTH, LANE, LINE = 12.0, 3.5, 0.12
DASH = 4.0  # [m] length of a dash of the lane marking; a gap of 8 m follows
VERGE = 30.0  # [m] width of the grass on either side
LEFT, RIGHT = -LANE * 1.5, LANE / 2  # [m] x of the edge lines
SHOULDER = 0.45


def columns():
    """x of the strips across the road, and whether each strip is a marking."""
    xs = [LEFT - SHOULDER]
    for line in (LEFT, -LANE / 2, RIGHT):
        xs += [line - LINE / 2, line + LINE / 2]
    return xs + [RIGHT + SHOULDER]


def build():
    half = LENGTH / 2
    part = Thing("Road", smooth=60)
    xs = columns()
    for i, (x0, x1) in enumerate(zip(xs, xs[1:])):
        is_line, is_middle = i % 2 == 1, i == 3
        ends = ((-half, -half + DASH), (-half + DASH, half)) if is_middle else ((-half, half),)
        for k, (y0, y1) in enumerate(ends):
            corners = [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
            if is_line and not (is_middle and k):
                part.face(corners, "paint")
            else:
                part.piece(corners, [(0, 1, 2, 3)], "Asphalt", recalc=False)
    for side, edge in ((-1, xs[0]), (1, xs[-1])):
        add_verge(part, side, edge, half)
    part.build()


def add_verge(part, side, edge, half):
    """Gravel strip, shallow ditch, then grass that falls away a little."""
    outer = edge + side * 0.6
    gravel = [(edge, -half, 0), (outer, -half, -0.05), (outer, half, -0.05), (edge, half, 0)]
    part.face(gravel if side > 0 else gravel[::-1], "earth")
    profile = ((0.6, -0.05), (1.6, -0.28), (2.4, -0.30), (3.6, -0.06), (8.0, 0.02), (16.0, -0.05), (VERGE, -0.45))
    grid = [[(edge + side * d, y, z) for d, z in profile] for y in (-half, half)]
    verts = [p for row in grid for p in row]
    n = len(profile)
    faces = []
    for a in range(n - 1):
        quad = (a, a + 1, a + n + 1, a + n)
        faces.append(quad if side > 0 else quad[::-1])
    part.piece(verts, faces, "Grass", recalc=False)
