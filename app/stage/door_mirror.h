// The door mirrors' glass: flat in the cabin's file, convex as it is on cars.
#pragma once

#include "app/stage/patch.h"

namespace gearshift {

// A flat face gets the normals of a sphere about its middle, tilted a little to the ground. It reflects the
// environment's horizon, and road and verge below it, where a flat one shows haze alone.
void make_convex(Patch& glass);

}  // namespace gearshift
