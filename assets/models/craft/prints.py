"""The print atlas: dials, radio screen, gear characters, climate icons; base colour and emission.

2048 x 1024 px, drawn at twice the size. Rectangles are (left, top, right, bottom) in pixels, v downwards.
"""
import os
from math import cos, radians, sin

from PIL import Image, ImageDraw, ImageFont

from craft import textures

WIDTH, HEIGHT = 2048, 1024
DIAL = 672
GEARS = "RN123456789"  # one cell per character; uv0 of the gear panel covers N
GEAR_CELL = 176
GEAR_STEP = GEAR_CELL / WIDTH  # distance in u from one character's cell to the next
PIXELS = {
    "tach": (0, 0, DIAL, DIAL),
    "speed": (DIAL, 0, 2 * DIAL, DIAL),
    "screen": (1344, 0, 2048, 396),
    "climate": (1344, 400, 2048, 576),
    "hazard": (1344, 580, 1472, 644),
    "gear": (GEAR_CELL, DIAL, 2 * GEAR_CELL, DIAL + GEAR_CELL),
    "red": (1488, 580, 1552, 644),
    "amber": (1568, 580, 1632, 644),
    "green": (1648, 580, 1712, 644),
}
LAMPS = {"red": (255, 48, 39), "amber": (255, 173, 39), "green": (63, 255, 112)}  # sRGB colours of lit lamps
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"
OVER = 2  # supersampling
WHITE, GREY = (236, 238, 240), (150, 158, 166)


def rect(name):
    """(u0, v0, u1, v1) with v upwards, as in Blender."""
    a, b, c, d = PIXELS[name]
    return a / WIDTH, 1 - d / HEIGHT, c / WIDTH, 1 - b / HEIGHT


def dimmed(colour, k):
    return tuple(int(v * k) for v in colour)


class Sheet:
    """Two pictures drawn together: base colour and emission."""

    def __init__(self):
        self.base = Image.new("RGB", (WIDTH * OVER, HEIGHT * OVER), (10, 10, 11))
        self.glow = Image.new("RGB", self.base.size, (0, 0, 0))
        self.on_base, self.on_glow = ImageDraw.Draw(self.base), ImageDraw.Draw(self.glow)

    def both(self, draw, colour, glow_colour):
        draw(self.on_base, colour)
        draw(self.on_glow, glow_colour)

    def text(self, x, y, words, px, colour=WHITE, glow=0.62):
        font = ImageFont.truetype(FONT, int(px * OVER))
        at = (x * OVER, y * OVER)
        self.both(lambda d, c: d.text(at, words, font=font, fill=c, anchor="mm"), colour, dimmed(colour, glow))

    def line(self, p, q, width, colour=WHITE, glow=0.62):
        ends = [v * OVER for v in (*p, *q)]
        self.both(lambda d, c: d.line(ends, fill=c, width=int(width * OVER)), colour, dimmed(colour, glow))

    def box(self, r, colour, glow_colour, radius=0):
        corners = [r[0] * OVER, r[1] * OVER, r[2] * OVER - 1, r[3] * OVER - 1]
        self.both(lambda d, c: d.rounded_rectangle(corners, radius * OVER, fill=c), colour, glow_colour)

    def disc(self, cx, cy, r, **k):
        self.on_base.ellipse([(cx - r) * OVER, (cy - r) * OVER, (cx + r) * OVER, (cy + r) * OVER], **k)

    def arc(self, cx, cy, r, a0, a1, width, colour, glow_colour):
        """From a0 to a1 degrees, clockwise from three o'clock."""
        around = [(cx - r) * OVER, (cy - r) * OVER, (cx + r) * OVER, (cy + r) * OVER]
        self.both(lambda d, c: d.arc(around, a0, a1, fill=c, width=width * OVER), colour, glow_colour)

    def save(self):
        paths = []
        for name, picture in (("prints.png", self.base), ("prints_emit.png", self.glow)):
            paths.append(os.path.join(textures.FOLDER, name))
            picture.resize((WIDTH, HEIGHT), Image.LANCZOS).save(paths[-1], optimize=True)
        return paths


def draw_dial(sheet, name, top, major, minor, label, unit, sweep, red=None, px=44):
    """A dial of `sweep` degrees, zero at the lower left."""
    left, upper, right, lower = PIXELS[name]
    cx, cy, s = (left + right) / 2, (upper + lower) / 2, DIAL / 512
    face, scale = 248 * s, 240 * s
    for i in range(60, 0, -1):  # dark radial gradient
        v = int(9 + 13 * (1 - i / 60))
        sheet.disc(cx, cy, face * i / 60, fill=(v, v, v + 2))

    def polar(value, r):
        a = radians(90 + sweep / 2 - sweep * value / top)
        return cx + r * s * cos(a), cy - r * s * sin(a)

    if red is not None:
        a0 = 270 - sweep / 2 + sweep * red / top
        sheet.arc(cx, cy, scale, a0, 270 + sweep / 2, int(13 * s), (205, 28, 24), (150, 12, 8))
    for i in range(round(top / minor) + 1):
        value = i * minor
        is_major = i % round(major / minor) == 0
        colour = (235, 50, 40) if red is not None and value >= red - 1e-6 else WHITE
        ends = polar(value, 238), polar(value, 206 if is_major else 222)
        sheet.line(*ends, (7 if is_major else 3) * s, colour, 0.8)
        if is_major:
            sheet.text(*polar(value, 166), label(value), px * s, colour, 0.85)
    sheet.text(cx, cy + 92 * s, unit, 25 * s, GREY, 0.8)
    sheet.disc(cx, cy, face, outline=(60, 62, 66), width=int(3 * s * OVER))


