"""All parts of the cabin, in order: parents before children."""
from mathutils import Matrix

from cabin import (
    cluster,
    console,
    dashboard,
    doors,
    handbrake,
    lever,
    mirrors,
    outside,
    pedals,
    rear,
    seats,
    shell,
    stack,
    steering,
    surfaces,
)
from cabin.dimensions import CENTRE_X
from craft import scene


def build():
    surfaces.make_all()
    scene.empty("Cabin", Matrix(), None)
    scene.empty("Dashboard", (CENTRE_X, 0.7, 0.3))
    for room in (dashboard, cluster, steering, pedals, console, stack, lever, handbrake, seats, doors, shell, rear):
        room.build()
    mirrors.build_interior_mirror()
    outside.build()
