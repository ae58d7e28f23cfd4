"""A farmhouse and a barn. Long side along y, front towards -x: for the right side of the road."""
from road.pieces import Thing


def gabled(part, half_x, half_y, eaves, ridge, walls, roof, overhang=0.45):
    """Walls up to the eaves with gables at both ends, roof with an overhang."""
    for x in (-half_x, half_x):
        s = 1 if x > 0 else -1
        face = [(x, -s * -half_y, -0.4), (x, s * -half_y, -0.4), (x, s * -half_y, eaves), (x, -s * -half_y, eaves)]
        part.face(face[::-1], walls)
    for y in (-half_y, half_y):
        s = -1 if y > 0 else 1
        gable = [
            (-s * half_x, y, -0.4),
            (s * half_x, y, -0.4),
            (s * half_x, y, eaves),
            (0, y, ridge),
            (-s * half_x, y, eaves),
        ]
        part.face(gable, walls)
    slope = (ridge - eaves) / half_x
    rows = []
    for y in (-half_y - overhang, half_y + overhang):
        edge = half_x + overhang
        rows.append([(-edge, y, ridge - slope * edge), (0, y, ridge), (edge, y, ridge - slope * edge)])
    part.tint(part.sheet(rows, "Roadside", thick=0.16, side=0), roof)


def window(part, x, y, z, w=1.0, h=1.3):
    """A window in the front (x), facing -x: white frame, dark pane."""
    for out, grow, colour in ((0.03, 0.09, "white"), (0.06, 0.0, "pane")):
        a, b = w / 2 + grow, h / 2 + grow
        part.face(
            [(x - out, y + a, z - b), (x - out, y - a, z - b), (x - out, y - a, z + b), (x - out, y + a, z + b)], colour
        )


def build_house():
    part = Thing("House", smooth=20)
    gabled(part, 4.2, 5.5, 4.6, 8.4, "plaster", "tiles")
    for z in (1.4, 3.6):
        for y in (-4.0, -1.6, 1.6, 4.0):
            if z > 2 or y != 1.6:
                window(part, -4.2, y, z, h=1.2)
    part.block((-4.22, 1.6, 0.95), (0.12, 1.1, 2.1), "wood")
    for x in (-2, 2):  # windows in the gable that faces the traffic
        for y, a, b, colour in ((-5.53, 0.575, 0.7, "white"), (-5.56, 0.49, 0.6, "pane")):
            part.face([(x - a, y, 1.6 - b), (x + a, y, 1.6 - b), (x + a, y, 1.6 + b), (x - a, y, 1.6 + b)], colour)
    part.block((1.2, 2.5, 8.2), (0.7, 0.7, 1.6), "stone")
    part.build()


def build_barn():
    part = Thing("Barn", smooth=20)
    gabled(part, 5.0, 8.0, 4.2, 8.6, "barn", "grey")
    part.block((-5.02, 0, 1.7), (0.10, 3.6, 3.6), "wood")
    for y in (-1.85, 0, 1.85):
        part.block((-5.08, y, 1.7), (0.06, 0.14, 3.6), "white")
    part.block((0, -8.02, 5.8), (1.2, 0.10, 1.2), "wood")
    part.build()


def build():
    build_house()
    build_barn()