def draw_map(sheet, area, at):
    """Roads across a dark ground, the way ahead in blue, an arrow for the car. at: picture's unit square -> pixels."""
    sheet.box(area, (16, 24, 30), (10, 16, 20), 10)
    roads = (((0.02, 0.62), (0.36, 0.50), (0.60, 0.10)), ((0.10, 0.16), (0.30, 0.52), (0.34, 0.96)))
    roads += (((0.30, 0.30), (0.60, 0.42)), ((0.04, 0.86), (0.60, 0.78)), ((0.46, 0.16), (0.50, 0.96)))
    for road in roads:
        for p, q in zip(road, road[1:]):
            sheet.line(at(*p), at(*q), 7, (74, 86, 94), 0.8)
    way = ((0.33, 0.80), (0.325, 0.60), (0.36, 0.50), (0.46, 0.34), (0.56, 0.17))
    for p, q in zip(way, way[1:]):
        sheet.line(at(*p), at(*q), 9, (70, 150, 240), 0.95)
    tip, left, notch, right = (
        at(0.33 + dx, 0.80 + dy) for dx, dy in ((0, -0.07), (-0.022, 0.05), (0, 0.02), (0.022, 0.05))
    )
    arrow = [(x * OVER, y * OVER) for x, y in (tip, left, notch, right)]
    sheet.both(lambda d, c: d.polygon(arrow, fill=c), (245, 248, 250), (235, 240, 245))


def draw_screen(sheet):
    """Navigation on the left, radio on the right, a row of keys below."""
    left, top, right, bottom = PIXELS["screen"]
    width, height = right - left, bottom - top
    at = lambda x, y: (left + x * width, top + y * height)  # noqa: E731
    sheet.box(PIXELS["screen"], (7, 10, 14), (4, 7, 10))
    draw_map(sheet, (*at(0.02, 0.13), *at(0.615, 0.81)), at)
    sheet.text(*at(0.07, 0.065), "12:00", 30, (225, 232, 240), 0.9)
    sheet.text(*at(0.93, 0.065), "21\N{DEGREE SIGN}C", 26, (150, 180, 210), 0.9)
    sheet.box((*at(0.64, 0.13), *at(0.98, 0.81)), (18, 24, 32), (12, 17, 23), 10)
    sheet.text(*at(0.81, 0.25), "FM", 26, (120, 165, 215), 0.9)
    sheet.text(*at(0.81, 0.42), "98.4", 66, (240, 244, 248), 0.95)
    sheet.text(*at(0.81, 0.56), "Cabin Radio", 25, (160, 175, 190), 0.9)
    sheet.line(at(0.67, 0.70), at(0.95, 0.70), 5, (60, 72, 84), 0.8)
    sheet.line(at(0.67, 0.70), at(0.80, 0.70), 5, (200, 60, 48), 0.9)
    for i, words in enumerate(("RADIO", "MEDIA", "MAP", "CAR")):
        x = 0.02 + 0.2425 * i
        sheet.box((*at(x, 0.85), *at(x + 0.2325, 0.97)), (26, 33, 42), (18, 24, 31), 8)
        sheet.text(*at(x + 0.116, 0.91), words, 25, (210, 216, 224), 0.85)


def draw_gears(sheet):
    for i, character in enumerate(GEARS):
        left, top = i * GEAR_CELL, DIAL
        sheet.box((left, top, left + GEAR_CELL, top + GEAR_CELL), (8, 10, 12), (4, 6, 8))
        sheet.text(left + GEAR_CELL / 2, top + 100, character, 112, (240, 244, 248), 0.9)
        sheet.text(left + GEAR_CELL / 2, top + 26, "GEAR", 20, GREY)


def draw_climate(sheet):
    left, top, right, bottom = PIXELS["climate"]
    middle, k = (top + bottom) / 2, (right - left) / 512
    sheet.box(PIXELS["climate"], (9, 9, 10), (0, 0, 0))
    for i, centre in enumerate((96, 256, 416)):
        for step in range(11):
            a = radians(225 - 27 * step)
            warm = (70, 120, 220) if step < 5 else (220, 60, 50)
            x = left + centre * k
            ends = [(x + r * k * cos(a), middle - r * k * sin(a)) for r in (51, 58)]
            sheet.line(*ends, 4 * k, warm if i == 0 else (205, 208, 212), 0.45)


def draw_hazard(sheet):
    left, top, right, bottom = PIXELS["hazard"]
    cx = (left + right) / 2
    sheet.box(PIXELS["hazard"], (18, 18, 19), (0, 0, 0))
    corners = [(cx, top + 10), (cx + 26, top + 54), (cx - 26, top + 54), (cx, top + 10), (cx + 26, top + 54)]
    outline = [(x * OVER, y * OVER) for x, y in corners]
    sheet.both(lambda d, c: d.line(outline, fill=c, width=6 * OVER), (220, 40, 36), (120, 14, 10))


def draw_lamps(sheet):
    """Plain fields, one per lamp colour; a lamp's outline is inside one of them."""
    for name, light in LAMPS.items():
        sheet.box(PIXELS[name], dimmed(light, 0.28), light)


def draw_all(sweep, tach_top, tach_red, speed_top):
    """Draws and saves the atlas. Returns the paths of base colour and emission."""
    sheet = Sheet()
    draw_dial(sheet, "tach", tach_top, 1, 0.25, lambda v: "%d" % round(v), "1/min x1000", sweep, tach_red, 56)
    draw_dial(sheet, "speed", speed_top, 20, 10, lambda v: "%d" % round(v), "km/h", sweep, px=31)
    draw_screen(sheet)
    draw_gears(sheet)
    draw_climate(sheet)
    draw_hazard(sheet)
    draw_lamps(sheet)
    return sheet.save()
