"""Finds parts that are visible from behind: back-face culling would leave holes there."""
from bisect import bisect_right
from math import cos, pi, sin, sqrt

from mathutils import Vector
from mathutils.bvhtree import BVHTree

from craft import scene


def directions(n):
    """n directions, evenly distributed over the sphere (golden angle)."""
    for i in range(n):
        z = 1 - (2 * i + 1) / n
        r, a = sqrt(1 - z * z), i * pi * (3 - sqrt(5))
        yield Vector((r * cos(a), r * sin(a), z))


def seen_from_behind(viewpoints, rays=4000):
    """{part: percentage of the rays that hit the back of one of its single-sided faces}."""
    verts, faces, first, names = [], [], [], []
    for o in scene.meshes():
        if any(m.name == "Glass" for m in o.data.materials):
            continue
        start, world = len(verts), scene.WORLD[o.name]
        first.append(len(faces))
        names.append(o.name)
        verts += [world @ v.co for v in o.data.vertices]
        faces += [[start + v for v in p.vertices] for p in o.data.polygons]
    tree = BVHTree.FromPolygons(verts, faces)
    counts = {}
    for eye in viewpoints:
        for d in directions(rays):
            _, normal, index, _ = tree.ray_cast(Vector(eye), d)
            if index is None or normal.dot(d) <= 0:
                continue
            k = bisect_right(first, index) - 1
            mesh = scene.bpy.data.objects[names[k]].data
            material = mesh.materials[mesh.polygons[index - first[k]].material_index]
            if material.use_backface_culling:
                key = names[k] + "/" + material.name
                counts[key] = counts.get(key, 0) + 1
    return {k: 100.0 * v / (rays * len(viewpoints)) for k, v in sorted(counts.items(), key=lambda kv: -kv[1])}
