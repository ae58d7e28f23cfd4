"""Ambient occlusion baked into a second UV set.

Faces that no viewpoint in the cabin sees share one texel; parts near the hands get more texels than the roof. Two
reaches: the near one shades contacts and seams, the far one darkens foot wells and the space under the dashboard.
"""
import os

import bpy
import numpy as np
from PIL import Image

from craft import atlas, scene, textures
from craft.materials import MATERIALS, load_image

SIZE = 2048  # texels per side
NEAR, FAR = (SIZE, 0.25, 48), (SIZE // 2, 0.90, 48)  # texels per side, reach [m], rays per texel
FAR_SHARE = 0.40  # weight of the FAR picture; low, because most cabin walls have another wall within 0.90 m
FLOOR = 0.26  # darkest value in the picture, because reflected light reaches even covered corners


def wanted(ob):
    return any(m and m["occlusion"] for m in ob.data.materials)


def unwrap(objects, hidden, density):
    """UVAO: smart projection of visible faces, with density[name] times as many texels; the rest go into a corner."""
    bpy.ops.object.select_all(action="DESELECT")
    for o in objects:
        layer = o.data.uv_layers.new(name="UVAO")
        o.data.uv_layers.active = layer
        o.select_set(True)
        bpy.context.view_layer.objects.active = o
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(angle_limit=1.2566, island_margin=0.0, area_weight=0.2, correct_aspect=False)
    bpy.ops.object.mode_set(mode="OBJECT")
    owners, shapes = [], []
    for o in objects:
        uv = o.data.uv_layers["UVAO"].data
        seen = [not h for h in hidden[o.name]]
        k = density(o.name) * atlas.world_scale(o, "UVAO", [p for p, s in zip(o.data.polygons, seen) if s])
        for loops in atlas.islands(o.data, "UVAO", seen):
            owners.append((uv, loops))
            shapes.append(np.array([uv[li].uv for li in loops]) * k)
        for p, s in zip(o.data.polygons, seen):
            if not s:
                for li in p.loop_indices:
                    uv[li].uv = (0.25 / SIZE, 0.25 / SIZE)
    placed, scale = atlas.pack(shapes, 3.0 / SIZE)
    for (uv, loops), points in zip(owners, placed):
        for li, point in zip(loops, points):
            uv[li].uv = point
    print("occlusion: %d islands, %.2f mm a texel at density 1" % (len(shapes), 1e3 / (scale * SIZE)))


def joined_copy(objects):
    """One mesh of all objects in world space, including hidden faces, which still occlude."""
    bpy.ops.object.select_all(action="DESELECT")
    for o in objects:
        copy = scene.link(o.copy())
        copy.data = o.data.copy()
        copy.parent = None
        copy.matrix_world = scene.WORLD[o.name]
        copy.hide_render = False
        copy.select_set(True)
        bpy.context.view_layer.objects.active = copy
    bpy.ops.object.join()
    return bpy.context.view_layer.objects.active


def openness(node, side, reach, rays):
    """The fraction of rays that hit nothing within reach, SIZE x SIZE. node: the image node of the baked picture."""
    sc = bpy.context.scene
    node.image = bpy.data.images.new("occlusion", side, side)
    node.image.colorspace_settings.name = "Non-Color"
    sc.render.engine, sc.cycles.samples, sc.cycles.seed = "CYCLES", rays, 0
    # Debian's Blender has no denoiser: with denoising on, the bake comes out black.
    sc.cycles.use_denoising = False
    sc.world = sc.world or bpy.data.worlds.new("world")
    sc.world.light_settings.distance = reach
    bpy.ops.object.bake(type="AO", margin=3, use_clear=True)
    values = np.empty(side * side * 4, np.float32)
    node.image.pixels.foreach_get(values)
    values = np.clip(values.reshape(side, side, 4)[::-1, :, 0], 0, 1)
    return np.array(Image.fromarray(values).resize((SIZE, SIZE), Image.BILINEAR))


def bake(objects):
    """Bakes and saves the occlusion picture. Returns its path."""
    for o in scene.meshes():
        o.hide_render = True
    whole = joined_copy(objects)
    target = bpy.data.materials.new("bake")
    target.use_nodes = True
    node = target.node_tree.nodes.new("ShaderNodeTexImage")
    target.node_tree.nodes.active = node
    for i in range(len(whole.data.materials)):
        whole.data.materials[i] = target
    layer = whole.data.uv_layers["UVAO"]
    whole.data.uv_layers.active = layer
    layer.active_render = True
    near, far = openness(node, *NEAR), openness(node, *FAR)
    path = save_occlusion(near * (1 - FAR_SHARE + FAR_SHARE * far))
    mesh = whole.data  # removed below, because the exporter crashes on an unused mesh with an empty material slot
    bpy.data.objects.remove(whole)
    bpy.data.meshes.remove(mesh)
    bpy.data.materials.remove(target)
    for o in scene.meshes():
        o.hide_render = False
    for o in objects:
        o.data.uv_layers["UVMap"].active = True
        o.data.uv_layers["UVMap"].active_render = True
    return path


def save_occlusion(values):
    softened = FLOOR + (1 - FLOOR) * values**0.8
    softened[-2:, :2] = 0.5  # all hidden faces use this corner
    path = os.path.join(textures.FOLDER, "occlusion.jpg")
    Image.fromarray((softened * 255).astype(np.uint8)).convert("RGB").save(path, quality=88)
    return path


def connect(path):
    """Adds the glTF occlusionTexture: a group node of exactly this name with an input `Occlusion`, fed through UVAO."""
    group = bpy.data.node_groups.new("glTF Material Output", "ShaderNodeTree")
    group.inputs.new("NodeSocketFloat", "Occlusion")
    group.nodes.new("NodeGroupInput")
    picture = load_image(path, True)
    for m in MATERIALS.values():
        if not m["occlusion"]:
            continue
        tree = m.node_tree
        output = tree.nodes.new("ShaderNodeGroup")
        output.node_tree = group
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.image = picture
        second = tree.nodes.new("ShaderNodeUVMap")
        second.uv_map = "UVAO"
        tree.links.new(second.outputs[0], texture.inputs[0])
        tree.links.new(texture.outputs[0], output.inputs["Occlusion"])
        first = tree.nodes.new("ShaderNodeUVMap")
        first.uv_map = "UVMap"
        for n in tree.nodes:  # compare by name: bpy makes a new wrapper object for each access
            if n.type == "TEX_IMAGE" and n.name != texture.name:
                tree.links.new(first.outputs[0], n.inputs[0])


def add(seen, density):
    """Adds the second UV set and the baked occlusion to all objects with a material that uses occlusion. seen: {object's
    name: one flag per face}."""
    objects = [o for o in scene.meshes() if wanted(o)]
    hidden = {o.name: [not s for s in seen[o.name]] for o in objects}
    unwrap(objects, hidden, density)
    connect(bake(objects))
