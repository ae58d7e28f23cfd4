"""Centre console between the seats: tunnel, body with tray and cup ring, side strips."""
from cabin.dimensions import CENTRE_X, FLOOR_Z, GATE_Z, LEVER_PIVOT
from craft import scene
from craft.geometry import frame, level_circle, rounded, smooth_path
from craft.part import Part, bezel

DECK_Z = GATE_Z - 0.004  # height of the deck around the gate plate
SECTIONS = [  # y, half width, height of the upper edge
    (-0.42, 0.070, -0.075),
    (-0.405, 0.074, -0.060),
    (-0.34, 0.076, -0.050),
    (-0.20, 0.077, -0.046),
    (-0.04, 0.077, -0.040),
    (0.08, 0.077, -0.020),
    (0.15, 0.078, 0.012),
    (0.185, 0.079, DECK_Z),
    (0.24, 0.080, DECK_Z),
    (0.30, 0.080, DECK_Z),
    (0.352, 0.081, DECK_Z),
    (0.39, 0.084, DECK_Z + 0.001),
    (0.43, 0.088, DECK_Z + 0.004),
    (0.50, 0.096, DECK_Z + 0.018),
    (0.56, 0.106, 0.072),
    (0.61, 0.114, 0.105),
    (0.66, 0.118, 0.135),
    (0.74, 0.118, 0.14),
]


def build():
    build_tunnel()
    scene.empty("Console", (CENTRE_X, LEVER_PIVOT.y, 0), "Cabin")
    build_body()


def build_tunnel():
    part = Part("Tunnel", parent="Cabin", smooth=60)
    half = [(0.17, FLOOR_Z - 0.01), (0.135, -0.20), (0.115, -0.13), (0.08, -0.10)]
    profile = half + [(0, -0.095)] + [(-x, z) for x, z in half[::-1]]
    stations = ((-1.0, 0.9), (-0.4, 1), (0.5, 1), (0.8, 1.25), (1.05, 1.7))
    rings = [[(CENTRE_X + x, y, z * k + FLOOR_Z * (1 - k)) for x, z in profile] for y, k in stations]
    part.loft(rings, "Carpet", sub=1)
    part.build()


def section(y, half_w, top):
    foot, bottom = 0.02, FLOOR_Z - 0.01
    half = [
        (half_w + foot, bottom),
        (half_w + foot * 0.6, bottom + 0.35 * (top - bottom)),
        (half_w + 0.004, top - 0.030),
        (half_w, top - 0.010),
        (half_w - 0.008, top - 0.001),
        (half_w - 0.020, top),
    ]
    ring = half + [(0, top)] + [(-x, z) for x, z in half[::-1]]
    return [(CENTRE_X + x, y, z) for x, z in ring]


def cutter(c, size):
    """A rounded box to subtract, never drawn."""
    ob = Part("cutter").box(c, size, "PlasticHard", bevel=0.012, seg=3)
    ob.hide_render = True
    return ob


def build_body():
    well = cutter((LEVER_PIVOT.x, LEVER_PIVOT.y, GATE_Z - 0.055), (0.104, 0.112, 0.13))
    handbrake_slot = cutter((CENTRE_X, -0.135, -0.02), (0.052, 0.33, 0.11))
    tray = cutter((CENTRE_X, 0.455, DECK_Z + 0.052), (0.13, 0.105, 0.13))
    part = Part("ConsoleBody", (CENTRE_X, LEVER_PIVOT.y, 0), "Console", smooth=40)
    part.loft([section(*s) for s in SECTIONS], "PlasticHard", cut=(well, handbrake_slot, tray))
    for side in (-1, 1):
        edge = [(CENTRE_X + side * (half_w - 0.010), y, top + 0.0015) for y, half_w, top in SECTIONS[4:15]]
        part.tube(smooth_path(edge, 3), 0.0032, "MetalSatin", n=8)
    add_deck(part)
    mat = frame((CENTRE_X, 0.455, DECK_Z - 0.013), 90)
    part.panel(mat, rounded(0.122, 0.095, 0.012), -0.004, 0.002, "PlasticSoft", bevel=0.001)
    part.tube(level_circle(CENTRE_X, -0.325, -0.047, 0.036, 32), 0.0035, "MetalSatin", n=8, loop=True)
    cup = frame((CENTRE_X, -0.325, -0.047), 90)
    part.lathe(cup, [(0.036, 0.0), (0.034, 0.0005), (0.0002, 0.0015)], "PlasticSoft", n=32)
    part.build()


def add_deck(part):
    """Piano black frame around the gate plate, edged in satin."""
    face = frame((LEVER_PIVOT.x, LEVER_PIVOT.y + 0.002, DECK_Z), 90)
    outer, inner = rounded(0.140, 0.166, 0.016, 6), rounded(0.126, 0.134, 0.018, 6)
    bezel(part, face, outer, inner, -0.002, 0.0014, 0.0, "PlasticGloss")
    bezel(
        part,
        face,
        rounded(0.144, 0.170, 0.018, 6),
        rounded(0.1395, 0.1655, 0.016, 6),
        -0.002,
        0.0022,
        0.001,
        "MetalSatin",
    )
