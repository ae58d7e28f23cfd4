"""Parts painted with one colour of the roadside picture."""
from craft.part import Part
from road.colours import cell_middle


class Thing(Part):
    """A part whose pieces take their colour from a cell: tint() the piece just made."""

    def tint(self, ob, colour):
        u, v = cell_middle(colour)
        for loop in ob.data.uv_layers["UVMap"].data:
            loop.uv = (u, v)
        return ob

    def block(self, c, size, colour, **k):
        return self.tint(self.box(c, size, "Roadside", **{"bevel": 0, **k}), colour)

    def face(self, verts, colour):
        return self.tint(self.piece(verts, [tuple(range(len(verts)))], "Roadside", recalc=False), colour)
