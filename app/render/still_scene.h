// A model as it stands in its file: every node at rest, skins posed once.
#pragma once

#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"

namespace gearshift {

FrameScene still_scene(const Model& model);

struct FittingView {
  EyePose eye;
  double nearest = 0.0;  // [m] > 0, no part of the model is nearer to the eye
};

// From the front, the right and above, so far away that all of it is seen. field: across the shorter side. [rad]
FittingView fitting_view(const Model& model, double field);

}  // namespace gearshift
