// Makes the door mirrors' glass convex as on real cars; it is flat in the cabin's model file.
#pragma once

#include "app/cabin/stage/mesh_builder.h"

namespace gearshift::cabin {

// Gives a flat face the normals of a sphere, tilted slightly towards the ground. The mirror then shows the horizon with
// road and verge below it. A flat mirror would show only haze.
void make_convex(MeshData& glass);

}  // namespace gearshift::cabin
