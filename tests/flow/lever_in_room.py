"""Simulates a lever in a room and a person who touches its knob; headset_stick.sh uses it for scripts and checks.

The true transform between room and cabin is known only here: it places head, controller and knob in the room.
The knob's top follows from the lever's geometry: 0.144 m from the pivot of the cabin's model, above the point of the gate
plane where the yoke of 0.120 m holds it.

  script        what the OpenXR test runtime shows: head, controller, trigger
  found SEAT    is the knob drawn where it is, with the seat calibration that the program has found?
  truth SEAT    writes the true seat calibration
  drawn A B C   is the knob drawn in A where it is in B, but not in C? Left-eye pictures, 256 x 192
"""
import math
import re
import subprocess
import sys

TURN, SHIFT = math.radians(35), (-0.7, -0.6, 0.9)  # transform from room to cabin: about the vertical [rad], then [m]
GEARS = {"neutral": (0, 0), "first": (-30, 35.8), "reverse": (30, -35.8)}  # [mm] in the gate plane
# [m] error of a person's tip at each touch
TIP_OFF = {"neutral": (0.003, 0, 0), "first": (0, 0, 0.003), "reverse": (0, 0.003, 0)}
# The controller visits each of them in turn and pulls its trigger, repeatedly: a late program gets another round.
ROUND, PULL, ROUNDS = 10, 1.2, 12  # [s]
# [deg] to the left, up: turned to the side, tilted
HELD = {"neutral": (0, -60), "first": (45, -60), "reverse": (0, -15)}
TOUCHED_AT = {"neutral": 0.8, "first": 3.8, "reverse": 7.2}  # [s] within a round
EYE, YAW, PITCH = (0.08, 0.58, 0.02), -35, -42  # between the eyes, in the cabin; [deg] left and up positive


def turned(p, a):
    return (p[0] * math.cos(a) + p[2] * math.sin(a), p[1], p[2] * math.cos(a) - p[0] * math.sin(a))


def cabin(p, turn=TURN, shift=SHIFT):
    return tuple(x + y for x, y in zip(turned(p, turn), shift))


def room(p):
    return turned(tuple(x - y for x, y in zip(p, SHIFT)), -TURN)


def knob(x, y, length=0.144):  # [mm], [m] from the pivot
    x, y = 1e-3 * x, 1e-3 * y
    up = math.sqrt(0.120**2 - x * x - y * y)
    return tuple(p + length / 0.120 * d for p, d in zip((0.330, 0.007, -0.270), (x, up, -y)))


def pose(p, yaw, pitch, at):
    return f"{{at = {at:.1f}, position = [{', '.join(f'{x:.6f}' for x in p)}], yaw = {yaw}, pitch = {pitch}}}"


def script():
    pulls = [(ROUND * r + TOUCHED_AT[g], g) for r in range(ROUNDS) for g in GEARS]
    tips = {g: tuple(p + e for p, e in zip(room(knob(*GEARS[g])), TIP_OFF[g])) for g in GEARS}
    aim = [pose(tips[g], *HELD[g], t + after) for t, g in pulls for after in (-0.3, PULL + 0.2)]
    print("stage_origin = {position = [0, 0, 0]}")  # both spaces are the same, whichever the program uses
    print(f"head = [{pose(room(EYE), YAW - math.degrees(TURN), PITCH, 0)}]")
    print(f"right = {{aim = [{', '.join(aim)}]}}")
    print('[[input]]\npath = "/user/hand/right/input/trigger/value"')
    print("at = [" + ", ".join(f"{t:.1f}, {t + PULL:.1f}" for t, _ in pulls) + "]")
    print("value = [" + ", ".join(["1.0, 0.0"] * len(pulls)) + "]")


def found(seat):
    """The error at the touches is at most their misfit, plus 3 mm for the tip and 0.5 mm for the hand on the lever."""
    text = open(seat).read().split("[touched]")[1]
    kept = {k: float(v) for k, v in re.findall(r"^(\w+) = ([-\d.e]+)$", text, re.M)}
    turn, shift = math.radians(kept["turn_deg"]), (kept["x_m"], kept["y_m"], kept["z_m"])

    def miss(x, y):
        return math.dist(cabin(room(knob(x, y)), turn, shift), knob(x, y))

    touched = max(miss(*at) for at in GEARS.values())
    anywhere = max(miss(x, y) for x in (-30, 0, 30) for y in (-35.8, 0, 35.8))
    allowed = kept["error_m"] + 0.0035
    print(f"    the room is turned by {math.degrees(TURN):.2f} deg, found {kept['turn_deg']:.2f}; the knob is seen "
          f"{1e3 * touched:.1f} mm from where it was touched ({1e3 * allowed:.1f} allowed), {1e3 * anywhere:.1f} mm anywhere")
    return touched <= allowed and anywhere < 0.010  # the clamp's bound is 0.020


def truth(seat):
    x, y, z = SHIFT
    with open(seat, "w") as file:
        file.write(f'drive = "left"\nseat_height_m = 0.0\n[touched]\nx_m = {x}\ny_m = {y}\nz_m = {z}\n'
                   f"turn_deg = {math.degrees(TURN):.6f}\nerror_m = 0.0\n")


def seen(p):
    """Projects p into the left eye, 31.5 mm to the left: [px], [px], distance [m]. Field: -50 to 42, 44 to -48 deg."""
    yaw, pitch = math.radians(YAW), math.radians(PITCH)
    x, y, z = turned(tuple(a - b for a, b in zip(p, EYE)), -yaw)
    y, z = y * math.cos(pitch) + z * math.sin(pitch), z * math.cos(pitch) - y * math.sin(pitch)
    right, up = (x + 0.0315) / -z, y / -z
    t = lambda d: math.tan(math.radians(d))
    return 256 * (right + t(50)) / (t(42) + t(50)), 192 * (t(44) - up) / (t(44) + t(48)), -z


def grey(file):
    data = subprocess.run(["convert", file, "-colorspace", "Gray", "-depth", "8", "gray:-"], capture_output=True).stdout
    return [data[256 * row:256 * row + 256] for row in range(192)]


def drawn(now, as_it_is, before):
    """The surroundings of the knob match best when shifted by at most a pixel, and four times better than before."""
    x, y, away = seen(knob(0, 0, 0.120))
    now, as_it_is, before = grey(now), grey(as_it_is), grey(before)
    near = range(-22, 23)

    def apart(picture, dx, dy):
        squares = ((picture[int(y) + j + dy][int(x) + i + dx] - as_it_is[int(y) + j][int(x) + i])**2
                   for j in near for i in near)
        return math.sqrt(sum(squares)) / len(near)

    _, dx, dy = min((apart(now, dx, dy), dx, dy) for dx in range(-8, 9) for dy in range(-8, 9))
    left, old = apart(now, 0, 0), apart(before, 0, 0)
    mm = 1e3 * away * (math.tan(math.radians(42)) + math.tan(math.radians(50))) / 256
    print(f"    the knob, at {x:.0f}, {y:.0f} px, is drawn {dx}, {dy} px beside, of {mm:.1f} mm; differs by {left:.1f} of 255, "
          f"before by {old:.1f}")
    return max(abs(dx), abs(dy)) <= 1 and left < 0.5 * old


sys.exit({"script": script, "found": found, "truth": truth, "drawn": drawn}[sys.argv[1]](*sys.argv[2:]) is False)
