// The door mirrors' glass: flat in the cabin's file, made convex as on real cars.
#pragma once

#include "app/cabin/stage/mesh_builder.h"

namespace gearshift::cabin {

// Gives a flat face the normals of a sphere around its centre, tilted slightly to the ground. It then reflects the
// horizon with road and verge below, while a flat one shows only haze.
void make_convex(MeshData& glass);

}  // namespace gearshift::cabin
