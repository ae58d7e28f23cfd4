// Makes the door mirrors' glass, which is flat in the cabin's file, convex as on real cars.
#pragma once

#include "app/cabin/stage/mesh_builder.h"

namespace gearshift::cabin {

// Gives a flat face the normals of a sphere, tilted slightly towards the ground. The face then reflects the horizon
// with road and verge below it, while a flat mirror would show only haze.
void make_convex(MeshData& glass);

}  // namespace gearshift::cabin
