"""A part: pieces modelled in world coordinates and joined into one node with its own pivot."""
import math
from math import cos, pi, radians, sin

import bmesh
import bpy
from mathutils import Matrix, Vector

from craft import scene
from craft.geometry import at, lerp
from craft.materials import MATERIALS, REPEATS


def box_uv(mesh):
    """UV0: projection along the dominant axis, in repeats per metre of the material."""
    uv = (mesh.uv_layers.get("UVMap") or mesh.uv_layers.new(name="UVMap")).data
    for p in mesh.polygons:
        k = REPEATS[mesh.materials[p.material_index].name]
        axis = max(range(3), key=lambda i: abs(p.normal[i]))
        for li in p.loop_indices:
            c = mesh.vertices[mesh.loops[li].vertex_index].co
            u, v = ((c.y, c.z), (c.x, c.z), (c.x, c.y))[axis]
            uv[li].uv = (u * k, v * k)


def planar_uv(mesh, rect, F, w, h):
    """UV0: the w x h window around the origin of frame F onto a rectangle (u0, v0, u1, v1), v upwards."""
    u0, v0, u1, v1 = rect
    to_frame = F.inverted()
    uv = mesh.uv_layers["UVMap"].data
    for loop in mesh.loops:
        c = to_frame @ mesh.vertices[loop.vertex_index].co
        uv[loop.index].uv = (lerp(u0, u1, c.x / w + 0.5), lerp(v0, v1, c.z / h + 0.5))


class Part:
    """smooth: edges flatter than this [deg] are shaded round."""

    def __init__(self, name, pivot=None, parent=None, smooth=38):
        self.name, self.parent, self.smooth = name, parent, smooth
        self.pivot = pivot if isinstance(pivot, Matrix) else Matrix.Translation(Vector(pivot or (0, 0, 0)))
        self.pieces = []

    def piece(
        self,
        verts,
        faces,
        mat,
        M=None,
        mats=None,
        bevel=0,
        seg=2,
        sub=0,
        solid=0,
        recalc=True,
        prints=None,
        cut=(),
        bevel_angle=35,
        side=0,
    ):
        """Adds any mesh. mats: one material per face; solid: thickness added to a sheet, on side -1, 0 (both) or 1;
        cut: objects subtracted; prints: (rect, frame, w, h) of a printed face."""
        mesh = bpy.data.meshes.new("piece")
        M = M or Matrix()
        mesh.from_pydata([tuple(M @ Vector(v)) for v in verts], [], faces)
        names = sorted({mat} | set(mats or []))
        for n in names:
            mesh.materials.append(MATERIALS[n])
        for i, p in enumerate(mesh.polygons):
            p.material_index = names.index(mats[i] if mats else mat)
            p.use_smooth = True
        if recalc:
            outward_normals(mesh)
        ob = scene.link(bpy.data.objects.new("piece", mesh))
        add_modifiers(ob, solid, side, sub, cut, bevel, seg, bevel_angle)
        apply_modifiers(ob)
        for c in cut:
            bpy.data.objects.remove(c)
        box_uv(ob.data)
        if prints:
            planar_uv(ob.data, *prints)
        self.pieces.append(ob)
        return ob

    def box(self, c, size, mat, M=None, bevel=0.004, seg=2, rot=None, **k):
        """Box of a size around c."""
        x, y, z = (v / 2 for v in size)
        V = [(sx * x, sy * y, sz * z) for sz in (-1, 1) for sy in (-1, 1) for sx in (-1, 1)]
        F = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        local = Matrix.Translation(Vector(c)) @ (rot or Matrix())
        return self.piece(V, F, mat, (M or Matrix()) @ local, bevel=bevel, seg=seg, **k)

    def panel(self, F, outline, d0, d1, mat, bevel=0.002, seg=2, **k):
        """Prism of an outline (x, z) of frame F from depth d0 to d1, measured towards the viewer."""
        n = len(outline)
        V = [(x, -d0, z) for x, z in outline] + [(x, -d1, z) for x, z in outline]
        walls = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
        caps = [tuple(range(n))[::-1], tuple(range(n, 2 * n))]
        return self.piece(V, caps + walls, mat, F, bevel=bevel, seg=seg, bevel_angle=50, **k)

    def flat(self, F, outline, depth, mat, prints=None):
        """One face of frame F."""
        V = [(x, -depth, z) for x, z in outline]
        return self.piece(V, [tuple(range(len(V)))], mat, F, recalc=False, prints=prints)

    def loft(self, rings, mat, closed=True, caps=True, loop=False, strip_mats=None, **k):
        """Skin over rings of equally many points. strip_mats: one material per strip along the loft."""
        n, count = len(rings[0]), len(rings)
        faces, mats = [], []
        for j in range(count if loop else count - 1):
            for i in range(n if closed else n - 1):
                a, b = j * n + i, j * n + (i + 1) % n
                d, c = (j + 1) % count * n + i, (j + 1) % count * n + (i + 1) % n
                faces.append((a, b, c, d))
                mats.append(strip_mats[i % len(strip_mats)] if strip_mats else mat)
        first, last = (caps, caps) if isinstance(caps, bool) else caps
        if closed and not loop:
            if first:
                faces.append(tuple(range(n))[::-1])
                mats.append(mat)
            if last:
                faces.append(tuple(range((count - 1) * n, count * n)))
                mats.append(mat)
        return self.piece([p for r in rings for p in r], faces, mat, mats=mats, **k)

    def lathe(self, F, profile, mat, n=32, caps=False, **k):
        """Profile (radius, depth towards the viewer) revolved about the face normal of F."""
        angles = [2 * pi * i / n for i in range(n)]
        return self.loft([[at(F, r * cos(a), d, r * sin(a)) for a in angles] for r, d in profile], mat, caps=caps, **k)

    def tube(self, path, r, mat, n=10, loop=False, flat=1.0, caps=True, **k):
        """Tube along a path; r may be a list, one per point; flat squeezes the section along its second axis."""
        P = [Vector(p) for p in path]
        m, rings, up = len(P), [], None
        for i, p in enumerate(P):
            t = (P[(i + 1) % m] - P[i - 1]) if loop else (P[min(i + 1, m - 1)] - P[max(i - 1, 0)])
            t.normalize()
            if up is None:
                up = Vector((0, 0, 1)) if abs(t.z) < 0.9 else Vector((0, 1, 0))
            x = t.cross(up).normalized()
            up = x.cross(t).normalized()
            radius = r[i] if isinstance(r, (list, tuple)) else r
            angles = [2 * pi * j / n for j in range(n)]
            rings.append([tuple(p + radius * (cos(a) * x + flat * sin(a) * up)) for a in angles])
        return self.loft(rings, mat, caps=caps and not loop, loop=loop, **k)

    def sheet(self, grid, mat, thick=0.006, sub=0, strip_mats=None, **k):
        """A grid of points, thickened to both sides."""
        return self.loft(grid, mat, closed=False, solid=thick, sub=sub, strip_mats=strip_mats, **k)

    def seam(self, path, mat="Stitch", width=0.0035, normal=None, lift=0.0008):
        """Stitched seam: a low ridge over a path, UV0 along it (u in repeats of one stitch)."""
        P = [Vector(p) for p in path]
        m = len(P)
        rows, length, lengths = [], 0.0, []
        for i, p in enumerate(P):
            t = (P[min(i + 1, m - 1)] - P[max(i - 1, 0)]).normalized()
            up = Vector(normal[i] if isinstance(normal, list) else normal or (0, 0, 1)).normalized()
            x = t.cross(up).normalized()
            up = x.cross(t)
            profile = ((-1, 0.0), (-0.5, 0.8), (0.5, 0.8), (1, 0.0))
            rows.append([tuple(p + x * a * width / 2 + up * (lift + b * width * 0.25)) for a, b in profile])
            length += (p - P[i - 1]).length if i else 0
            lengths.append(length)
        ob = self.loft(rows, mat, closed=False, recalc=False)
        uv = ob.data.uv_layers["UVMap"].data
        for loop in ob.data.loops:
            row, column = divmod(loop.vertex_index, 4)
            uv[loop.index].uv = (lengths[row] * REPEATS[mat], (0, 0.3, 0.7, 1)[column])
        return ob

    def build(self):
        """Joins the pieces into the node."""
        bpy.ops.object.select_all(action="DESELECT")
        for o in self.pieces:
            o.select_set(True)
        ob = self.pieces[0]
        bpy.context.view_layer.objects.active = ob
        if len(self.pieces) > 1:
            bpy.ops.object.join()
        ob.name = ob.data.name = self.name
        ob.data.transform(self.pivot.inverted())
        ob.data.use_auto_smooth = True
        ob.data.auto_smooth_angle = radians(self.smooth)
        for p in ob.data.polygons:
            p.use_smooth = True
        m = ob.modifiers.new("normals", "WEIGHTED_NORMAL")
        m.keep_sharp, m.mode = True, "FACE_AREA"
        bpy.ops.object.modifier_apply(modifier=m.name)
        bpy.ops.object.material_slot_remove_unused()
        scene.place(ob, self.pivot, self.parent)
        return ob


