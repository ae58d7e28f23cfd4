// Fills the uniforms of a pass.
#pragma once

#include <span>

#include "engine/render/mirror_view.h"
#include "engine/render/shadow_fit.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"
#include "shaders/shared.h"

namespace gearshift {

glm::mat4 clip_from_world(const View& view);

// At most two views, one an eye: matrices, eyes, and the directions that the sky is seen in.
void set_views(shader::PassData& data, std::span<const View> views);
void set_sun(shader::PassData& data, const FrameScene& scene);
void set_shadow(shader::PassData& data, const ShadowFit& fit, int side);
void set_mirror(shader::PassData& data, const MirrorWindow& window);

}  // namespace gearshift
