#include "engine/render/pass_data.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gearshift::engine {

glm::mat4 clip_from_world(const View& view) {
  return view.clip_from_view * view.view_from_world;
}

void set_views(shader::PassData& data, std::span<const View> views) {
  for (std::size_t eye = 0; eye < views.size(); ++eye) {
    const glm::mat4& clip = views[eye].clip_from_view;
    const glm::mat3 world_from_view = glm::transpose(glm::mat3(views[eye].view_from_world));
    data.clip_from_world[eye] = clip_from_world(views[eye]);
    data.eye[eye] = glm::vec4(views[eye].eye, 1.0f);
    // The projection matrix P gives x_clip = P00 x + P20 z and w = -z. So the view direction with z = -1 has x =
    // (x_clip + P20) / P00, and y likewise.
    const glm::vec3 centre(clip[2][0] / clip[0][0], clip[2][1] / clip[1][1], -1.0f);
    data.sky_centre[eye] = glm::vec4(world_from_view * centre, 0.0f);
    data.sky_right[eye] = glm::vec4(world_from_view[0] / clip[0][0], 0.0f);
    data.sky_down[eye] = glm::vec4(world_from_view[1] / clip[1][1], 0.0f);
  }
}

void set_sun(shader::PassData& data, const FrameScene& scene) {
  data.towards_sun = glm::vec4(glm::normalize(scene.sun.towards), 0.0f);
  data.sun = glm::vec4(scene.sun.irradiance, scene.exposure);
}

void set_shadow(shader::PassData& data, const ShadowFit& fit, int side) {
  data.shadow_from_world = fit.shadow_from_world;
  data.shadow_texel = {fit.texel, static_cast<float>(side), 0.0f, 0.0f};
}

void set_mirror(shader::PassData& data, const MirrorWindow& window) {
  data.mirror_u = window.u_row();
  data.mirror_v = window.v_row();
}

}  // namespace gearshift::engine
