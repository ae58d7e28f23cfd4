"""The picture of a driving glove in the hand's own uv, painted by each texel's position on the open hand.

Hand frame in millimetres: origin at the wrist, x to the little finger, y out of the back of the hand, -z to the
fingertips. Picture rows run downwards, like glTF's v.
"""
import os

import numpy as np
from PIL import Image

from craft import textures

SIDE = 1024  # px
LEATHER, SKIN, THREAD, STEEL = (47, 36, 31), (182, 126, 98), (196, 170, 130), (170, 172, 176)  # sRGB
# The cuff's area in the picture: u0, v0, u1, v1, outside the hand's UV islands; u runs around the wrist, v along it.
CUFF = (0.02, 0.02, 0.46, 0.115)
FINGERS = ("index", "middle", "ring", "pinky")
# The glove's opening on the back of the hand: centre and half axes in x and z [mm].
OPENING = (np.array([1.0, -25.0]), np.array([9.5, 17.0]))


def texels(hand):
    """Rows, columns, positions [mm] and normals of the texels covered by the hand's triangles, plus a border of two."""
    p, uv = hand["positions"] * 1e3, hand["uv"] * SIDE
    normals = np.zeros_like(p)
    out = []
    t = hand["triangles"]
    face = np.cross(p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]])
    for k in range(3):
        np.add.at(normals, t[:, k], face)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    for tri in t:
        a, b, c = uv[tri]
        low, high = np.floor(uv[tri].min(0)).astype(int) - 2, np.ceil(uv[tri].max(0)).astype(int) + 2
        y, x = np.mgrid[low[1] : high[1] + 1, low[0] : high[0] + 1]
        edges = np.array([b - a, c - a]).T
        size = abs(np.linalg.det(edges))
        if size < 1e-9:
            continue
        w = (np.stack([x + 0.5, y + 0.5], -1) - a) @ np.linalg.inv(edges).T
        w = np.concatenate([1 - w.sum(-1, keepdims=True), w], -1)
        rim = 2 * np.linalg.norm(edges, axis=0).max() / size  # two texels, in barycentric coordinates
        inside = (w.min(-1) >= -rim) & (y >= 0) & (y < SIDE) & (x >= 0) & (x < SIDE)
        weights = np.clip(w[inside], 0, 1)
        out.append((y[inside], x[inside], weights @ p[tri], weights @ normals[tri], w[inside].min(-1)))
    rows, columns, places, turned, depth = (np.concatenate(k) for k in zip(*out))
    # Sorted by depth inside the triangle: where triangles share a texel, the one that contains it most deeply writes
    # last.
    order = np.argsort(depth)
    return rows[order], columns[order], places[order], turned[order]


class Painter:
    def __init__(self, places, normals):
        self.x, self.z, self.is_back = places[:, 0], places[:, 2], normals[:, 1] > 0.1
        grain = np.random.default_rng(4).standard_normal(len(places))
        self.colour = np.array(LEATHER) * (1 + 0.035 * grain[:, None])

    def lay(self, where, colour, share=1.0):
        share = (np.clip(where, 0, 1) * self.is_back * share)[:, None]
        self.colour += share * (np.array(colour) - self.colour)

    def hole(self, centre, half):
        """An opening that shows skin, its leather rim, and a ring of stitches."""
        dx, dz = (self.x - centre[0]) / half[0], (self.z - centre[1]) / half[1]
        d, mean = np.hypot(dx, dz), half.mean()
        self.lay((1 - d) * mean / 0.4, SKIN)
        self.lay((1 - d) * mean / 0.4 * (d > 0.72), np.array(SKIN) * 0.62, 0.8)
        self.lay(1.4 - np.abs((d - 1) * mean - 0.7) / 0.6, np.array(LEATHER) * 0.45)
        around = np.arctan2(dz, dx)
        dashes = np.cos(around * round(2 * np.pi * mean / 3.0)) > -0.25
        self.lay(1.3 - np.abs((d - 1) * mean - 2.4) / 0.45, THREAD, dashes)

    def seam(self, start, end, width=0.55):
        """Dashes of thread on a dark line."""
        along = end - start
        length = np.linalg.norm(along)
        along = along / length
        dx, dz = self.x - start[0], self.z - start[1]
        t = dx * along[0] + dz * along[1]
        off = np.abs(dx * along[1] - dz * along[0])
        within = (t > 0) & (t < length)
        self.lay(1.5 - off / 1.1, np.array(LEATHER) * 0.5, within)
        self.lay(1.4 - off / width, THREAD, within & (np.mod(t, 3.2) < 2.1))

    def dots(self, start, end):
        """Three rows of ventilation holes along a finger."""
        along = (end - start) / np.linalg.norm(end - start)
        across = np.array([-along[1], along[0]])
        for t in np.linspace(0.36, 0.80, 5):
            for k in (-3.4, 0, 3.4):
                at = start + t * (end - start) + k * across
                self.lay(1.3 - np.hypot(self.x - at[0], self.z - at[1]) / 0.65, np.array(LEATHER) * 0.2)