def outward_normals(mesh):
    bm = bmesh.new()
    bm.from_mesh(mesh)
    bmesh.ops.recalc_face_normals(bm, faces=bm.faces)
    bm.to_mesh(mesh)
    bm.free()


def add_modifiers(ob, solid, side, sub, cut, bevel, seg, bevel_angle):
    if solid:
        m = ob.modifiers.new("solid", "SOLIDIFY")
        m.thickness, m.offset = solid, side
    if sub:
        m = ob.modifiers.new("sub", "SUBSURF")
        m.levels = m.render_levels = sub
    for c in cut:
        m = ob.modifiers.new("cut", "BOOLEAN")
        m.operation, m.object, m.solver = "DIFFERENCE", c, "EXACT"
    if bevel:
        m = ob.modifiers.new("bevel", "BEVEL")
        m.width, m.segments, m.limit_method, m.angle_limit = bevel, seg, "ANGLE", radians(bevel_angle)


def apply_modifiers(ob):
    if not ob.modifiers:
        return
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(ob.evaluated_get(graph))
    ob.modifiers.clear()
    ob.data = mesh


def bezel(part, F, outer, inner, d_back, d_front, d_in, mat):
    """Frame with a chamfered lip between two outlines of equally many points."""
    mid = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in zip(outer, inner)]
    rings = [
        (outer, d_back),
        (outer, lerp(d_back, d_front, 0.7)),
        (mid, d_front),
        (inner, lerp(d_in, d_front, 0.75)),
        (inner, d_in),
    ]
    part.loft([[at(F, x, d, z) for x, z in o] for o, d in rings], mat, caps=False)


def round_section(a, p):
    """Signed power of a cosine: flattens a round section."""
    return math.copysign(abs(a) ** p, a)
