"""Frames, outlines and curves. Blender axes: x right, y forward, z up, metres."""
import math
from math import cos, pi, radians, sin

from mathutils import Matrix, Vector


def lerp(a, b, t):
    return a + (b - a) * t


def interpolate(table, t):
    """Piecewise linear through [(t, value)], held at both ends."""
    if t <= table[0][0]:
        return table[0][1]
    for (a, va), (b, vb) in zip(table, table[1:]):
        if t <= b:
            return lerp(va, vb, (t - a) / (b - a))
    return table[-1][1]


def frame(origin, tilt=0.0, yaw=0.0, roll=0.0):
    """Frame of a panel: x right, y into it, z up. tilt > 0 [deg] turns its face upwards, yaw > 0 to its left."""
    turn = Matrix.Rotation(radians(yaw), 4, "Z") @ Matrix.Rotation(radians(-tilt), 4, "X")
    return Matrix.Translation(Vector(origin)) @ turn @ Matrix.Rotation(radians(roll), 4, "Y")


def face_frame(origin, normal):
    """Frame whose face (-y) looks along `normal`, z as upright as possible."""
    y = -Vector(normal).normalized()
    x = y.cross(Vector((0, 0, 1))).normalized()
    m = Matrix((x, y, x.cross(y))).transposed().to_4x4()
    m.translation = Vector(origin)
    return m


def side_frame(origin, side):
    """Frame of a side wall seen from the cabin: side -1 the left wall, +1 the right one."""
    return Matrix.Translation(Vector(origin)) @ Matrix.Rotation(radians(-90 * side), 4, "Z")


def at(F, x, depth, z):
    """The world point at (x, z) of a frame, `depth` towards the viewer."""
    return tuple(F @ Vector((x, -depth, z)))


def rounded(w, h, r, n=3, cx=0, cy=0):
    """Rounded rectangle, counter-clockwise, 4 * (n + 1) points."""
    points = []
    for k, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for i in range(n + 1):
            a = pi / 2 * (k + i / n)
            points.append((cx + sx * (w / 2 - r) + r * cos(a), cy + sy * (h / 2 - r) + r * sin(a)))
    return points


def circle(r, n, cx=0, cy=0):
    return [(cx + r * cos(2 * pi * i / n), cy + r * sin(2 * pi * i / n)) for i in range(n)]


def level_circle(x, y, z, r, n):
    return [(x + r * cos(2 * pi * i / n), y + r * sin(2 * pi * i / n), z) for i in range(n)]


def super_power(v, p):
    """Signed power, for superellipses of exponent p."""
    return math.copysign(abs(v) ** (2 / p), v)


def superellipse(half_w, half_h, p, n):
    angles = [2 * pi * i / n for i in range(n)]
    return [(half_w * super_power(cos(a), p), half_h * super_power(sin(a), p)) for a in angles]


def smooth_path(points, n):
    """Catmull-Rom curve through the points, n points per span."""
    P = [Vector(p) for p in points]
    P = [2 * P[0] - P[1]] + P + [2 * P[-1] - P[-2]]
    out = []
    for i in range(1, len(P) - 2):
        a, b, c, d = P[i - 1 : i + 3]
        for k in range(n):
            t = k / n
            out.append(
                0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3)
            )
    return out + [P[-2]]


def bump(x, centre, width):
    """Gaussian bump of height 1."""
    return math.exp(-(((x - centre) / width) ** 2))
