// Renders pictures of a few triangles: models built here, a camera, a renderer, and closed-form values of shaded
// surfaces.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/render/renderer.h"
#include "tests/support/gpu_fixture.h"

namespace gearshift::test {

inline engine::Material paint(glm::vec3 colour, float roughness = 1.0f, float metallic = 0.0f) {
  engine::Material material;
  material.base_colour = glm::vec4(colour, 1.0f);
  material.roughness = roughness;
  material.metallic = metallic;
  return material;
}

// A black material that emits light.
inline engine::Material lamp(glm::vec3 colour) {
  engine::Material material = paint(glm::vec3(0.0f));
  material.emissive = colour;
  return material;
}

inline int add_material(engine::Model& model, const engine::Material& material) {
  model.materials.push_back(material);
  return static_cast<int>(model.materials.size()) - 1;
}

inline int add_node(engine::Model& model, const std::string& name, int mesh, glm::vec3 at) {
  engine::Node node;
  node.name = name;
  node.mesh = mesh;
  node.translation = at;
  model.nodes.push_back(node);
  return static_cast<int>(model.nodes.size()) - 1;
}

inline int add_mesh(engine::Model& model, const std::vector<engine::Vertex>& vertices,
                    const std::vector<std::uint32_t>& indices, int material) {
  engine::Primitive primitive;
  primitive.first_index = static_cast<std::uint32_t>(model.indices.size());
  primitive.index_count = static_cast<std::uint32_t>(indices.size());
  primitive.material = material;
  primitive.low = primitive.high = vertices.front().position;
  const auto first = static_cast<std::uint32_t>(model.vertices.size());
  for (const engine::Vertex& vertex : vertices) {
    primitive.low = glm::min(primitive.low, vertex.position);
    primitive.high = glm::max(primitive.high, vertex.position);
    model.vertices.push_back(vertex);
  }
  for (const std::uint32_t index : indices) model.indices.push_back(first + index);
  model.meshes.push_back({"", {primitive}, first, static_cast<std::uint32_t>(vertices.size())});
  return static_cast<int>(model.meshes.size()) - 1;
}

// A rectangle in the plane z = 0 facing +Z; (0, 0) of its texture is the upper left corner.
inline std::vector<engine::Vertex> rectangle(float half_width, float half_height) {
  std::vector<engine::Vertex> corners(4);
  for (int i = 0; i < 4; ++i) {
    const float x = i % 2 == 0 ? -1.0f : 1.0f, y = i / 2 == 0 ? 1.0f : -1.0f;
    corners[static_cast<std::size_t>(i)].position = {x * half_width, y * half_height, 0.0f};
    corners[static_cast<std::size_t>(i)].uv0 =
        corners[static_cast<std::size_t>(i)].uv1 = {0.5f + 0.5f * x, 0.5f - 0.5f * y};
  }
  return corners;
}
inline const std::vector<std::uint32_t> kRectangle{0, 2, 1, 1, 2, 3};

inline int add_rectangle(engine::Model& model, const std::string& name, glm::vec2 half, int material, glm::vec3 at) {
  return add_node(model, name, add_mesh(model, rectangle(half.x, half.y), kRectangle, material), at);
}

// Adds a horizontal square that faces up.
inline int add_floor(engine::Model& model, const std::string& name, float half, int material, float height) {
  std::vector<engine::Vertex> corners = rectangle(half, half);
  for (engine::Vertex& corner : corners) {
    corner.position = {corner.position.x, 0.0f, -corner.position.y};
    corner.normal = {0.0f, 1.0f, 0.0f};
  }
  return add_node(model, name, add_mesh(model, corners, kRectangle, material), {0.0f, height, 0.0f});
}

inline int add_cube(engine::Model& model, const std::string& name, float half, int material, glm::vec3 at) {
  std::vector<engine::Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 z(0.0f), x(0.0f);
      z[axis] = side;
      x[(axis + 1) % 3] = 1.0f;
      const glm::vec3 y = glm::cross(z, x);
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (engine::Vertex corner : rectangle(half, half)) {
        corner.position = corner.position.x * x + corner.position.y * y + half * z;
        corner.normal = z;
        vertices.push_back(corner);
      }
      for (const std::uint32_t index : kRectangle) indices.push_back(first + index);
    }
  }
  return add_node(model, name, add_mesh(model, vertices, indices, material), at);
}

inline engine::FrameScene scene_at_rest(const engine::Model& model) {
  engine::FrameScene scene;
  for (const glm::mat4& world : engine::rest_pose(model)) scene.nodes.push_back({.world = world});
  scene.sun.irradiance = glm::vec3(0.0f);
  return scene;
}

inline engine::Radiance constant_sky(glm::vec3 radiance) {
  return [=](glm::vec3) { return radiance; };
}

inline engine::RenderConfig small_picture(int width = 160, int height = 120) {
  engine::RenderConfig config;
  config.width = width;
  config.height = height;
  config.shadow_side = 0;
  config.mirror_height = 0;
  return config;
}

inline engine::View view_at(const engine::RenderConfig& config, const engine::EyePose& eye, double vertical = 1.0) {
  return engine::view_from(eye, engine::symmetric_fov(vertical, static_cast<double>(config.width) / config.height),
                           0.05);
}

// Display value of a radiance: Hill's ACES fit, then the transfer curve of IEC 61966-2-1, in double precision.
inline std::array<double, 3> display_values(glm::dvec3 radiance) {
  const glm::dmat3 to{{0.59719, 0.07600, 0.02840}, {0.35458, 0.90834, 0.13383}, {0.04823, 0.01566, 0.83777}};
  const glm::dmat3 from{{1.60475, -0.10208, -0.00327}, {-0.53108, 1.10813, -0.07276}, {-0.07367, -0.00605, 1.07602}};
  glm::dvec3 v = to * radiance;
  v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  v = from * v;
  std::array<double, 3> codes{};
  for (int c = 0; c < 3; ++c) {
    const double linear = std::min(std::max(v[c], 0.0), 1.0);
    codes[static_cast<std::size_t>(c)] =
        255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
  }
  return codes;
}

inline void check_displayed(const engine::Image& picture, int x, int y, glm::dvec3 radiance, double tolerance = 1.0) {
  const std::array<double, 3> expected = display_values(radiance);
  for (std::size_t c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(std::abs(picture.pixel(x, y)[c] - expected[c]) <= tolerance);
  }
}

// Centroid [px] of the pixels that are brighter than the threshold in a channel, weighted by their excess over the
// threshold; x < 0 if there are none.
inline glm::dvec2 centroid(const engine::Image& picture, int channel, int threshold = 40) {
  glm::dvec2 sum(0.0);
  double weight = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double w = picture.pixel(x, y)[channel] - threshold;
      if (w <= 0.0) continue;
      sum += w * glm::dvec2(x + 0.5, y + 0.5);
      weight += w;
    }
  }
  return weight > 0.0 ? sum / weight : glm::dvec2(-1.0);
}

}  // namespace gearshift::test
