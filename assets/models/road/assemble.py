"""All of road.glb. Nodes are roots at the origin; the stage copies and moves them."""
from mathutils import Vector

from craft.materials import material
from road import buildings, colours, furniture, land, tile, trees


def build():
    asphalt, asphalt_normals = colours.asphalt()
    plain = dict(occlusion=False)
    material("Asphalt", (0.07, 0.07, 0.07), 0.9, texture=asphalt, normals=asphalt_normals, repeats=1 / 3, **plain)
    grass = colours.blades("grass.png", (84, 104, 46), 0.16)
    material("Grass", (0.09, 0.13, 0.03), 1.0, texture=grass, repeats=1 / 4, two_sided=True, **plain)
    picture = colours.draw()
    material("Leaves", (0.05, 0.09, 0.02), 0.9, texture=picture, cutoff=0.42, **plain)
    material("Roadside", (0.5, 0.5, 0.5), 0.75, texture=picture, **plain)
    for room in (tile, trees, furniture, buildings, land):
        room.build()


CAMERAS = {
    "road": (Vector((-0.335, -4.0, 1.165)), Vector((0.3, 20.0, 0.6)), 70),
    "things": (Vector((-6, -24, 4.5)), Vector((0, 0, 2.2)), 55),
}
