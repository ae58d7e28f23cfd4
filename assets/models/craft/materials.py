"""Metal-rough materials by name."""
import bpy

MATERIALS = {}
REPEATS = {}  # by material: texture repeats per metre in UV0, which is a box projection


def clear():
    MATERIALS.clear()
    REPEATS.clear()


def load_image(path, data=False):
    image = bpy.data.images.load(path, check_existing=True)
    if data:
        image.colorspace_settings.name = "Non-Color"
    image.pack()
    return image


def image_node(tree, path, data=False):
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = load_image(path, data)
    return node


def material(
    name,
    colour,
    rough,
    metal=0.0,
    texture=None,
    normals=None,
    bump=1.0,
    emit=None,
    emit_texture=None,
    alpha=1.0,
    cutoff=None,
    two_sided=False,
    repeats=8.0,
    occlusion=True,
):
    """colour, emit: linear; cutoff: texels with a smaller alpha are holes; occlusion: whether the material uses the
    baked ambient occlusion."""
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    tree = m.node_tree
    inputs = tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (*colour, 1)
    inputs["Roughness"].default_value = rough
    inputs["Metallic"].default_value = metal
    inputs["Specular"].default_value = 0.5
    inputs["Emission"].default_value = (*(emit or (0, 0, 0)), 1)
    if texture:
        picture = image_node(tree, texture)
        tree.links.new(picture.outputs[0], inputs["Base Color"])
        if cutoff:
            tree.links.new(picture.outputs["Alpha"], inputs["Alpha"])
            m.blend_method, m.alpha_threshold = "CLIP", cutoff
    if normals:
        map_node = tree.nodes.new("ShaderNodeNormalMap")
        map_node.inputs["Strength"].default_value = bump
        map_node.uv_map = "UVMap"
        tree.links.new(image_node(tree, normals, True).outputs[0], map_node.inputs["Color"])
        tree.links.new(map_node.outputs[0], inputs["Normal"])
    if emit_texture:
        tree.links.new(image_node(tree, emit_texture).outputs[0], inputs["Emission"])
        inputs["Emission Strength"].default_value = 1.0
    if alpha < 1:
        inputs["Alpha"].default_value = alpha
        m.blend_method = "BLEND"
    m.use_backface_culling = not two_sided
    m["occlusion"] = occlusion
    MATERIALS[name] = m
    REPEATS[name] = repeats
    return m
