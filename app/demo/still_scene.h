// A scene of a model at rest: every node at its file's transform, skins posed once.
#pragma once

#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"

namespace gearshift::demo {

engine::FrameScene still_scene(const engine::Model& model);

struct FittingView {
  engine::EyePose eye;
  double nearest = 0.0;  // [m] > 0, lower bound of the model's distance from the eye
};

// A view from the front, right and above, far enough to show the whole model. field: field of view across the shorter
// side. [rad]
FittingView fitting_view(const engine::Model& model, double field);

}  // namespace gearshift::demo
