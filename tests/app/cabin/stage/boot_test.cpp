#include "app/cabin/stage/boot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/cabin/stage/lever_pose.h"
#include "engine/model/gltf.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

struct BootMesh {
  std::vector<engine::Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

const BootMesh& boot_mesh() {
  static const BootMesh loaded = [] {
    const engine::Model model = engine::read_gltf(GEARSHIFT_ASSETS "/models/cabin.glb");
    const engine::Mesh& mesh =
        model.meshes[static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(model.node("Boot"))].mesh)];
    BootMesh boot;
    boot.vertices.assign(model.vertices.begin() + mesh.first_vertex,
                         model.vertices.begin() + mesh.first_vertex + mesh.vertex_count);
    for (const engine::Primitive& p : mesh.primitives) {
      for (std::uint32_t i = 0; i < p.index_count; ++i) {
        boot.indices.push_back(model.indices[p.first_index + i] - mesh.first_vertex);
      }
    }
    return boot;
  }();
  return loaded;
}

// Lever positions in all shipped gates: the end of each slot (in its middle and at both walls) and the aisles' ends.
std::vector<glm::dvec2> places() {
  std::vector<glm::dvec2> all{{0.0, 0.0}};
  for (const std::string& name : shipped_names()) {
    const haptics::Gate gate = shipped_gate(name);
    for (const haptics::Slot& slot : haptics::slots(gate)) {
      const haptics::Column& column = haptics::column_of(gate, slot.column);
      for (const double side : {-1.0, 0.0, 1.0}) {
        all.emplace_back(column.center + side * column.half_width, static_cast<int>(slot.side) * slot.end);
      }
    }
    all.emplace_back(gate.select_min, 0.0);
    all.emplace_back(gate.select_max, 0.0);
  }
  return all;
}

// Rotates p about `axis` by `angle` [rad] with Rodrigues' formula, without quaternions.
glm::dvec3 rotated(glm::dvec3 p, glm::dvec3 axis, double angle) {
  return p * std::cos(angle) + glm::cross(axis, p) * std::sin(angle) +
         axis * glm::dot(axis, p) * (1.0 - std::cos(angle));
}

glm::dvec3 with_lever(glm::dvec3 p, glm::dvec2 plane) {
  const double off = glm::length(plane);
  if (off == 0.0) return p;
  const glm::dvec3 pivot{0.0, -0.030, 0.0};
  // The normalised cross product of (0, 1, 0) and (plane.x, 0, -plane.y).
  const glm::dvec3 axis = glm::dvec3(-plane.y, 0.0, -plane.x) / off;
  return pivot + rotated(p - pivot, axis, std::asin(off / 0.12));
}

}  // namespace

TEST_CASE("the boot's foot is fixed and its collar moves rigidly with the lever") {
  std::vector<engine::Vertex> bent;
  int foot = 0, collar = 0;
  for (const glm::dvec2 plane : places()) {
    cabin::deform_boot(boot_mesh().vertices, cabin::lever_rotation({}, plane), bent);
    double worst_foot = 0.0, worst_collar = 0.0;
    for (std::size_t i = 0; i < bent.size(); ++i) {
      const glm::dvec3 rest(boot_mesh().vertices[i].position), now(bent[i].position);
      if (rest.y <= 0.0) worst_foot = std::max(worst_foot, glm::distance(rest, now)), ++foot;
      if (rest.y >= 0.0579) {
        worst_collar = std::max(worst_collar, glm::distance(with_lever(rest, plane), now));
        ++collar;
      }
    }
    CHECK(worst_foot < 1e-7);
    CHECK(worst_collar < 1e-5);
  }
  CHECK(foot > 0);
  CHECK(collar > 0);
}

TEST_CASE("between foot and collar the boot follows the formula in the cabin model's README") {
  std::vector<engine::Vertex> bent;
  const glm::dvec2 plane{0.030, -0.040};
  cabin::deform_boot(boot_mesh().vertices, cabin::lever_rotation({}, plane), bent);
  double worst = 0.0;
  for (std::size_t i = 0; i < bent.size(); ++i) {
    const glm::dvec3 rest(boot_mesh().vertices[i].position);
    const double t = std::clamp(rest.y / 0.058, 0.0, 1.0);
    const glm::dvec3 expected = rest + (3.0 * t * t - 2.0 * t * t * t) * (with_lever(rest, plane) - rest);
    worst = std::max(worst, glm::distance(expected, glm::dvec3(bent[i].position)));
  }
  CHECK(worst < 1e-6);
}

// Where the deformation flattens a fold, a face can tilt so far that its vertex normals point to its inner side. The
// test tolerates this for at most two faces in a thousand.
TEST_CASE("the boot's faces keep their outer side in all gears of all gates") {
  std::vector<engine::Vertex> bent;
  for (const glm::dvec2 plane : places()) {
    cabin::deform_boot(boot_mesh().vertices, cabin::lever_rotation({}, plane), bent);
    int against = 0, nan = 0;
    for (std::size_t i = 0; i < boot_mesh().indices.size(); i += 3) {
      glm::vec3 p[3], n[3];
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = bent[boot_mesh().indices[i + k]].position;
        n[k] = bent[boot_mesh().indices[i + k]].normal;
        if (!(std::abs(glm::length(n[k]) - 1.0f) < 1e-4f)) ++nan;
      }
      // deform_boot() computes the normals from the derivative of the deformation. If the boot folded through itself,
      // the normals would be on the inner side of many faces.
      const glm::vec3 face = glm::cross(p[1] - p[0], p[2] - p[0]);
      if (glm::length(face) > 1e-9f && glm::dot(glm::normalize(face), n[0] + n[1] + n[2]) < 0.0f) ++against;
    }
    CAPTURE(plane.x);
    CAPTURE(plane.y);
    CHECK(nan == 0);
    CHECK(against * 500 <= static_cast<int>(boot_mesh().indices.size() / 3));
  }
}

TEST_CASE("the deformation keeps its orientation up to the corners of the yoke's workspace") {
  // The determinant of the deformation's derivative, computed from finite differences, must stay positive.
  const double step = 1e-6;
  double min_ratio = 1.0;
  for (int i = -3; i <= 3; ++i) {
    for (int j = -2; j <= 2; ++j) {
      const double x = 0.02 * i, y = 0.025 * j;
      const auto map = [&](glm::dvec3 p) {
        const double t = std::clamp(p.y / 0.058, 0.0, 1.0);
        return p + (3.0 * t * t - 2.0 * t * t * t) * (with_lever(p, {x, y}) - p);
      };
      for (const engine::Vertex& vertex : boot_mesh().vertices) {
        const glm::dvec3 p(vertex.position), at = map(p);
        const glm::dvec3 a = map(p + glm::dvec3(step, 0.0, 0.0)) - at, b = map(p + glm::dvec3(0.0, step, 0.0)) - at;
        const glm::dvec3 c = map(p + glm::dvec3(0.0, 0.0, step)) - at;
        min_ratio = std::min(min_ratio, glm::dot(glm::cross(a, b), c) / (step * step * step));
      }
    }
  }
  MESSAGE("smallest volume ratio " << min_ratio);
  CHECK(min_ratio > 0.0);
}

}  // namespace gearshift::test
