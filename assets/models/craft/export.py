"""Writes a .glb and removes data that no material uses.

Blender's exporter writes texture coordinates and tangents for either every mesh or none. Here each primitive keeps only
the attributes that its material reads: TEXCOORD_0 and _1 where a texture samples them, TANGENT with a normal map.
"""
import json
import struct

import bpy
import numpy as np

from craft import scene


def triangulate():
    """Triangulates all meshes: tangents are exported only for triangles."""
    for o in scene.meshes():
        m = o.modifiers.new("triangles", "TRIANGULATE")
        m.quad_method, m.ngon_method, m.keep_custom_normals = "FIXED", "BEAUTY", True
        bpy.ops.object.select_all(action="DESELECT")
        bpy.context.view_layer.objects.active = o
        bpy.ops.object.modifier_apply(modifier=m.name)


def write(path, skins=False, keep_uv=()):
    """keep_uv: materials that keep TEXCOORD_0 although nothing samples it."""
    if not skins:
        triangulate()
    bpy.ops.object.select_all(action="DESELECT")
    bpy.ops.export_scene.gltf(
        filepath=path,
        export_format="GLB",
        export_yup=True,
        export_apply=False,
        export_texcoords=True,
        export_normals=True,
        export_tangents=True,
        export_materials="EXPORT",
        export_image_format="AUTO",
        export_animations=False,
        export_skins=skins,
        export_cameras=False,
        export_lights=False,
        export_colors=False,
        export_extras=False,
    )
    trim(path, keep_uv)


def texture_sets(material):
    """The UV sets that a material samples, and whether it has a normal map."""
    pbr = material.get("pbrMetallicRoughness", {})
    uses = [pbr.get("baseColorTexture"), pbr.get("metallicRoughnessTexture")]
    uses += [material.get(k) for k in ("normalTexture", "occlusionTexture", "emissiveTexture")]
    return {u.get("texCoord", 0) for u in uses if u}, "normalTexture" in material


def drop_unused_attributes(gltf, keep_uv):
    for mesh in gltf["meshes"]:
        for p in mesh["primitives"]:
            material = gltf["materials"][p["material"]] if "material" in p else {}
            sets, has_normal_map = texture_sets(material)
            if material.get("name") in keep_uv:
                sets.add(0)
            last = max(sets, default=-1)  # lower UV sets are kept, because glTF requires numbers without gaps
            unused = {"TEXCOORD_%d" % k for k in range(last + 1, 4)}
            if not has_normal_map:
                unused.add("TANGENT")
            p["attributes"] = {k: v for k, v in p["attributes"].items() if k not in unused}


def floats(gltf, blob, accessor):
    """A float accessor's view of the binary, one row per element; Blender writes them without stride."""
    a = gltf["accessors"][accessor]
    first = gltf["bufferViews"][a["bufferView"]].get("byteOffset", 0) + a.get("byteOffset", 0)
    width = {"VEC2": 2, "VEC3": 3, "VEC4": 4}[a["type"]]
    return np.frombuffer(blob, "<f4", a["count"] * width, first).reshape(-1, width)


def mend_tangents(gltf, blob):
    """Blender gives triangles without uv area no tangent; any direction perpendicular to the normal will do."""
    for mesh in gltf["meshes"]:
        for p in mesh["primitives"]:
            if "TANGENT" not in p["attributes"]:
                continue
            tangents = floats(gltf, blob, p["attributes"]["TANGENT"])
            normals = floats(gltf, blob, p["attributes"]["NORMAL"])
            for i in np.flatnonzero(np.linalg.norm(tangents[:, :3], axis=1) < 0.5):
                across = np.cross(normals[i], (1, 0, 0) if abs(normals[i][0]) < 0.9 else (0, 1, 0))
                tangents[i] = (*(across / np.linalg.norm(across)), 1)


def used_accessors(gltf):
    used = set()
    for mesh in gltf["meshes"]:
        for p in mesh["primitives"]:
            used |= set(p["attributes"].values()) | {p["indices"]}
    return used | {s["inverseBindMatrices"] for s in gltf.get("skins", []) if "inverseBindMatrices" in s}


def trim(path, keep_uv):
    with open(path, "rb") as f:
        data = f.read()
    json_size = struct.unpack_from("<I", data, 12)[0]
    gltf = json.loads(data[20 : 20 + json_size])
    blob = bytearray(data[28 + json_size :])
    drop_unused_attributes(gltf, keep_uv)
    mend_tangents(gltf, blob)
    gltf["asset"]["generator"] = "assets/models/build.py"

    kept = sorted(used_accessors(gltf))
    place = {old: new for new, old in enumerate(kept)}
    gltf["accessors"] = [gltf["accessors"][i] for i in kept]
    for mesh in gltf["meshes"]:
        for p in mesh["primitives"]:
            p["attributes"] = {k: place[v] for k, v in p["attributes"].items()}
            p["indices"] = place[p["indices"]]
    for skin in gltf.get("skins", []):
        skin["inverseBindMatrices"] = place[skin["inverseBindMatrices"]]
    with open(path, "wb") as f:
        f.write(packed(gltf, repack_views(gltf, blob)))


def repack_views(gltf, blob):
    """Builds a new binary with only the views still in use."""
    holders = gltf["accessors"] + gltf.get("images", [])
    views = sorted({h["bufferView"] for h in holders})
    place, out, new_views = {v: i for i, v in enumerate(views)}, bytearray(), []
    for v in views:
        view = gltf["bufferViews"][v]
        first = view.get("byteOffset", 0)
        out += b"\0" * (-len(out) % 4)
        new_views.append({**view, "byteOffset": len(out)})
        out += blob[first : first + view["byteLength"]]
    for h in holders:
        h["bufferView"] = place[h["bufferView"]]
    out += b"\0" * (-len(out) % 4)
    gltf["bufferViews"] = new_views
    gltf["buffers"] = [{"byteLength": len(out)}]
    return bytes(out)


def packed(gltf, blob):
    text = json.dumps(gltf, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(blob)
    head = struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON")
    return head + text + struct.pack("<I4s", len(blob), b"BIN\0") + blob
