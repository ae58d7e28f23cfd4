"""Which faces are seen from where a head may be; what is seen from nowhere is left out of the file.

What moves hides nothing and is never cut: another pose would show the hole.
"""
import bmesh
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from craft import scene
from craft.facing import directions

RAYS = 20000  # from each viewpoint into all directions: they find large faces whose corners are hidden


def sees_through(ob):
    return any(m and m.name == "Glass" for m in ob.data.materials)


class World:
    """All faces of some objects in world coordinates, for rays; knows which object a face is of."""

    def __init__(self, objects):
        verts, faces = [], []
        self.owner = []  # (object's name, number of the face in it)
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
        """{(object's name, face)} that rays from the eyes end on, whichever side they meet."""
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
    """One flag a face: a ray ended on it, or its middle or a point near a corner is seen."""
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
    """What touches a seen face counts as seen: its edge may be, between two points that were tried."""
    corners = {v for p, seen in zip(ob.data.polygons, flags) if seen for v in p.vertices}
    return [any(v in corners for v in p.vertices) for p in ob.data.polygons]


def seen_faces(objects, viewpoints, moving):
    """{object's name: one flag a face}. moving: prefixes of the names of what moves."""
    eyes = [Vector(v) for v in viewpoints]
    still = World([o for o in objects if not sees_through(o) and not o.name.startswith(moving)])
    hits = still.hit_from(eyes)
    return {o.name: with_neighbours(o, seen_of(o, still, hits, eyes)) for o in objects}


def cut(objects, seen, moving):
    """Takes unseen faces out of what stands still; normals stay as they were. Returns how many."""
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
