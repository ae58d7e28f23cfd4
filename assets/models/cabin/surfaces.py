"""Textures and materials of the cabin."""
from craft import prints, textures
from craft.materials import material

from cabin.dimensions import DIAL_SWEEP, SPEED_TOP, TACH_RED, TACH_TOP


def make_all():
    plastic, leather, felt = textures.plastic(), textures.leather(), textures.felt()
    fabric, fabric_normals = textures.fabric()
    printed, glowing = prints.draw_all(DIAL_SWEEP, TACH_TOP, TACH_RED, SPEED_TOP)

    material("PlasticSoft", (0.052, 0.051, 0.050), 0.80, normals=plastic, bump=0.9, repeats=12)
    material("PlasticHard", (0.118, 0.114, 0.108), 0.60, normals=plastic, bump=0.6, repeats=14)
    material("PlasticGloss", (0.006, 0.006, 0.007), 0.14)
    material("Fabric", (0.05, 0.05, 0.05), 0.93, texture=fabric, normals=fabric_normals, repeats=14)
    material("Leather", (0.050, 0.048, 0.046), 0.50, normals=leather, bump=0.7, repeats=15, two_sided=True)
    material("MetalSatin", (0.40, 0.40, 0.405), 0.40, metal=1.0)
    material("Headliner", (0.60, 0.57, 0.52), 0.95, normals=felt, bump=0.5, repeats=10, two_sided=True)
    material("Carpet", (0.105, 0.101, 0.096), 1.0, normals=felt, repeats=9, two_sided=True)
    material("Stitch", (0.3, 0.02, 0.015), 0.8, texture=textures.stitches(), repeats=150)
    material("Prints", (0.5, 0.5, 0.5), 0.42, texture=printed, emit_texture=glowing)
    material("KnobCap", (0.02, 0.02, 0.02), 0.35, texture=textures.knob_cap(), occlusion=False)
    material("Needle", (0.8, 0.07, 0.02), 0.4, emit=(1.0, 0.10, 0.03), occlusion=False)
    material("Glass", (0.03, 0.05, 0.045), 0.02, alpha=0.06, two_sided=True, occlusion=False)
    material("Mirror", (0.92, 0.93, 0.95), 0.02, metal=1.0, occlusion=False)
    material("BodyPaint", (0.20, 0.012, 0.010), 0.28, metal=0.15, two_sided=True, occlusion=False)
    material("Lamp", (0.5, 0.5, 0.5), 0.4, texture=printed, emit_texture=glowing, occlusion=False)
