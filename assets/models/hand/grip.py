"""Bends the fingers of the open hand around the knob.

Hand frame: origin at the wrist, X to the little finger, Y out of the back of the hand, -Z to the fingertips. Bending a
joint towards the palm is a negative turn about its X.
"""
from itertools import product

import numpy as np

KNOB_R = 0.0245  # [m] radius of the ball around which the fingers close
KNOB = np.array([-0.004, -0.0395, -0.078])  # centre of the knob, under the palm
THUMB_TIP = KNOB + np.array([-0.030, -0.008, -0.010])  # target of the thumb's tip, on the knob's side
FINGERS = {  # by name: radii of the three phalanges [m]; range of the sideways turn at the finger's root [deg]
    "index": ((0.0098, 0.0088, 0.0080), (-8, 6)),
    "middle": ((0.0098, 0.0088, 0.0080), (-5, 7)),
    "ring": ((0.0092, 0.0084, 0.0076), (0, 14)),
    "pinky": ((0.0085, 0.0076, 0.0070), (6, 22)),
}
PHALANGES = ("phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")


def turn(axis, degrees):
    """Rotation about X (0), Y (1) or Z (2), 4 x 4."""
    a = np.radians(degrees)
    m = np.eye(4)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    m[i, i] = m[j, j] = np.cos(a)
    m[i, j], m[j, i] = -np.sin(a), np.sin(a)
    return m


def chain(bind, names, angles):
    """World matrices of a chain of joints; angles: (bend, sideways turn) [deg] per joint."""
    out, parent, rest = [], None, None
    for name, (bend, side) in zip(names, angles):
        local = bind[name] if parent is None else np.linalg.inv(rest) @ bind[name]
        world = (local if parent is None else parent @ local) @ turn(1, side) @ turn(0, -bend)
        out.append(world)
        parent, rest = world, bind[name]
    return out


def gaps(points, radii):
    """Distances from the skin of each phalanx to the knob, first at its middle, then at its end."""
    out = []
    for a, b, r in zip(points, points[1:], radii):
        for p in ((a + b) / 2, b):
            out.append(np.linalg.norm(p - KNOB) - KNOB_R - r)
    return np.array(out)


def cost(gap, weights):
    """Penalty for skin that is away from the knob or inside it."""
    return np.sum(weights * np.where(gap < 0, 9.0, 1.0) * gap**2)


def best(candidates, evaluate):
    return min(candidates, key=evaluate)


def finger_pose(bind, name, radii, sides):
    names = ["%s-finger-%s" % (name, p) for p in PHALANGES]
    weights = np.array([0.3, 0.3, 1.0, 1.0, 1.5, 1.5])

    def matrices(c):
        root, middle, side = c
        return chain(bind, names, ((root, side), (middle, 0), (0.55 * middle, 0), (0, 0)))

    def evaluate(c):
        points = [m[:3, 3] for m in matrices(c)]
        return cost(gaps(points, radii), weights) + 1e-9 * (c[0] - 50) ** 2 + 4e-9 * c[2] ** 2

    grid = product(range(0, 91, 3), range(6, 106, 3), np.linspace(*sides, 5))
    return names, matrices(best(grid, evaluate))


def thumb_pose(bind):
    names = ["thumb-" + p for p in ("metacarpal", "phalanx-proximal", "phalanx-distal", "tip")]
    radii, weights = (0.0130, 0.0105, 0.0095), np.array([0.1, 0.3, 1.0, 1.0, 1.5, 1.5])

    def matrices(c):
        spread, root, middle, end = c
        return chain(bind, names, ((root, spread), (middle, 0), (end, 0), (0, 0)))

    def evaluate(c):
        points = [m[:3, 3] for m in matrices(c)]
        away = np.sum((points[3] - THUMB_TIP) ** 2)
        return cost(gaps(points, radii), weights) + 2e-9 * (c[0] ** 2 + c[1] ** 2) + 0.5 * away

    grid = product(range(-24, 25, 6), range(-20, 41, 5), range(-10, 61, 5), range(0, 71, 7))
    return names, matrices(best(grid, evaluate))


def closed(bind):
    """World matrices (hand frame) of all joints in the grip. bind: those of the open hand."""
    pose = dict(bind)
    for name, (radii, sides) in FINGERS.items():
        names, matrices = finger_pose(bind, name, radii, sides)
        pose.update(zip(names, matrices))
    names, matrices = thumb_pose(bind)
    pose.update(zip(names, matrices))
    return pose
