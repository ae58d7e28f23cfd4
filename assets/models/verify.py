#!/usr/bin/env python3
"""Reads the models back and checks what the stage relies on: pivots, axes, motion, texture sets, budgets.

    python3 assets/models/verify.py

Plain Python. Prints its measurements; exit code 1 if anything differs from README.md.
"""
import json
import math
import os
import struct
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
failures = []


def check(ok, what):
    print(("ok    " if ok else "WRONG ") + what)
    if not ok:
        failures.append(what)


def near(a, b, tolerance):
    return all(abs(p - q) <= tolerance for p, q in zip(a, b))


def shown(v):
    return "(" + ", ".join("%.4f" % x for x in v) + ")"


# ---- vectors and quaternions (x, y, z, w)


def add(a, b):
    return tuple(p + q for p, q in zip(a, b))


def subtract(a, b):
    return tuple(p - q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def length(a):
    return math.sqrt(dot(a, a))


def turned(q, v):
    u, w = q[:3], q[3]
    t = tuple(2 * k for k in cross(u, v))
    return tuple(v[i] + w * t[i] + cross(u, t)[i] for i in range(3))


def about(axis, degrees):
    """Rotation about local x (0), y (1) or z (2)."""
    half = math.radians(degrees) / 2
    q = [0.0, 0.0, 0.0, math.cos(half)]
    q[axis] = math.sin(half)
    return tuple(q)


def product(a, b):
    x, y, z = cross(a[:3], b[:3])
    return (
        x + a[3] * b[0] + b[3] * a[0],
        y + a[3] * b[1] + b[3] * a[1],
        z + a[3] * b[2] + b[3] * a[2],
        a[3] * b[3] - dot(a[:3], b[:3]),
    )


class Glb:
    """A model file: nodes by name, world positions, accessors."""

    def __init__(self, name):
        self.path = os.path.join(HERE, name)
        with open(self.path, "rb") as f:
            data = f.read()
        self.size = len(data)
        json_size = struct.unpack_from("<I", data, 12)[0]
        self.gltf = json.loads(data[20 : 20 + json_size])
        self.blob = data[28 + json_size :]
        self.nodes = self.gltf["nodes"]
        self.index = {n["name"]: i for i, n in enumerate(self.nodes)}
        self.parent = {c: i for i, n in enumerate(self.nodes) for c in n.get("children", [])}

    def node(self, name):
        return self.nodes[self.index[name]]

    def rotation(self, name):
        return tuple(self.node(name).get("rotation", (0, 0, 0, 1)))

    def world(self, name, point=(0, 0, 0), extra=None, direction=False):
        """World position of a node's point (or direction), after rotating the node by `extra` about its origin."""
        i, v = self.index[name], tuple(point)
        if extra:
            v = turned(extra, v)
        while i is not None:
            n = self.nodes[i]
            v = turned(tuple(n.get("rotation", (0, 0, 0, 1))), v)
            if not direction:
                v = add(v, n.get("translation", (0, 0, 0)))
            i = self.parent.get(i)
        return v

    def read(self, accessor):
        a = self.gltf["accessors"][accessor]
        view = self.gltf["bufferViews"][a["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[a["type"]]
        code, size = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}[a["componentType"]]
        first = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        stride = view.get("byteStride", width * size)
        rows = range(a["count"])
        return [struct.unpack_from("<%d%s" % (width, code), self.blob, first + r * stride) for r in rows]

    def primitives(self, name=None):
        if name is None:
            return [p for m in self.gltf["meshes"] for p in m["primitives"]]
        return self.gltf["meshes"][self.node(name)["mesh"]]["primitives"]

    def attribute(self, name, kind):
        return [v for p in self.primitives(name) for v in self.read(p["attributes"][kind])]

    def material(self, primitive):
        return self.gltf["materials"][primitive["material"]]

    def triangles(self):
        total = 0
        for n in self.nodes:
            for p in self.gltf["meshes"][n["mesh"]]["primitives"] if "mesh" in n else []:
                total += self.gltf["accessors"][p["indices"]]["count"] // 3
        return total


def check_budget(glb, low, high, megabytes):
    n, size = glb.triangles(), glb.size / 1e6
    name = os.path.basename(glb.path)
    materials, draws = len(glb.gltf["materials"]), len(glb.primitives())
    print("%s: %d triangles, %.2f MB, %d materials, %d primitives" % (name, n, size, materials, draws))
    check(low <= n <= high, "%s: triangles within %d..%d" % (name, low, high))
    check(size < megabytes, "%s: below %g MB" % (name, megabytes))
    check(all("scale" not in m and "matrix" not in m for m in glb.nodes), "%s: no node is scaled" % name)


def check_attributes(glb):
    """Every texture has its coordinates, every normal map its tangents."""
    bad = []
    for p in glb.primitives():
        m, have = glb.material(p), p["attributes"]
        uses = [m.get("pbrMetallicRoughness", {}).get("baseColorTexture"), m.get("normalTexture")]
        uses += [m.get("occlusionTexture"), m.get("emissiveTexture")]
        needed = {"TEXCOORD_%d" % u.get("texCoord", 0) for u in uses if u}
        needed |= {"TANGENT"} if "normalTexture" in m else set()
        bad += [m["name"]] if needed - set(have) else []
    check(not bad, "%s: texture sets and tangents are complete" % os.path.basename(glb.path))


# ---- cabin

PIVOTS = {
    "TachDial": (-0.070, 0.3660, -0.699),
    "SpeedDial": (0.070, 0.3660, -0.699),
    "SteeringWheel": (0.0, 0.365, -0.400),
    "PedalClutch": (-0.135, 0.130, -0.900),
    "PedalBrake": (-0.005, 0.130, -0.900),
    "PedalThrottle": (0.125, 0.130, -0.900),
    "LeverPivot": (0.330, 0.007, -0.270),
    "Knob": (0.330, 0.127, -0.270),
    "GateMount": (0.330, 0.037, -0.270),
    "GatePlate": (0.330, 0.037, -0.270),
    "Boot": (0.330, 0.037, -0.270),
    "BootRing": (0.330, 0.037, -0.270),
    "Handbrake": (0.335, -0.030, 0.170),
}
# By lamp: left edge [px] of its colour field in the print atlas. Each field is 64 px square, v = 580 to 644 px.
LAMPS = {
    "TurnLeft": 1648,
    "TurnRight": 1648,
    "Oil": 1488,
    "Battery": 1488,
    "Handbrake": 1488,
    "Engine": 1568,
    "Stall": 1568,
}
GEAR_STEP = 176 / 2048


def check_pivots(glb):
    for name, place in PIVOTS.items():
        seen = glb.world(name)
        check(near(seen, place, 0.002), "%s stands at %s" % (name, shown(seen)))
    for name in ("LeverPivot", "GateMount", "Knob", "KnobCap", "Boot"):
        axes = [glb.world(name, [float(i == k) for k in range(3)], direction=True) for i in range(3)]
        check(near(sum(axes, ()), (1, 0, 0, 0, 1, 0, 0, 0, 1), 1e-5), "%s: X right, Y up, -Z forward" % name)


def needle_tip(glb, name):
    """Middle of the needle's far end, in its frame."""
    points = glb.attribute(name, "POSITION")
    far = max(math.hypot(p[0], p[1]) for p in points)
    end = [p for p in points if math.hypot(p[0], p[1]) > far - 0.001]
    low, high = (tuple(f(p[k] for p in end) for k in range(3)) for f in (min, max))
    return tuple((a + b) / 2 for a, b in zip(low, high))


def check_needle(glb, name, top, marks):
    """The needle tip's direction in the dial, compared with the printed marks: zero lower left, `top` lower right."""
    tip = needle_tip(glb, name)
    rest = glb.rotation(name)
    check(near(rest, about(2, 135), 1e-4), "%s rests at +135 deg about Z" % name)
    for value, clock in marks.items():
        x, y, _ = turned(about(2, 135 - 270 * value / top), tip)
        seen = math.degrees(math.atan2(x, y))  # [deg] clockwise from twelve o'clock
        check(abs(seen - clock) < 0.2, "%s at %g points %.1f deg from twelve o'clock" % (name, value, seen))


def check_dials_upright(glb):
    """uv0 of a dial face: the print's top is the dial's top, so the marks are where the needle formula says."""
    for name in ("TachFace", "SpeedFace"):
        points, uv = glb.attribute(name, "POSITION"), glb.attribute(name, "TEXCOORD_0")
        top = max(range(len(points)), key=lambda i: points[i][1])
        right = max(range(len(points)), key=lambda i: points[i][0])
        middle = tuple(sum(c) / len(uv) for c in zip(*uv))
        check(uv[top][1] < middle[1] - 0.2 and abs(uv[top][0] - middle[0]) < 0.02, name + ": the print stands upright")
        check(uv[right][0] > middle[0] + 0.1, name + ": the print is not mirrored")


def check_pedals(glb):
    for name in ("PedalClutch", "PedalBrake", "PedalThrottle"):
        pad = min(glb.attribute(name, "POSITION"), key=lambda p: p[1])
        still, pressed = glb.world(name, pad), glb.world(name, pad, about(0, 15))
        moved = subtract(pressed, still)
        check(moved[2] < -0.03, "%s: +15 deg moves the pad forward by %.0f mm" % (name, -1e3 * moved[2]))


def check_lever(glb):
    """Knob centre for (theta, phi): rho (sin theta, cos theta cos phi, -sin phi cos theta) with the right signs."""
    rho = 0.120
    rest = subtract(glb.world("Knob"), glb.world("LeverPivot"))
    check(near(rest, (0, rho, 0), 1e-5), "the knob is 120 mm above its pivot")
    for name in ("LeverRod", "LeverCollar", "Knob"):
        check(glb.nodes[glb.parent[glb.index[name]]]["name"] == "LeverPivot", name + " turns with LeverPivot")
    for right, forward in ((10, 0), (0, 12), (-8, -9)):
        q = product(about(0, -forward), about(2, -right))
        seen = turned(q, glb.node("Knob")["translation"])
        a, b = math.radians(right), math.radians(forward)
        expected = (rho * math.sin(a), rho * math.cos(a) * math.cos(b), -rho * math.cos(a) * math.sin(b))
        check(
            near(seen, expected, 1e-6), "lever %d deg right, %d deg forward: knob at %s" % (right, forward, shown(seen))
        )


def check_wheel_and_brake(glb):
    axis = glb.world("SteeringWheel", (0, 0, 1), direction=True)
    check(axis[2] > 0.85 and axis[1] > 0.3, "the steering axis %s looks at the driver" % shown(axis))
    top = glb.world("SteeringWheel", (0, 0.18, 0), about(2, 30))
    check(top[0] < -0.05, "+30 deg turns the top of the wheel to the left")
    tip = min(glb.attribute("Handbrake", "POSITION"), key=lambda p: p[2])
    still = glb.world("Handbrake", tip)
    pulled = glb.world("Handbrake", tip, about(0, 20))
    check(pulled[1] > still[1] + 0.05, "handbrake: +20 deg lifts its end")


def check_gate(glb):
    """The opening is free: no vertex of the frame is inside the rounded rectangle."""
    points = glb.attribute("GatePlate", "POSITION")

    def is_inside(p, margin=0.0003):
        past = [max(0.0, abs(p[k]) - (half - 0.010)) for k, half in ((0, 0.049), (2, 0.053))]
        return math.hypot(*past) < 0.010 - margin

    check(not any(is_inside(p) for p in points), "gate plate: opening of 98 x 106 mm is free")
    check(abs(max(abs(p[0]) for p in points) - 0.064) < 1e-4, "gate plate: 128 mm wide")


def check_cap(glb):
    points, uv = glb.attribute("KnobCap", "POSITION"), glb.attribute("KnobCap", "TEXCOORD_0")
    side = 0.0334
    worst = max(abs(u - (p[0] / side + 0.5)) + abs(v - (p[2] / side + 0.5)) for p, (u, v) in zip(points, uv))
    check(worst < 2e-3, "knob cap: uv0 = (x, z) / 33.4 mm + 0.5")


def check_gear_panel(glb):
    uv = glb.attribute("GearPanel", "TEXCOORD_0")
    u = [c[0] for c in uv]
    v = [c[1] for c in uv]
    cell = (GEAR_STEP, 2 * GEAR_STEP, 672 / 1024, 848 / 1024)
    seen = (min(u), max(u), min(v), max(v))
    check(near(seen, cell, 1e-3), "gear panel: uv0 covers the cell of N, %s" % shown(seen))


def check_lamps(glb):
    users = {}
    for i, n in enumerate(glb.nodes):
        for p in glb.gltf["meshes"][n["mesh"]]["primitives"] if "mesh" in n else []:
            users.setdefault(glb.material(p)["name"], set()).add(n["name"])
    lamps = {"Lamp" + lamp for lamp in LAMPS}
    check(users.get("Lamp") == lamps, "Lamp is the material of the %d lamps and of nothing else" % len(lamps))
    for lamp, left in LAMPS.items():
        uv = glb.attribute("Lamp" + lamp, "TEXCOORD_0")
        inside = all(left < 2048 * u < left + 64 and 580 < 1024 * v < 644 for u, v in uv)
        check(
            inside and len(glb.primitives("Lamp" + lamp)) == 1, "Lamp%s is one draw in the field of its colour" % lamp
        )


def check_mirrors(glb):
    for name in ("InteriorMirrorSurface", "DoorMirrorLeftSurface", "DoorMirrorRightSurface"):
        place, normal = glb.world(name), glb.world(name, (0, 0, 1), direction=True)
        to_eye = subtract((0, 0.635, 0.05), place)
        to_eye = tuple(c / length(to_eye) for c in to_eye)
        seen = subtract(tuple(2 * dot(to_eye, normal) * c for c in normal), to_eye)
        check(seen[2] > 0.9, "%s shows the eye %s, behind the car" % (name, shown(seen)))


def check_cabin():
    glb = Glb("cabin.glb")
    check_budget(glb, 40000, 65000, 15)
    check(len(glb.gltf["materials"]) <= 16, "cabin: at most 16 materials")
    check_attributes(glb)
    check_pivots(glb)
    check_needle(glb, "TachNeedle", 8, {0: -135, 4: 0, 8: 135})
    check_needle(glb, "SpeedNeedle", 220, {0: -135, 110: 0, 220: 135})
    check_dials_upright(glb)
    check_pedals(glb)
    check_lever(glb)
    check_wheel_and_brake(glb)
    check_gate(glb)
    check_cap(glb)
    check_gear_panel(glb)
    check_lamps(glb)
    check_mirrors(glb)
    occlusion = [m["name"] for m in glb.gltf["materials"] if m.get("occlusionTexture", {}).get("texCoord") == 1]
    check(len(occlusion) == 10, "occlusion on the second uv set: " + ", ".join(sorted(occlusion)))


# ---- gearbox, hand, road


def reach(glb, name):
    """Minimum and maximum world z of a part."""
    z = [glb.world(name, p)[2] for p in glb.attribute(name, "POSITION")]
    return min(z), max(z)


def check_gearbox():
    glb = Glb("gearbox.glb")
    check_budget(glb, 5000, 16000, 2)
    check_attributes(glb)
    parts = ("Shaft", "Hub", "Sleeve", "RingForward", "RingBack", "GearForward", "GearBack", "Rail", "Fork", "Finger")
    for name in parts + ("SelectorShaft", "Detent", "Housing"):
        check(name in glb.index, "gearbox: %s at %s" % (name, shown(glb.world(name))))
    low, high = reach(glb, "Sleeve")
    check(abs(low + 0.0125) < 1e-5 and abs(high - 0.0125) < 1e-5, "sleeve reaches 12.5 mm to both sides")
    for name, way in (("Forward", -1), ("Back", 1)):
        z = [glb.world("Ring" + name, p)[2] * way for p in glb.attribute("Ring" + name, "POSITION")]
        check(
            abs(max(z) - 0.0173) < 1e-5 and min(z) > 0.0105,
            "Ring%s: %.1f..%.1f mm" % (name, 1e3 * min(z), 1e3 * max(z)),
        )
        near_z, far_z = sorted(way * v for v in reach(glb, "Gear" + name))
        check(abs(far_z - 0.0415) < 1e-5, "Gear%s ends at %.1f mm" % (name, 1e3 * far_z))


def check_hand():
    glb = Glb("hand.glb")
    check_budget(glb, 2000, 5000, 2)
    check_attributes(glb)
    skin = glb.gltf["skins"][0]
    names = [glb.nodes[j]["name"] for j in skin["joints"]]
    wanted = {"Wrist", "Palm", "Forearm"} | {
        f + k for f in ("Thumb", "Index", "Middle", "Ring", "Pinky") for k in "123"
    }
    check(set(names) == wanted, "hand: %d joints" % len(names))
    worst = 0.0
    for name, m in zip(names, glb.read(skin["inverseBindMatrices"])):
        origin = glb.world(name)  # the inverse bind matrix must map this position to the joint's own origin
        back = [sum(m[4 * k + r] * (origin + (1,))[k] for k in range(4)) for r in range(3)]
        worst = max(worst, length(back))
    check(worst < 1e-5, "hand: the nodes stand in the bind pose (%.1e m)" % worst)
    points = glb.attribute("HandMesh", "POSITION")
    glove = glb.read(glb.primitives("HandMesh")[0]["attributes"]["POSITION"])
    closest = min(length(p) for p in glove)
    check(
        0.018 < closest < 0.026, "hand: the glove closes on the knob, nearest %.1f mm from its centre" % (1e3 * closest)
    )
    below = min(p[1] for p in points)
    check(below > -0.075, "hand: nothing reaches through the gate plate (%.0f mm)" % (1e3 * below))
    weights = glb.attribute("HandMesh", "WEIGHTS_0")
    check(max(abs(sum(w) - 1) for w in weights) < 1e-5, "hand: weights sum to 1")


TREES = ("TreeBroad", "TreeSpruce", "Bush")


def check_road():
    glb = Glb("road.glb")
    check_budget(glb, 500, 2000, 3)
    trees = {n: sum(glb.gltf["accessors"][p["indices"]]["count"] // 3 for p in glb.primitives(n)) for n in TREES}
    check(all(n <= 250 for n in trees.values()), "road: at most 250 triangles a tree, %s" % trees)
    leaves = next(m for m in glb.gltf["materials"] if m["name"] == "Leaves")
    check(leaves.get("alphaMode") == "MASK", "road: leaves have holes")
    check_attributes(glb)
    low, high = reach(glb, "Road")
    check(abs(low + 6) < 1e-4 and abs(high - 6) < 1e-4, "road: a tile is 12 m long")
    ends = {}
    for p in glb.attribute("Road", "POSITION"):
        if abs(abs(p[2]) - 6) < 1e-4:
            ends.setdefault(p[2] > 0, set()).add((round(p[0], 3), round(p[1], 3)))
    check(ends[True] == ends[False], "road: both ends of a tile have the same profile")
    for name in ("Post", "Sign", "GuardRail", "Pole", "TreeBroad", "TreeSpruce", "Bush", "House", "Barn", "Bale"):
        check(near(glb.world(name), (0, 0, 0), 1e-6), "road: %s stands at its origin" % name)
    for name in ("Fields", "Hills"):
        check(name in glb.index, "road: " + name)


def main():
    for part in (check_cabin, check_gearbox, check_hand, check_road):
        part()
    print("%d failure(s)" % len(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
