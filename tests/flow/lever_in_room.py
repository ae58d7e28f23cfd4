"""Simulates a lever in a room and a user who touches its knob; headset_stick.sh uses it for scripts and checks.

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

TURN, SHIFT = math.radians(35), (-0.7, -0.6, 0.9)  # from room to cabin: turn about the vertical [rad], then shift [m]
GEARS = {"neutral": (0, 0), "first": (-30, 35.8), "reverse": (30, -35.8)}  # [mm] lever positions in the gate plane
# Offset of the controller's tip from the knob at each touch [m].
TIP_OFF = {"neutral": (0.003, 0, 0), "first": (0, 0, 0.003), "reverse": (0, 0.003, 0)}
# In each round the controller visits the three gears in turn and pulls its trigger there. There are several rounds,
# because a slow program may miss one.
ROUND, PULL, ROUNDS = 10, 1.2, 12  # duration of a round [s] and of a pull [s]; number of rounds
# Yaw (to the left) and pitch (up) of the controller at each touch [deg].
HELD = {"neutral": (0, -60), "first": (45, -60), "reverse": (0, -15)}
TOUCHED_AT = {"neutral": 0.8, "first": 3.8, "reverse": 7.2}  # [s] time of the touch within a round
# Point between the eyes in the cabin [m]; yaw (to the left) and pitch (up) of the head [deg].
EYE, YAW, PITCH = (0.08, 0.58, 0.02), -35, -42


def rotated(p, a):
    return (p[0] * math.cos(a) + p[2] * math.sin(a), p[1], p[2] * math.cos(a) - p[0] * math.sin(a))


def to_cabin(p, turn=TURN, shift=SHIFT):
    return tuple(x + y for x, y in zip(rotated(p, turn), shift))


def to_room(p):
    return rotated(tuple(x - y for x, y in zip(p, SHIFT)), -TURN)


def knob(x, y, length=0.144):  # x, y [mm] in the gate plane; length [m] from the pivot
    x, y = 1e-3 * x, 1e-3 * y
    up = math.sqrt(0.120**2 - x * x - y * y)
    return tuple(p + length / 0.120 * d for p, d in zip((0.330, 0.007, -0.270), (x, up, -y)))


def pose(p, yaw, pitch, at):
    return f"{{at = {at:.1f}, position = [{', '.join(f'{x:.6f}' for x in p)}], yaw = {yaw}, pitch = {pitch}}}"


def script():
    pulls = [(ROUND * r + TOUCHED_AT[g], g) for r in range(ROUNDS) for g in GEARS]
    tips = {g: tuple(p + e for p, e in zip(to_room(knob(*GEARS[g])), TIP_OFF[g])) for g in GEARS}
    aim = [pose(tips[g], *HELD[g], t + after) for t, g in pulls for after in (-0.3, PULL + 0.2)]
    print("stage_origin = {position = [0, 0, 0]}")  # stage and local space coincide, so the program may use either
    print(f"head = [{pose(to_room(EYE), YAW - math.degrees(TURN), PITCH, 0)}]")
    print(f"right = [{', '.join(aim)}]")
    print('[[input]]\npath = "/user/hand/right/input/trigger/value"')
    print("at = [" + ", ".join(f"{t:.1f}, {t + PULL:.1f}" for t, _ in pulls) + "]")
    print("value = [" + ", ".join(["1.0, 0.0"] * len(pulls)) + "]")


def found(seat):
    """The error at the touches is at most their misfit, plus 3 mm for the tip and 0.5 mm for the hand on the lever."""
    text = open(seat).read().split("[touched]")[1]
    saved = {k: float(v) for k, v in re.findall(r"^(\w+) = ([-\d.e]+)$", text, re.M)}
    turn, shift = math.radians(saved["turn_deg"]), (saved["x_m"], saved["y_m"], saved["z_m"])

    def miss(x, y):
        return math.dist(to_cabin(to_room(knob(x, y)), turn, shift), knob(x, y))

    touched = max(miss(*at) for at in GEARS.values())
    anywhere = max(miss(x, y) for x in (-30, 0, 30) for y in (-35.8, 0, 35.8))
    allowed = saved["error_m"] + 0.0035
    print(f"    the room is turned by {math.degrees(TURN):.2f} deg, found {saved['turn_deg']:.2f}; the knob is seen "
          f"{1e3 * touched:.1f} mm from where it was touched ({1e3 * allowed:.1f} allowed), {1e3 * anywhere:.1f} mm anywhere")
    return touched <= allowed and anywhere < 0.010  # [m] half of ghost_offset_m, above which the ghost hand shows


def truth(seat):
    x, y, z = SHIFT
    with open(seat, "w") as file:
        file.write(f'drive = "left"\nseat_height_m = 0.0\n[touched]\nx_m = {x}\ny_m = {y}\nz_m = {z}\n'
                   f"turn_deg = {math.degrees(TURN):.6f}\nerror_m = 0.0\n")


def project(p):
    """Projects p into the left eye, 31.5 mm to the left: [px], [px], distance [m]. Field: -50 to 42, 44 to -48 deg."""
    yaw, pitch = math.radians(YAW), math.radians(PITCH)
    x, y, z = rotated(tuple(a - b for a, b in zip(p, EYE)), -yaw)
    y, z = y * math.cos(pitch) + z * math.sin(pitch), z * math.cos(pitch) - y * math.sin(pitch)
    right, up = (x + 0.0315) / -z, y / -z
    t = lambda d: math.tan(math.radians(d))
    return 256 * (right + t(50)) / (t(42) + t(50)), 192 * (t(44) - up) / (t(44) + t(48)), -z


def grey(file):
    data = subprocess.run(["convert", file, "-colorspace", "Gray", "-depth", "8", "gray:-"], capture_output=True).stdout
    return [data[256 * row:256 * row + 256] for row in range(192)]


def drawn(now, reference, before):
    """The surroundings of the knob match best when shifted by at most a pixel, and differ less than half as much as before."""
    x, y, distance = project(knob(0, 0, 0.120))
    now, reference, before = grey(now), grey(reference), grey(before)
    near = range(-22, 23)

    def difference(picture, dx, dy):
        squares = ((picture[int(y) + j + dy][int(x) + i + dx] - reference[int(y) + j][int(x) + i])**2
                   for j in near for i in near)
        return math.sqrt(sum(squares)) / len(near)

    _, dx, dy = min((difference(now, dx, dy), dx, dy) for dx in range(-8, 9) for dy in range(-8, 9))
    left, old = difference(now, 0, 0), difference(before, 0, 0)
    mm = 1e3 * distance * (math.tan(math.radians(42)) + math.tan(math.radians(50))) / 256
    print(f"    the knob, at {x:.0f}, {y:.0f} px, is drawn {dx}, {dy} px beside, of {mm:.1f} mm; differs by {left:.1f} of 255, "
          f"before by {old:.1f}")
    return max(abs(dx), abs(dy)) <= 1 and left < 0.5 * old


sys.exit({"script": script, "found": found, "truth": truth, "drawn": drawn}[sys.argv[1]](*sys.argv[2:]) is False)
