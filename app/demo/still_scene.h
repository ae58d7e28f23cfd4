// Makes a scene of a model at rest: every node has the transform from the file, and skins are posed once.
#pragma once

#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"

namespace gearshift::demo {

engine::FrameScene still_scene(const engine::Model& model);

struct FittingView {
  engine::EyePose eye;
  double nearest = 0.0;  // [m] > 0: lower bound of the distance between model and eye
};

// A view from the front, right and above, far enough away to show the whole model. field [rad]: field of view across
// the shorter side of the image.
FittingView fitting_view(const engine::Model& model, double field);

}  // namespace gearshift::demo
