"""hand.glb: gloved hand and sleeve, skinned; the origin of its node is the knob's centre."""
import os

import numpy as np

from craft import textures
from hand import glove as picture
from hand import gltf, grip, sleeve

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "generic_hand_right.glb")
LOOK = (-22.0, 8.0, 10.0)  # [deg] rotation of the hand: heading (negative: right), fingers up, thumb side up
ELBOW = np.array([-0.085, 0.055, 0.325])  # [m] relative to the knob's centre, in glTF axes: to the left, above, behind
FOREARM = 0.235  # [m] length of the sleeve
JOINTS = {"Wrist": "wrist", "Palm": "middle-finger-metacarpal"}
PARENTS = {"Wrist": None, "Palm": "Wrist"}
for finger, first in (
    ("Thumb", "thumb"),
    ("Index", "index"),
    ("Middle", "middle"),
    ("Ring", "ring"),
    ("Pinky", "pinky"),
):
    bones = ("metacarpal", "phalanx-proximal", "phalanx-distal")
    if first != "thumb":
        first, bones = first + "-finger", ("phalanx-proximal", "phalanx-intermediate", "phalanx-distal")
    for k, bone in enumerate(bones):
        JOINTS["%s%d" % (finger, k + 1)] = "%s-%s" % (first, bone)
        PARENTS["%s%d" % (finger, k + 1)] = "%s%d" % (finger, k) if k else "Palm"
OWNERS = {v: k for k, v in JOINTS.items()}


def owner(source_joint):
    """Our joint for a source joint: palm bones map to the palm, tips to their last phalanx."""
    if source_joint in OWNERS:
        return OWNERS[source_joint]
    if source_joint.endswith("tip"):
        finger = source_joint.split("-")[0].capitalize()
        return finger + "3"
    return "Palm"


def skinned(hand, pose):
    """Positions of the open hand in a pose, by linear blending."""
    move = np.stack([pose[n] @ np.linalg.inv(hand["bind"][n]) for n in hand["names"]])
    points = np.c_[hand["positions"], np.ones(len(hand["positions"]))]
    moved = np.einsum("vkij,vj->vki", move[hand["joints"]], points)[..., :3]
    return np.einsum("vk,vki->vi", hand["weights"], moved)


def in_hand_frame(hand):
    """The hand with its wrist at the origin, X to the little finger, -Z to the fingertips."""
    to_wrist = np.linalg.inv(hand["bind"]["wrist"])
    points = np.c_[hand["positions"], np.ones(len(hand["positions"]))]
    hand["positions"] = (points @ to_wrist.T)[:, :3]
    hand["bind"] = {n: to_wrist @ m for n, m in hand["bind"].items()}
    return hand


def placement():
    """Hand frame -> frame of the knob (glTF axes)."""
    heading, raised, rolled = LOOK
    m = grip.turn(1, heading) @ grip.turn(0, raised) @ grip.turn(2, -rolled)
    m[:3, 3] = -m[:3, :3] @ grip.KNOB
    return m


def merged_weights(hand, names):
    """Indices and weights of our joints, at most four per vertex."""
    table = np.zeros((len(hand["positions"]), len(names)))
    owners = [names.index(owner(n)) for n in hand["names"]]
    for k in range(4):
        np.add.at(table, (np.arange(len(table)), [owners[j] for j in hand["joints"][:, k]]), hand["weights"][:, k])
    order = np.argsort(-table, axis=1, kind="stable")[:, :4]
    weights = np.take_along_axis(table, order, 1)
    weights /= weights.sum(1, keepdims=True)
    return np.where(weights > 0, order, 0), weights


