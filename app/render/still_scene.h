// A model as it stands in its file: every node at rest, skins posed once.
#pragma once

#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"

namespace gearshift {

FrameScene still_scene(const Model& model);

// From the front, the right and above, so far away that all of it is seen. vertical fov [rad]
EyePose fitting_eye(const Model& model, double vertical_fov, double aspect);

}  // namespace gearshift
