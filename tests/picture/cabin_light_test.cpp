// Tests of the light in the cabin: compares the engine's windows and lining with rays that are traced in the model, and
// checks which nodes the cabin's light affects.
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/light/enclosure.h"
#include "engine/model/gltf.h"
#include "tests/picture/cabin_rig.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::test;
using glm::vec3;

namespace {

const vec3 kProbe(0.335f, 0.56f, -0.12f);  // [m]

struct Face {
  vec3 a, ab, ac;
  vec3 albedo;
};

// Mean linear colour of a picture.
vec3 mean_colour(const Image& picture) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    for (int c = 0; c < 3; ++c) sum[c] += std::pow(picture.rgba[i + static_cast<std::size_t>(c)] / 255.0, 2.2);
  return vec3(4.0 * sum / static_cast<double>(picture.rgba.size()));
}

// Returns the faces that belong neither to the glass nor to the bodywork.
std::vector<Face> lining(const Model& model) {
  std::vector<vec3> albedo;
  for (const Material& material : model.materials) {
    vec3 colour = vec3(material.base_colour) * (1.0f - material.metallic);
    if (const int map = material.base_colour_map.texture; map != kNone)
      colour *= mean_colour(model.textures[static_cast<std::size_t>(map)].pixels);
    albedo.push_back(colour);
  }
  const std::vector<glm::mat4> world = rest_pose(model);
  std::vector<Face> faces;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const Node& node = model.nodes[n];
    if (node.mesh == kNone || node.name == "Bonnet" || node.name == "Wipers" || node.name.starts_with("DoorMirror"))
      continue;
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const auto material = static_cast<std::size_t>(primitive.material);
      if (model.materials[material].alpha_mode == AlphaMode::blend) continue;
      for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
        vec3 p[3];
        for (std::uint32_t k = 0; k < 3; ++k)
          p[k] = vec3(world[n] * glm::vec4(model.vertices[model.indices[primitive.first_index + i + k]].position, 1));
        faces.push_back({p[0], p[1] - p[0], p[2] - p[0], albedo[material]});
      }
    }
  }
  return faces;
}

// Returns the nearest face that a ray from kProbe hits, or null if the ray leaves through a window. Method: Möller,
// Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997.
const Face* first_hit(const std::vector<Face>& faces, vec3 direction) {
  const Face* hit = nullptr;
  float nearest = std::numeric_limits<float>::max();
  for (const Face& face : faces) {
    const vec3 p = glm::cross(direction, face.ac);
    const float det = glm::dot(face.ab, p);
    if (std::abs(det) < 1e-12f) continue;
    const vec3 from = kProbe - face.a, q = glm::cross(from, face.ab);
    const float u = glm::dot(from, p) / det, v = glm::dot(direction, q) / det, s = glm::dot(face.ac, q) / det;
    if (u < 0.0f || v < 0.0f || u + v > 1.0f || s < 0.005f || s >= nearest) continue;
    nearest = s;
    hit = &face;
  }
  return hit;
}

}  // namespace

TEST_CASE("car_cabin() has windows where rays leave the model, and the albedo of the model's lining") {
  const std::vector<Face> faces = lining(read_gltf(GEARSHIFT_ASSETS "/models/cabin.glb"));
  const Enclosure cabin = car_cabin();
  constexpr int kRays = 1500;
  int open = 0, open_in_model = 0, agree = 0;
  struct Lining {
    vec3 albedo{0.0f}, in_model{0.0f};
    float rays = 0.0f;
  };
  std::array<Lining, 2> half;  // half[0]: below the height of kProbe; half[1]: above it
  for (int i = 0; i < kRays; ++i) {
    const float y = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / kRays, r = std::sqrt(1.0f - y * y);
    const float phi = 2.39996323f * static_cast<float>(i);
    const vec3 direction(r * std::cos(phi), y, r * std::sin(phi));
    const Face* hit = first_hit(faces, direction);
    const bool is_open = cabin.window(direction);
    open += is_open ? 1 : 0;
    open_in_model += hit == nullptr ? 1 : 0;
    agree += is_open == (hit == nullptr) ? 1 : 0;
    if (is_open || hit == nullptr) continue;
    Lining& hemisphere = half[y > 0.0f ? 1 : 0];
    hemisphere.albedo += cabin.albedo(direction);
    hemisphere.in_model += hit->albedo;
    hemisphere.rays += 1.0f;
  }
  MESSAGE("windows: " << 100.0 * open / kRays << " % of all directions, in the model " << 100.0 * open_in_model / kRays
                      << " %; " << 100.0 * agree / kRays << " % of the rays agree");
  CHECK(agree > 0.93 * kRays);
  CHECK(std::abs(open - open_in_model) < 0.03 * kRays);
  for (const Lining& lining : half) {
    const vec3 mean = lining.albedo / lining.rays, in_model = lining.in_model / lining.rays;
    MESSAGE("albedo: " << mean.x << " " << mean.y << " " << mean.z << ", in the model " << in_model.x << " "
                       << in_model.y << " " << in_model.z);
    for (int c = 0; c < 3; ++c) CHECK(std::abs(mean[c] - in_model[c]) < 0.05f);
  }
}

TEST_CASE("lit by the open sky, the console looks different; the view through the windscreen does not") {
  RenderConfig config;
  config.width = 320;
  config.height = 240;
  CabinRig rig(config);
  const StageInput input = resting_in(rig.gate, 3);
  rig.stage.place(input);
  FrameScene as_open = rig.stage.scene();
  for (NodeState& node : as_open.nodes) node.indoors = false;
  const auto photograph = [&](const FrameScene& scene, const EyePose& eye, double field) {
    const View view = cabin_view(eye, config, field);
    rig.renderer.draw(scene, {&view, 1});
    return rig.renderer.read_eye(0);
  };
  const ImageDifference lever =
      difference(photograph(rig.stage.scene(), camera("lever"), 40.0), photograph(as_open, camera("lever"), 40.0), 3);
  CHECK(lever.fraction_beyond > 0.5);
  // From an eye in front of the windscreen, only road, land and bonnet are visible.
  const EyePose outside = look_at({0.335, 0.8, -1.3}, {0.335, 0.2, -4.0});
  const ImageDifference road =
      difference(photograph(rig.stage.scene(), outside, 40.0), photograph(as_open, outside, 40.0), 0);
  CHECK(road.fraction_beyond == 0.0);
}