def with_normals(mesh):
    """Normals smoothed over vertices at the same position; tangents along u."""
    p, uv, t = mesh["positions"], mesh["uv"], mesh["triangles"]
    _, same = np.unique(np.round(p, 6), axis=0, return_inverse=True)
    same = same.reshape(-1)
    edge1, edge2 = p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]]
    face = np.cross(edge1, edge2)
    normals = np.zeros((same.max() + 1, 3))
    for k in range(3):
        np.add.at(normals, same[t[:, k]], face)
    normals = normals[same]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    d1, d2 = uv[t[:, 1]] - uv[t[:, 0]], uv[t[:, 2]] - uv[t[:, 0]]
    area = d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]
    sign = np.where(area < 0, -1.0, 1.0)
    along_u = (edge1 * d2[:, 1:] - edge2 * d1[:, 1:]) * sign[:, None]
    tangents, hands = np.zeros_like(p), np.zeros(len(p))
    for k in range(3):
        np.add.at(tangents, t[:, k], along_u)
        np.add.at(hands, t[:, k], -sign)  # negative, because v points down in glTF
    tangents -= normals * np.sum(normals * tangents, axis=1, keepdims=True)
    length = np.linalg.norm(tangents, axis=1, keepdims=True)
    spare = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.9, [[1.0, 0, 0]], [[0, 1.0, 0]]))
    tangents = np.where(length > 1e-12, tangents, spare)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    mesh["normals"], mesh["tangents"] = normals, np.c_[tangents, np.where(hands < 0, -1.0, 1.0)]
    return mesh


def rigid(mesh, joint):
    mesh["joints"] = np.tile([joint, 0, 0, 0], (len(mesh["positions"]), 1))
    mesh["weights"] = np.tile([1.0, 0, 0, 0], (len(mesh["positions"]), 1))
    return with_normals(mesh)


def glove_material(colours, normals):
    """Painted colours; the grain is finer and has its own uv scale."""
    grain = {"index": normals, "scale": 0.45, "extensions": {"KHR_texture_transform": {"scale": [8, 8]}}}
    surface = {"baseColorTexture": {"index": colours}, "metallicFactor": 0, "roughnessFactor": 0.5}
    return {"name": "Glove", "pbrMetallicRoughness": surface, "normalTexture": grain}


def sleeve_material(normals):
    return {
        "name": "Sleeve",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.045, 0.052, 0.062, 1],
            "metallicFactor": 0,
            "roughnessFactor": 0.95,
        },
        "normalTexture": {"index": normals, "scale": 0.4},
        "doubleSided": True,
    }


def build(path):
    hand = in_hand_frame(gltf.read_hand(SOURCE))
    pose = grip.closed(hand["bind"])
    to_knob = placement()
    glove = {"uv": hand["uv"], "triangles": hand["triangles"]}
    points = np.c_[skinned(hand, pose), np.ones(len(hand["positions"]))]
    glove["positions"] = (points @ to_knob.T)[:, :3]

    wrist = to_knob @ pose["wrist"]
    start = wrist[:3, 3] + wrist[:3, 2] * 0.004
    along = (ELBOW - start) / np.linalg.norm(ELBOW - start)
    across = wrist[:3, 0] - along * np.dot(wrist[:3, 0], along)
    across /= np.linalg.norm(across)
    forearm = np.eye(4)
    forearm[:3, 0], forearm[:3, 1], forearm[:3, 2] = across, np.cross(along, across), along
    forearm[:3, 3] = wrist[:3, 3]

    joints = [(name, PARENTS[name], to_knob @ pose[source]) for name, source in JOINTS.items()]
    joints.append(("Forearm", "Wrist", forearm))
    names = [j[0] for j in joints]
    glove["joints"], glove["weights"] = merged_weights(hand, names)
    last = len(names) - 1
    cuff = rigid(sleeve.glove_cuff(start, along, across), last)
    arm = rigid(sleeve.jacket(start, along, across, FOREARM), last)
    materials = [glove_material(0, 1), sleeve_material(2)]
    images = [picture.draw(hand), textures.leather(), textures.felt()]
    gltf.write(path, [(with_normals(glove), 0), (cuff, 0), (arm, 1)], joints, materials, images)
