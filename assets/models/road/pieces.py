"""Parts painted with one colour of the roadside picture."""
from mathutils import Vector

from craft.part import Part
from road.colours import cell_middle


class Thing(Part):
    """A part whose pieces are coloured from a cell: tint() the most recent piece."""

    def tint(self, ob, colour):
        u, v = cell_middle(colour)
        for loop in ob.data.uv_layers["UVMap"].data:
            loop.uv = (u, v)
        return ob

    def block(self, c, size, colour, **k):
        return self.tint(self.box(c, size, "Roadside", **{"bevel": 0, **k}), colour)

    def face(self, verts, colour):
        return self.tint(self.piece(verts, [tuple(range(len(verts)))], "Roadside", recalc=False), colour)

    def card(self, corners, rect):
        """Four corners, counter-clockwise from the lower left, that show a rectangle (u0, v0, u1, v1) of the picture
        from both sides: two faces, because a single face seen from behind would be lit from behind."""
        ob = self.piece(list(corners) * 2, [(0, 1, 2, 3), (7, 6, 5, 4)], "Leaves", recalc=False)
        u0, v0, u1, v1 = rect
        uv = ((u0, v0), (u1, v0), (u1, v1), (u0, v1))
        for loop in ob.data.loops:
            ob.data.uv_layers["UVMap"].data[loop.index].uv = uv[loop.vertex_index % 4]
        return ob

    def light_leaves_from(self, centre, up=0.35):
        """Makes all leaf normals point away from the crown's centre and slightly up, so that a crown of cards is lit
        like a solid body. Call after build()."""
        mesh = self.pieces[0].data
        mesh.calc_normals_split()
        normals = [loop.normal.copy() for loop in mesh.loops]
        for p in mesh.polygons:
            if mesh.materials[p.material_index].name != "Leaves":
                continue
            for li in p.loop_indices:
                away = mesh.vertices[mesh.loops[li].vertex_index].co - Vector(centre)
                normals[li] = (away.normalized() + Vector((0, 0, up))).normalized()
        mesh.normals_split_custom_set(normals)
