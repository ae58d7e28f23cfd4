"""Reads one skinned mesh from a .glb and writes one with several materials. numpy only."""
import json
import struct

import numpy as np

from craft.export import packed

TYPES = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def read_hand(path):
    """Open hand: dict of positions, uv, joints, weights, triangles, and {joint: 4 x 4 matrix in the bind pose}."""
    with open(path, "rb") as f:
        data = f.read()
    json_size = struct.unpack_from("<I", data, 12)[0]
    gltf, blob = json.loads(data[20 : 20 + json_size]), data[28 + json_size :]

    def array(index):
        a = gltf["accessors"][index]
        view = gltf["bufferViews"][a["bufferView"]]
        first, width = view.get("byteOffset", 0) + a.get("byteOffset", 0), WIDTHS[a["type"]]
        return np.frombuffer(blob, TYPES[a["componentType"]], a["count"] * width, first).reshape(-1, width)

    primitive, skin = gltf["meshes"][0]["primitives"][0], gltf["skins"][0]
    names = [gltf["nodes"][j]["name"] for j in skin["joints"]]
    inverse_bind = array(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
    at = primitive["attributes"]
    return {
        "positions": array(at["POSITION"]).astype(float),
        "uv": array(at["TEXCOORD_0"]).astype(float),
        "joints": array(at["JOINTS_0"]).astype(int),
        "weights": array(at["WEIGHTS_0"]).astype(float),
        "triangles": array(primitive["indices"]).reshape(-1, 3).astype(int),
        "names": names,
        "bind": {n: np.linalg.inv(m) for n, m in zip(names, inverse_bind)},
    }


def quaternion(m):
    """(x, y, z, w) of a rotation matrix."""
    w = np.sqrt(max(0, 1 + m[0, 0] + m[1, 1] + m[2, 2])) / 2
    x, y, z = (np.sqrt(max(0, 1 + 2 * m[i, i] - np.trace(m[:3, :3]))) / 2 for i in range(3))
    signs = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]
    q = np.array([np.copysign(v, s) for v, s in zip((x, y, z), signs)] + [w])
    return q / np.linalg.norm(q)


class Writer:
    """Collects arrays into one binary."""

    def __init__(self):
        self.blob, self.views, self.accessors = bytearray(), [], []

    def view(self, data, target=None):
        self.blob += b"\0" * (-len(self.blob) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)})
        if target:
            self.views[-1]["target"] = target
        self.blob += data
        return len(self.views) - 1

    def accessor(self, array, component, kind, target=None, bounds=False):
        array = np.ascontiguousarray(array, TYPES[component])
        entry = {"bufferView": self.view(array.tobytes(), target), "componentType": component}
        entry.update(count=array.size // WIDTHS[kind], type=kind)
        if bounds:
            entry.update(min=array.min(0).tolist(), max=array.max(0).tolist())
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def primitive(self, mesh, material):
        vertices, indices = 34962, 34963
        attributes = {
            "POSITION": self.accessor(mesh["positions"], 5126, "VEC3", vertices, True),
            "NORMAL": self.accessor(mesh["normals"], 5126, "VEC3", vertices),
            "TANGENT": self.accessor(mesh["tangents"], 5126, "VEC4", vertices),
            "TEXCOORD_0": self.accessor(mesh["uv"], 5126, "VEC2", vertices),
            "JOINTS_0": self.accessor(mesh["joints"], 5121, "VEC4", vertices),
            "WEIGHTS_0": self.accessor(mesh["weights"], 5126, "VEC4", vertices),
        }
        triangles = self.accessor(mesh["triangles"].reshape(-1), 5123, "SCALAR", indices)
        return {"attributes": attributes, "indices": triangles, "material": material}


def write(path, meshes, joints, materials, images):
    """meshes: [(mesh, material index)]; joints: [(name, parent or None, 4 x 4 in the mesh)], parents first.

    Nodes: Hand, the root of the skeleton, and its sibling HandMesh, because a skinned mesh moves only with its joints."""
    out = Writer()
    primitives = [out.primitive(m, k) for m, k in meshes]
    world = {name: m for name, _, m in joints}
    inverse = np.stack([np.linalg.inv(m).T for _, _, m in joints])
    first = {name: i + 2 for i, (name, _, _) in enumerate(joints)}
    nodes = [{"name": "Hand"}, {"name": "HandMesh", "mesh": 0, "skin": 0}]
    for name, parent, matrix in joints:
        local = np.linalg.inv(world[parent]) @ matrix if parent else matrix
        nodes.append({"name": name, "translation": local[:3, 3].tolist(), "rotation": quaternion(local).tolist()})
        nodes[first[parent] if parent else 0].setdefault("children", []).append(first[name])
    skin = {"joints": list(first.values()), "inverseBindMatrices": out.accessor(inverse, 5126, "MAT4")}
    pictures = []
    for file in images:
        with open(file, "rb") as f:
            pictures.append(
                {"bufferView": out.view(f.read()), "mimeType": "image/jpeg" if file.endswith("jpg") else "image/png"}
            )
    gltf = {
        "asset": {"version": "2.0", "generator": "assets/models/build.py"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": nodes,
        "meshes": [{"name": "HandMesh", "primitives": primitives}],
        "skins": [skin],
        "materials": materials,
        "extensionsUsed": ["KHR_texture_transform"],
        "textures": [{"source": i, "sampler": 0} for i in range(len(images))],
        "samplers": [{"magFilter": 9729, "minFilter": 9987}],
        "images": pictures,
        "accessors": out.accessors,
        "bufferViews": out.views,
    }
    out.blob += b"\0" * (-len(out.blob) % 4)
    gltf["buffers"] = [{"byteLength": len(out.blob)}]
    with open(path, "wb") as f:
        f.write(packed(gltf, bytes(out.blob)))
