"""Gate plate frame, boot, and the lever: rod, collar, knob and its cap."""
import math
from math import cos, pi, sin

from mathutils import Matrix, Vector

from cabin.dimensions import (
    GATE_INSERT_DEPTH,
    GATE_OPENING,
    GATE_OUTER,
    GATE_Z,
    KNOB_CENTRE,
    KNOB_D,
    LEVER_LENGTH,
    LEVER_PIVOT,
)
from craft import scene
from craft.geometry import at, frame, lerp, rounded, smooth_path
from craft.part import Part

GATE = Matrix.Translation((LEVER_PIVOT.x, LEVER_PIVOT.y, GATE_Z))
GATE_FACE = frame((LEVER_PIVOT.x, LEVER_PIVOT.y, GATE_Z), 90)  # faces up; its y axis points down, its z axis forward
BOOT_HEIGHT = KNOB_CENTRE.z - 0.032 - GATE_Z
CAP_R = 0.0167


def build():
    build_gate_frame()
    build_boot()
    build_lever()


def grown(size, by, r):
    return rounded(size[0] + by, size[1] + by, r + by / 2, 6)


def build_gate_frame():
    """Open frame; the stage builds the loaded gate's slotted insert at GateMount."""
    part = Part("GatePlate", GATE, "Console", smooth=30)
    outlines = (
        (grown(GATE_OUTER, 0, 0.018), -0.006),
        (grown(GATE_OUTER, 0, 0.018), -0.0014),
        (grown(GATE_OUTER, -0.0028, 0.018), 0),
        (grown(GATE_OPENING, 0.0016, 0.010), 0),
        (grown(GATE_OPENING, 0, 0.010), -0.0008),
        (grown(GATE_OPENING, 0, 0.010), -0.010),
    )
    part.loft([[at(GATE_FACE, x, d, z) for x, z in o] for o, d in outlines], "MetalSatin", caps=False)
    screw = [(0.0030, 0), (0.0030, 0.0006), (0.0024, 0.0010), (0.0010, 0.0010), (0.0008, 0.0002), (0.0001, 0.0002)]
    for sx in (-1, 1):
        for sz in (-1, 1):
            S = GATE_FACE @ Matrix.Translation((sx * 0.0565, 0, sz * 0.0605))
            part.lathe(S, screw, "PlasticGloss", n=10)
    part.build()
    scene.empty("GateMount", GATE, "Console")


def boot_ring(t, base):
    """Ring at height fraction t: from the rounded rectangle `base` to a circle, with hanging folds and creases."""
    ring = []
    envelope = sin(pi * min(1, t * 1.02)) ** 0.7 if 0 < t < 0.98 else 0
    phase = 3.2 * t**0.9
    for bx, by in base:
        a = math.atan2(by, bx)
        k = 1 - (1 - t) ** 0.80
        r = math.hypot(lerp(bx, 0.0115 * cos(a), k), lerp(by, 0.0115 * sin(a), k))
        wave = phase + 0.10 * sin(2 * a + 1) + 0.05 * sin(5 * a)
        fold = 0.0042 * envelope * sin(2 * pi * wave)
        crease = 0.0016 * envelope * (abs(sin(2 * a + 0.25 * sin(9 * t))) ** 0.5 - 0.6)
        crease += 0.0009 * envelope * sin(11 * a + 8 * t)
        r = max(0.0112, r + fold + crease)
        z = BOOT_HEIGHT * (0.06 + 0.94 * t**1.12) if t else 0
        z -= 0.0022 * envelope * cos(2 * pi * phase) + GATE_INSERT_DEPTH * (1 - min(1, t * 6))
        ring.append((LEVER_PIVOT.x + r * cos(a), LEVER_PIVOT.y + r * sin(a), GATE_Z + z))
    return ring


def build_boot(rings=21):
    part = Part("Boot", GATE, "Console", smooth=70)
    base = rounded(0.090, 0.098, 0.020, 10)
    part.loft([boot_ring(k / (rings - 1), base) for k in range(rings)], "Leather", caps=False)
    part.build()
    ring = Part("BootRing", GATE, "Boot")
    outer, inner = rounded(0.0984, 0.1064, 0.0098, 6), rounded(0.086, 0.094, 0.016, 6)
    outlines = ((outer, -0.003), (outer, -0.0008), (outer, 0.0012), (inner, 0.0022), (inner, -0.003))
    rings = [[at(GATE_FACE, x, d, z) for x, z in o] for o, d in outlines]
    ring.loft(rings, "PlasticGloss", caps=False, bevel=0.0006, seg=1)
    ring.build()


def above_pivot(h):
    return frame(LEVER_PIVOT + Vector((0, 0, h)), 90)


def build_lever():
    scene.empty("LeverPivot", LEVER_PIVOT, "Console")
    rod = Part("LeverRod", LEVER_PIVOT, "LeverPivot")
    rod_profile = [(0.0005, -0.02), (0.006, -0.02), (0.006, 0.060), (0.0055, LEVER_LENGTH - 0.020)]
    rod.lathe(above_pivot(0), rod_profile, "MetalSatin", n=20)
    rod.build()
    collar = Part("LeverCollar", LEVER_PIVOT, "LeverPivot")
    profile = [(0.0095, -0.002), (0.0125, -0.0015), (0.0132, 0.0005), (0.0128, 0.0035), (0.0105, 0.0065)]
    collar.lathe(above_pivot(LEVER_LENGTH - 0.0335), profile + [(0.0098, 0.009)], "MetalSatin", n=32)
    collar.build()
    build_knob()


def build_knob():
    K, R = above_pivot(LEVER_LENGTH), KNOB_D / 2
    part = Part("Knob", KNOB_CENTRE, "LeverPivot", smooth=50)
    profile = [(0.0085, -0.027), (0.0105, -0.0265), (0.0128, -0.0235), (0.0165, -0.0165), (0.0205, -0.008)]
    profile += [(0.0232, 0.000), (R, 0.006), (0.0232, 0.0115), (0.0215, 0.0158), (0.0188, 0.0188), (0.0180, 0.0192)]
    part.lathe(K, [(p.x, p.y) for p in smooth_path([(r, d, 0) for r, d in profile], 2)], "Leather", n=26)
    ring = [(0.0186, 0.0180), (0.0186, 0.0196), (0.0178, 0.0204), (0.0168, 0.0200), (0.0165, 0.0190)]
    part.lathe(K, ring, "MetalSatin", n=40)
    part.build()
    build_cap(K)


def build_cap(K):
    """Domed disc with uv0 over [0,1]^2: u right, v (glTF) down, v = 0 in front."""
    part = Part("KnobCap", KNOB_CENTRE + Vector((0, 0, 0.0194)), "Knob", smooth=50)
    profile = ((CAP_R, 0.0194), (0.013, 0.0203), (0.008, 0.0210), (0.0004, 0.0213))
    angles = [2 * pi * i / 40 for i in range(40)]
    rings = [[at(K, r * cos(a), d, r * sin(a)) for a in angles] for r, d in profile]
    part.loft(rings, "KnobCap", caps=False, prints=((0, 0, 1, 1), K, 2 * CAP_R, 2 * CAP_R))
    part.build()
