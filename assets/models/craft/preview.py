"""Small path-traced pictures for checking a model during modelling."""
import os
from math import radians

import bpy

from craft import scene, textures

SUN_TURN = (radians(-42), radians(-22), 0)


def set_up(samples, size):
    sc = bpy.context.scene
    sc.render.engine = "CYCLES"
    sc.render.resolution_x, sc.render.resolution_y = (int(v) for v in size.split("x"))
    c = sc.cycles
    c.samples, c.max_bounces, c.transparent_max_bounces = int(samples), 5, 12
    c.use_denoising, c.caustics_reflective = False, False
    c.sample_clamp_indirect, c.sample_clamp_direct = 3, 12
    c.use_fast_gi, c.ao_bounces_render = True, 2
    sc.view_settings.view_transform, sc.view_settings.exposure = "Filmic", 1.0
    for o in scene.meshes():
        if o.name.startswith(("Glass", "Windscreen", "ClusterGlass")):
            o.visible_shadow = False


def add_sky():
    world = bpy.context.scene.world or bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.light_settings.distance, world.light_settings.ao_factor = 0.6, 0.5
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    new = tree.nodes.new
    out, sky, where, split = (new("ShaderNode" + n) for n in ("OutputWorld", "Background", "TexCoord", "SeparateXYZ"))
    height, ramp = new("ShaderNodeMapRange"), new("ShaderNodeValToRGB")
    height.inputs[1].default_value, height.inputs[2].default_value = -0.1, 0.6
    ramp.color_ramp.elements[0].color = (0.20, 0.19, 0.17, 1)
    ramp.color_ramp.elements[1].color = (0.50, 0.62, 0.85, 1)
    ramp.color_ramp.elements.new(0.15).color = (0.75, 0.80, 0.85, 1)
    path, strength = new("ShaderNodeLightPath"), new("ShaderNodeMapRange")
    # The sky lights the scene with strength 2.6, but the camera sees it with strength 0.8.
    strength.inputs[3].default_value, strength.inputs[4].default_value = 2.6, 0.8
    for a, b in (
        (where.outputs["Generated"], split.inputs[0]),
        (split.outputs[2], height.inputs[0]),
        (height.outputs[0], ramp.inputs[0]),
        (ramp.outputs[0], sky.inputs[0]),
        (path.outputs["Is Camera Ray"], strength.inputs[0]),
        (strength.outputs[0], sky.inputs[1]),
        (sky.outputs[0], out.inputs[0]),
    ):
        tree.links.new(a, b)


def add_sun():
    light = bpy.data.lights.new("sun", "SUN")
    light.energy, light.angle = 3.2, radians(3)
    scene.link(bpy.data.objects.new("sun", light)).rotation_euler = SUN_TURN


def camera(name, position, target, fov):
    data = bpy.data.cameras.new(name)
    data.lens_unit, data.angle, data.clip_start = "FOV", radians(fov), 0.01
    ob = scene.link(bpy.data.objects.new(name, data))
    ob.location = position
    ob.rotation_euler = (target - position).to_track_quat("-Z", "Y").to_euler()
    return ob


def render(names, cameras, samples, size, hide=None):
    """Renders to FOLDER/preview_<camera>.png and removes its own objects. hide: {camera: node name prefixes}."""
    if not names:
        return
    before = set(o.name for o in bpy.data.objects)
    set_up(samples, size)
    add_sky()
    add_sun()
    for name in names:
        unseen = [o for o in scene.meshes() if o.name.startswith((hide or {}).get(name, ("-",)))]
        for o in unseen:
            o.hide_render = True
        bpy.context.scene.camera = camera(name, *cameras[name])
        bpy.context.scene.render.filepath = os.path.join(textures.FOLDER, "preview_%s.png" % name)
        bpy.ops.render.render(write_still=True)
        for o in unseen:
            o.hide_render = False
    for o in [o for o in bpy.data.objects if o.name not in before]:
        bpy.data.objects.remove(o)