def painted_hand(hand):
    rows, columns, places, normals = texels(hand)
    painter = Painter(places, normals)
    joint = {n: m[:3, 3][[0, 2]] * 1e3 for n, m in hand["bind"].items()}
    knuckles = [joint[f + "-finger-phalanx-proximal"] for f in FINGERS]
    for a, b in zip(knuckles, knuckles[1:]):  # seams that run from between the knuckles to the opening
        middle = (a + b) / 2
        away = OPENING[0] + np.array([0.25 * middle[0], -OPENING[1][1] - 3.0])
        painter.seam(middle + (away - middle) * 0.10, middle + (away - middle) * 0.80)
    for f, knuckle in zip(FINGERS, knuckles):
        painter.dots(knuckle, joint[f + "-finger-phalanx-intermediate"])
        painter.hole(knuckle + np.array([0, 1.5]), np.array([5.0, 6.2]) if f == "pinky" else np.array([6.0, 7.6]))
    painter.hole(*OPENING)
    return rows, columns, painter.colour


def paint_cuff(picture):
    """Leather between two seams, with a strap and snap fastener over the back of the wrist."""
    u0, v0, u1, v1 = (round(c * SIDE) for c in CUFF)
    v, u = np.mgrid[0 : v1 - v0, 0 : u1 - u0]
    x, y = u / (u1 - u0) * 200.0, v / (v1 - v0) * 38.0  # [mm] around the wrist and along it
    colour = np.array(LEATHER) * (1 + 0.035 * np.random.default_rng(5).standard_normal(x.shape))[..., None]
    dark = np.array(LEATHER) * 0.5

    def lay(where, paint):
        colour[where] = paint

    for line in (13.0, 27.0):
        lay(np.abs(y - line) < 1.2, dark)
        lay((np.abs(y - line) < 0.6) & (np.mod(x, 3.2) < 2.1), THREAD)
    off = np.hypot(x - 50.0, y - 20.0)
    lay(off < 5.2, dark)
    lay(off < 4.2, STEEL)
    lay((off > 2.4) & (off < 3.0), np.array(STEEL) * 0.55)
    picture[v0:v1, u0:u1] = colour


def draw(hand):
    """Saves the picture and returns its path."""
    picture = np.tile(np.array(LEATHER, float), (SIDE, SIDE, 1))
    paint_cuff(picture)
    rows, columns, colour = painted_hand(hand)
    picture[rows, columns] = colour
    path = os.path.join(textures.FOLDER, "glove.jpg")
    Image.fromarray(np.clip(picture, 0, 255).astype(np.uint8)).save(path, quality=90)
    return path


def on_cuff(around, along):
    """uv of a point on the cuff, given as fractions around and along it."""
    u0, v0, u1, v1 = CUFF
    return u0 + (u1 - u0) * around, v0 + (v1 - v0) * along
