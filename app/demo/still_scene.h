// Makes a scene of a model at rest: every node has the transform from the file, and each skin is posed once.
#pragma once

#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"

namespace gearshift::demo {

engine::FrameScene still_scene(const engine::Model& model);

struct FittingView {
  engine::EyePose eye;
  double nearest = 0.0;  // [m] > 0: the model is at least this far from the eye
};

// A view from the front, right and above, from far enough away to show the whole model. `field` [rad]: field of view
// across the shorter side of the image.
FittingView fitting_view(const engine::Model& model, double field);

}  // namespace gearshift::demo
