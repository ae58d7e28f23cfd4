"""Tiling textures from noise: grain of plastic, leather, felt, asphalt, weave of fabric, stitches."""
import os

import numpy as np
from PIL import Image

FOLDER = None  # folder for the textures; build.py sets it
_random = np.random.default_rng(7)


def restart():
    """Resets the random generator, so that a model's noise does not depend on what was built before it."""
    global _random
    _random = np.random.default_rng(7)


def band_noise(n, low, high):
    """Tiling noise with spatial frequencies of about low..high cycles per tile, mean 0, standard deviation 1."""
    k = np.hypot(*np.meshgrid(np.fft.fftfreq(n) * n, np.fft.fftfreq(n) * n))
    band = np.exp(-(((k - (low + high) / 2) / ((high - low) / 2)) ** 2))
    h = np.fft.ifft2(np.fft.fft2(_random.standard_normal((n, n))) * band).real
    return (h - h.mean()) / h.std()


def cells(n, count):
    """Tiling Worley noise: distance [px] to the border between the two nearest of `count` points."""
    y, x = np.mgrid[0:n, 0:n]
    near = np.full((n, n), 1e9)
    second = near.copy()
    for px, py in _random.random((count, 2)) * n:
        dx, dy = np.abs(x - px), np.abs(y - py)
        d = np.minimum(dx, n - dx) ** 2 + np.minimum(dy, n - dy) ** 2
        second = np.minimum(second, np.maximum(near, d))
        near = np.minimum(near, d)
    return np.sqrt(second) - np.sqrt(near)


def save(name, array):
    path = os.path.join(FOLDER, name)
    Image.fromarray(np.clip(array, 0, 255).astype(np.uint8)).save(path, optimize=True)
    return path


def normal_map(name, height, strength):
    """Tangent space normals (+Y up) of a tiling height field."""
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * strength
    dy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) * strength
    n = np.dstack((-dx, dy, np.ones_like(height)))
    n /= np.linalg.norm(n, axis=2, keepdims=True)
    return save(name, n * 127.5 + 128)


def leather():
    grain = -np.exp(-cells(512, 900) / 3.0) * 1.4
    return normal_map("leather_n.png", grain + 0.12 * band_noise(512, 40, 90), 0.55)


def plastic():
    grain = -np.exp(-cells(256, 900) / 1.6)
    return normal_map("plastic_n.png", grain + 0.25 * band_noise(256, 40, 80), 0.35)


def felt():
    return normal_map("felt_n.png", band_noise(256, 20, 110), 0.22)


def fabric():
    """Basket weave of 16 x 16 threads with a faint coloured check. Returns (colour, normal map)."""
    n = 256
    y, x = np.mgrid[0:n, 0:n] * (2 * np.pi / n)
    warp_up = np.sin(8 * x) * np.sin(8 * y) > 0
    h = np.where(warp_up, np.abs(np.sin(16 * x)), np.abs(np.sin(16 * y))) + 0.18 * band_noise(n, 30, 90)
    shade = 66 + 12 * (h - h.mean()) + 4 * band_noise(n, 3, 14)
    shade = shade + np.where(warp_up, 6, 0)
    colour = save("fabric_c.png", np.dstack((shade * 1.02, shade, shade * 0.99)))
    return colour, normal_map("fabric_n.png", h, 0.5)


def stitches():
    """One stitch per tile along u: red thread over dark cloth."""
    u, v = np.meshgrid((np.arange(32) + 0.5) / 32, (np.arange(16) + 0.5) / 16)
    thread = np.clip(1.3 - (np.abs(u - 0.5) / 0.38) ** 6 - (np.abs(v - 0.5) / 0.36) ** 4, 0, 1)[..., None]
    cloth, red = np.array([20, 19, 19.0]), np.array([176, 36, 28.0])
    return save("stitch_c.png", cloth + (red - cloth) * thread)


def knob_cap():
    """The knob's neutral cap: dark disc with faint turned rings; the stage replaces it with its gate's shift pattern."""
    n = 128
    y, x = np.mgrid[0:n, 0:n] - (n - 1) / 2
    r = np.hypot(x, y) / (n / 2)
    shade = 24 + 2.5 * np.sin(r * 90)
    return save("knob_cap.png", np.dstack((shade, shade, shade * 1.03)))
