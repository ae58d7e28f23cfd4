"""Clutch, brake and accelerator, hanging from their pivots, and the footrest."""
from cabin.dimensions import PEDAL_PAD, PEDAL_PIVOT, PEDALS
from craft.geometry import frame, rounded, smooth_path
from craft.part import Part


def build():
    for name, (x, w, h) in PEDALS.items():
        build_pedal(name, x, w, h)
    build_footrest()


def build_pedal(name, x, w, h):
    is_throttle = name == "Throttle"
    (py, pz), (y, z) = PEDAL_PIVOT, PEDAL_PAD
    if is_throttle:
        y, z = y + 0.035, z - 0.015
    part = Part("Pedal" + name, (x, py, pz), "Cabin")
    bends = [(x, py, pz), (x, py - 0.015, pz - 0.09), (x, py - 0.012, pz - 0.16), (x, y + 0.012, z + 0.02)]
    part.tube(smooth_path(bends + [(x, y + 0.010, z)], 2), 0.0095, "MetalSatin", n=8)
    part.tube([(x - 0.022, py, pz), (x + 0.022, py, pz)], 0.014, "PlasticHard", n=16)
    F = frame((x, y, z), 42 if is_throttle else 34)
    part.panel(F, rounded(w, h, 0.010), -0.006, 0.003, "MetalSatin", bevel=0.002, seg=1)
    part.panel(F, rounded(w - 0.008, h - 0.008, 0.008), 0, 0.007, "PlasticSoft", bevel=0.002, seg=1)
    ribs = 8 if is_throttle else 5
    for i in range(ribs):
        rib = rounded(w - 0.022, 0.0045, 0.002, n=2, cy=(i - (ribs - 1) / 2) * (h - 0.02) / ribs)
        part.panel(F, rib, 0.006, 0.0095, "MetalSatin", bevel=0)
    part.build()


def build_footrest():
    part = Part("Footrest", parent="Cabin")
    F = frame((-0.28, 0.82, -0.15), 38)
    part.panel(F, rounded(0.09, 0.22, 0.015), -0.04, 0.0, "PlasticSoft", bevel=0.006)
    for i in range(6):
        rib = rounded(0.066, 0.007, 0.003, n=2, cy=-0.08 + i * 0.032)
        part.panel(F, rib, -0.002, 0.003, "PlasticHard", bevel=0.001, seg=1)
    part.build()
