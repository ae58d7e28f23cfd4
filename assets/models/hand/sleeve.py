"""Forearm: the cuff of the glove and a jacket sleeve from the wrist towards the elbow."""
import numpy as np

from hand.glove import on_cuff


def oval(centre, across, up, half_w, half_h, n):
    """Ring in the plane of two unit vectors; superellipse of exponent 2.3."""
    a = 2 * np.pi * np.arange(n + 1) / n
    shape = lambda v: np.sign(v) * np.abs(v) ** (2 / 2.3)  # noqa: E731
    return centre + half_w * shape(np.cos(a))[:, None] * across + half_h * shape(np.sin(a))[:, None] * up


def tube(stations, start, along, across, n, uv_scale):
    """Skin over ovals at stations (distance, half width, half height). Seam vertices are doubled for the uv."""
    up = np.cross(along, across)
    rings = [oval(start + along * d, across, up, w, h, n) for d, w, h in stations]
    positions = np.concatenate(rings)
    round_length = 2 * np.pi * stations[len(stations) // 2][1]
    uv = [((i / n) * round_length * uv_scale, d * uv_scale) for d, _, _ in stations for i in range(n + 1)]
    triangles = []
    for j in range(len(stations) - 1):
        for i in range(n):
            a, b = j * (n + 1) + i, j * (n + 1) + i + 1
            triangles += [(a, b, b + n + 1), (a, b + n + 1, a + n + 1)]
    return {"positions": positions, "uv": np.array(uv), "triangles": np.array(triangles)}


def folds(distance):
    """Additional half size [m] from the creases near the cuff."""
    return 0.0028 * np.sin(150 * distance + 2.2 * np.sin(31 * distance)) * np.exp(-distance / 0.11)


def glove_cuff(start, along, across):
    profile = ((-0.012, 0.0290, 0.0225), (-0.010, 0.0312, 0.0246), (0.010, 0.0322, 0.0260), (0.024, 0.0340, 0.0280))
    profile += ((0.026, 0.0335, 0.0275), (0.020, 0.0300, 0.0250))
    n = 28
    mesh = tube(profile, start, along, across, n, 1.0)
    mesh["uv"] = np.array([on_cuff(i / n, (d + 0.012) / 0.038) for d, _, _ in profile for i in range(n + 1)])
    return mesh


def jacket(start, along, across, length):
    stations = [(0.024, 0.0300, 0.0250), (0.018, 0.0360, 0.0305), (0.0165, 0.0375, 0.0320), (0.0185, 0.0390, 0.0335)]
    for d in np.linspace(0.028, length, 22):
        k = d / length
        stations.append((d, 0.0385 + 0.0125 * k + folds(d), 0.0335 + 0.0145 * k + folds(d + 0.004)))
    end_w, end_h = stations[-1][1:]
    for d, k in ((0.016, 0.93), (0.026, 0.72), (0.030, 0.02)):  # the sleeve is closed at the elbow
        stations.append((length + d, end_w * k, end_h * k))
    return tube(stations, start, along, across, 32, 10.0)
