"""Finds the faces visible from possible head positions; faces visible from none are left out of the file.

Moving parts hide nothing and are never cut, because another pose would reveal the hole.
"""
import bmesh
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from craft import scene
from craft.facing import directions

RAYS = 20000  # number of rays from each viewpoint; they find large faces whose corners are hidden


def sees_through(ob):
    return any(m and m.name == "Glass" for m in ob.data.materials)


class World:
    """All faces of some objects in world coordinates, for ray casting, with each face's object."""

    def __init__(self, objects):
        verts, faces = [], []
        self.owner = []  # (object's name, index of the face in the object)
        for o in objects:
            first, world = len(verts), scene.WORLD[o.name]
            verts += [world @ v.co for v in o.data.vertices]
            faces += [[first + v for v in p.vertices] for p in o.data.polygons]
            self.owner += [(o.name, p.index) for p in o.data.polygons]
        self.tree = BVHTree.FromPolygons(verts, faces)

    def is_hidden(self, eye, point):
        ray = point - eye
        distance = ray.length
        return self.tree.ray_cast(eye, ray / distance, distance - 0.002)[0] is not None

    def hit_from(self, eyes):
        """The set of (object's name, face) hit by rays from the eyes, on either side."""
        hits = set()
        for eye in eyes:
            for d in directions(RAYS):
                face = self.tree.ray_cast(eye, d)[2]
                if face is not None:
                    hits.add(self.owner[face])
        return hits


def looked_at(world, points, normal, eyes):
    return any((p - eye).dot(normal) < 0 and not world.is_hidden(eye, p) for eye in eyes for p in points)


def seen_of(ob, world, hits, eyes):
    """One flag per face: a ray hit it, or its centre or a point near a corner is visible."""
    place = scene.WORLD[ob.name]
    turn = place.to_3x3()
    flags = []
    for p in ob.data.polygons:
        if (ob.name, p.index) in hits:
            flags.append(True)
            continue
        middle, normal = place @ p.center, turn @ p.normal
        points = [middle] + [middle.lerp(place @ ob.data.vertices[v].co, 0.8) for v in p.vertices]
        seen = looked_at(world, points, normal, eyes)
        if not seen and not ob.data.materials[p.material_index].use_backface_culling:
            seen = looked_at(world, points, -normal, eyes)
        flags.append(seen)
    return flags


def with_neighbours(ob, flags):
    """Neighbours of a visible face count as visible, because their edges may be, between two sampled points."""
    corners = {v for p, seen in zip(ob.data.polygons, flags) if seen for v in p.vertices}
    return [any(v in corners for v in p.vertices) for p in ob.data.polygons]


def seen_faces(objects, viewpoints, moving):
    """{object's name: one flag per face}. moving: name prefixes of the moving parts."""
    eyes = [Vector(v) for v in viewpoints]
    still = World([o for o in objects if not sees_through(o) and not o.name.startswith(moving)])
    hits = still.hit_from(eyes)
    return {o.name: with_neighbours(o, seen_of(o, still, hits, eyes)) for o in objects}


def cut(objects, seen, moving):
    """Removes invisible faces of fixed parts, keeping the normals. Returns their number."""
    count = 0
    for o in objects:
        flags = seen[o.name]
        if all(flags) or not any(flags) or o.name.startswith(moving):
            continue
        mesh = o.data
        mesh.calc_normals_split()
        normals = [mesh.loops[li].normal.copy() for p in mesh.polygons if flags[p.index] for li in p.loop_indices]
        bm = bmesh.new()
        bm.from_mesh(mesh)
        bm.faces.ensure_lookup_table()
        bmesh.ops.delete(bm, geom=[f for f, keep in zip(bm.faces, flags) if not keep], context="FACES")
        bm.to_mesh(mesh)
        bm.free()
        mesh.normals_split_custom_set(normals)
        count += flags.count(False)
    return count
