"""Pictures of leaves with holes between them, drawn leaf by leaf: a bough of a broad-leaved tree and a whole spruce."""
from math import cos, pi, sin

import numpy as np
from PIL import Image, ImageDraw

OVER = 2  # supersampling
# sRGB colours of the transparent texels. They matter because coarser mip levels mix them with the leaves.
GROUND = {"bough": (58, 84, 32), "spruce": (36, 58, 38)}


def sheet(size, ground):
    return Image.new("RGBA", (size[0] * OVER, size[1] * OVER), (*ground, 0))


def finished(picture, size, ground):
    """Resizes a picture and restores the ground under the holes: black there would be mixed into coarser mips."""
    pixels = np.array(picture.resize(size, Image.LANCZOS))
    pixels[pixels[..., 3] < 8, :3] = ground
    return Image.fromarray(pixels)


def shade(colour, k):
    return tuple(int(np.clip(c * k, 0, 255)) for c in colour) + (255,)


def leaf(draw, x, y, length, width, angle, colour):
    c, s = cos(angle), sin(angle)
    outline = ((0, 0), (0.35, 0.5), (0.7, 0.4), (1, 0), (0.7, -0.4), (0.35, -0.5))
    draw.polygon([(x + a * length * c - b * width * s, y + a * length * s + b * width * c) for a, b in outline], colour)


def bough(side, random):
    """A lobed tuft of leaves: dark inside and below, light above."""
    picture = sheet((side, side), GROUND["bough"])
    draw, n = ImageDraw.Draw(picture), side * OVER
    lobes = random.random(3) * 2 * pi
    count = 2600
    for i in range(count):
        a, out = random.random() * 2 * pi, random.random() ** 0.5
        reach = 0.42 * (1 + 0.10 * sin(3 * a + lobes[0]) + 0.07 * sin(5 * a + lobes[1]) + 0.05 * sin(9 * a + lobes[2]))
        x, y = 0.5 + out * reach * cos(a), 0.5 + out * reach * sin(a)
        light = 0.45 + 0.55 * i / count + 0.35 * (0.5 - y) + 0.12 * random.standard_normal()
        green = (74 + 22 * random.random(), 108 + 10 * random.random(), 38)
        leaf(draw, x * n, y * n, n * 0.042, n * 0.026, random.random() * 2 * pi, shade(green, light))
    return finished(picture, (side, side), GROUND["bough"])


def spruce(width, height, random):
    """Boughs hanging from a stem, from the ground to the tip; drawn from below, so that upper ones overlap them."""
    picture = sheet((width, height), GROUND["spruce"])
    draw, w, h = ImageDraw.Draw(picture), width * OVER, height * OVER
    draw.line([(w / 2, h * 0.05), (w / 2, h)], (58, 46, 36, 255), int(w * 0.02))
    tiers = 40
    for k in range(tiers):
        t = 1 - k / (tiers - 1)  # 1 at the ground, 0 at the tip
        top, reach = h * (0.015 + 0.87 * t), w * (0.02 + 0.46 * t**0.85)
        for side in (-1, 1):
            for j in range(2):
                length = reach * (1 - 0.32 * random.random()) * (1 if j == 0 else 0.6)
                hang = length * (0.30 + 0.25 * random.random())
                for step in np.linspace(0.02, 1, 44):
                    x = w / 2 + side * length * step
                    y = top + hang * step**1.5 + h * 0.006 * random.standard_normal()
                    light = 0.50 + 0.45 * step + 0.18 * random.standard_normal()
                    needle = h * 0.026 * (1.15 - 0.7 * step)
                    turn = pi / 2 - side * (0.5 + 0.5 * random.random())
                    leaf(draw, x, y, needle, needle * 0.34, turn, shade((50, 78, 48), light))
    return finished(picture, (width, height), GROUND["spruce"])
