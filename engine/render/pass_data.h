// Fills the uniforms of a pass.
#pragma once

#include <span>

#include "engine/render/mirror_view.h"
#include "engine/render/shadow_fit.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"
#include "shaders/shared.h"

namespace gearshift::engine {

glm::mat4 clip_from_world(const View& view);

// Sets matrices, eye positions, and the directions for drawing the sky. `views` holds one view per eye, at most two.
void set_views(shader::PassData& data, std::span<const View> views);
void set_sun(shader::PassData& data, const FrameScene& scene);
void set_shadow(shader::PassData& data, const ShadowFit& fit, int side);
void set_mirror(shader::PassData& data, const MirrorWindow& window);

}  // namespace gearshift::engine
