"""One picture for all roadside objects: a speed sign, cells of plain colour below it, a spruce and a bough."""
import os

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from craft import textures
from craft.prints import FONT
from road import foliage

WIDTH, HEIGHT, CELL = 1024, 512, 32
SIGN = (0.0, 0.5, 0.25, 1.0)  # UV rectangles (u0, v0, u1, v1), v upwards
SPRUCE = (0.252, 0.004, 0.498, 0.996)
BOUGH = (0.502, 0.004, 0.998, 0.996)
CELLS = {  # sRGB
    "paint": (226, 226, 220),
    "steel": (150, 154, 158),
    "white": (232, 232, 228),
    "black": (22, 22, 24),
    "red": (176, 32, 26),
    "orange": (224, 120, 26),
    "bark": (74, 58, 44),
    "shade": (40, 60, 24),
    "plaster": (214, 202, 178),
    "plaster_b": (188, 150, 108),
    "tiles": (132, 62, 44),
    "wood": (96, 66, 44),
    "barn": (112, 44, 34),
    "pane": (38, 46, 56),
    "stone": (128, 124, 116),
    "earth": (98, 88, 66),
    "hay": (176, 152, 92),
    "field_a": (120, 128, 66),
    "field_b": (148, 140, 84),
    "field_c": (92, 112, 56),
    "wood_near": (72, 92, 68),
    "wood_mid": (108, 128, 122),
    "wood_far": (146, 164, 176),
    "grey": (92, 94, 96),
}


def cell_middle(name):
    """uv of a colour's cell, v upwards."""
    k = list(CELLS).index(name)
    column, row = k % 8, k // 8
    return CELL * (column + 0.5) / WIDTH, 1 - (256 + CELL * (row + 0.5)) / HEIGHT


def draw():
    picture = Image.new("RGBA", (WIDTH, HEIGHT), (120, 120, 120, 255))
    draw = ImageDraw.Draw(picture)
    for k, colour in enumerate(CELLS.values()):
        x, y = CELL * (k % 8), 256 + CELL * (k // 8)
        draw.rectangle([x, y, x + CELL - 1, y + CELL - 1], fill=colour)
    draw.ellipse([0, 0, 255, 255], fill=(190, 26, 24))
    draw.ellipse([34, 34, 221, 221], fill=(238, 238, 234))
    draw.text((128, 130), "80", font=ImageFont.truetype(FONT, 112), fill=(24, 24, 26), anchor="mm")
    random = np.random.default_rng(3)
    picture.paste(foliage.spruce(256, 512, random), (256, 0))
    picture.paste(foliage.bough(512, random), (512, 0))
    path = os.path.join(textures.FOLDER, "roadside.png")
    picture.save(path, optimize=True)
    return path


def asphalt():
    """Colour and normal map of a 3 m tile: stones in bitumen, without wheel tracks."""
    n = 512
    grain = textures.band_noise(n, 60, 220)
    shade = 74 + 9 * grain + 2.2 * textures.band_noise(n, 2, 9)
    stones = textures.band_noise(n, 90, 160) > 1.9
    shade = np.where(stones, shade + 34, shade)
    colour = textures.save("asphalt_c.png", np.dstack((shade, shade * 0.995, shade * 0.975)))
    return colour, textures.normal_map("asphalt_n.png", grain, 0.30)


def blades(name, tint, contrast):
    """Mottled green of grass."""
    n = 256
    h = 0.6 * textures.band_noise(n, 30, 110) + 0.5 * textures.band_noise(n, 4, 16) + 0.3 * textures.band_noise(n, 1, 4)
    k = np.clip(1 + contrast * h, 0.25, 2.2)[..., None]
    return textures.save(name, np.array(tint) * k + 4 * np.dstack((h, h * 0, -h)))
