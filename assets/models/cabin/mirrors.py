"""Interior and door mirrors. The node of a mirror surface has local +Z (glTF) along the mirror's normal."""
from mathutils import Vector

from cabin.dimensions import BELT_Z, CENTRE_X, EYE, HALF_BELT, side_x
from craft import scene
from craft.geometry import at, face_frame, lerp, superellipse
from craft.part import Part


def half_way(to_eye, to_view):
    """The normal of a mirror that shows the direction `to_view` to the eye."""
    return (to_eye.normalized() + to_view.normalized()).normalized()


def build_interior_mirror():
    centre = Vector((CENTRE_X - 0.01, 0.495, 0.805))
    F = face_frame(centre, half_way(EYE - centre, Vector((CENTRE_X, -1.3, 0.62)) - centre))
    scene.empty("InteriorMirror", F, "Cabin")
    part = Part("InteriorMirrorHousing", F, "InteriorMirror", smooth=50)

    def ring(k, depth):
        return [at(F, x * k, depth, z * k) for x, z in superellipse(0.122, 0.034, 4.5, 28)]

    shell = ((0.30, -0.034), (0.61, -0.030), (0.90, -0.016), (1.0, -0.002), (1.0, 0.003), (0.975, 0.0045))
    shell += ((0.95, 0.0035), (0.945, 0.0))
    part.loft([ring(*s) for s in shell], "PlasticHard")
    stalk = [at(F, 0, -0.03, 0.0), (CENTRE_X, 0.545, 0.83), (CENTRE_X, 0.585, 0.835)]
    part.tube(stalk, [0.010, 0.009, 0.018], "PlasticHard", n=12)
    part.build()
    surface = Part("InteriorMirrorSurface", F, "InteriorMirror")
    surface.flat(F, superellipse(0.1145, 0.0315, 4.5, 28), 0.001, "Mirror")
    surface.build()


def build_door_mirror(name, side):
    centre = Vector((CENTRE_X + side * (HALF_BELT + 0.155), 0.735, 0.475))
    F = face_frame(centre, half_way(EYE - centre, Vector((side * 0.20, -1, -0.03))))
    node = "DoorMirror" + name
    scene.empty(node, F, "Door" + name)
    part = Part(node + "Housing", F, node, smooth=50)

    def outline(kx, kz):
        return superellipse(0.100 * kx, 0.070 * kz, 3.4, 28)

    shell = ((-0.085, 0.45, 0.40), (-0.078, 0.65, 0.60), (-0.05, 0.90, 0.88), (-0.02, 1.0, 1.0), (0.006, 1.02, 1.02))
    shell += ((0.010, 1.0, 1.0), (0.008, 0.95, 0.94), (-0.004, 0.94, 0.925))
    part.loft([[at(F, x, d, z) for x, z in outline(kx, kz)] for d, kx, kz in shell], "BodyPaint")
    arm, foot = Vector(at(F, 0, -0.03, -0.055)), Vector((side_x(side, BELT_Z), 0.76, BELT_Z + 0.02))
    bend = lerp(foot, arm, 0.5) + Vector((0, 0, -0.012))
    part.tube([foot, bend, arm], [0.028, 0.022, 0.026], "PlasticGloss", n=12, flat=0.6)
    part.build()
    surface = Part(node + "Surface", F, node)
    surface.flat(F, outline(0.93, 0.915), 0.0, "Mirror")
    surface.build()
