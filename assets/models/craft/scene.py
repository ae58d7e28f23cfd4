"""The scene tree: nodes with exact world matrices.

Blender updates matrix_world only with its dependency graph, which does not run in background mode between two script
lines; the world matrix of every node is kept here instead, so that no parent inverse is exported.
"""
import bpy
from mathutils import Matrix, Vector

WORLD = {}  # world matrix by node name


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    WORLD.clear()


def link(ob):
    bpy.context.scene.collection.objects.link(ob)
    return ob


def meshes():
    return [o for o in bpy.data.objects if o.type == "MESH"]


def place(ob, world, parent):
    ob.parent = bpy.data.objects[parent] if parent else None
    ob.matrix_basis = (WORLD[parent].inverted() if parent else Matrix()) @ world
    WORLD[ob.name] = world.copy()


def empty(name, world, parent="Cabin"):
    """A node without a mesh at a matrix or point."""
    node = link(bpy.data.objects.new(name, None))
    node.empty_display_size = 0.05
    place(node, world if isinstance(world, Matrix) else Matrix.Translation(Vector(world)), parent)
    return node


def rest_rotation(name, local):
    """Rotates a node at its parent's origin: the rest pose of a needle."""
    node = bpy.data.objects[name]
    node.matrix_basis = local
    WORLD[name] = WORLD[node.parent.name] @ local


def drop_leftovers():
    for o in [o for o in bpy.data.objects if o.name not in WORLD]:
        bpy.data.objects.remove(o)
