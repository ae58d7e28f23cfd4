#include "app/cabin/stage/roadside.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine/model/assemble.h"
#include "engine/model/gltf.h"

namespace gearshift::test {
namespace {

const engine::Model& road_model() {
  static const engine::Model loaded = [] {
    engine::Model model;
    cabin::Roadside::add_to(model, engine::read_gltf(GEARSHIFT_ASSETS "/models/road.glb"));
    return model;
  }();
  return loaded;
}

const engine::Mesh& mesh_of(std::string_view node) {
  const int index = road_model().node(node);
  REQUIRE(index != engine::kNone);
  return road_model().meshes[static_cast<std::size_t>(road_model().nodes[static_cast<std::size_t>(index)].mesh)];
}

std::string block_name(int block) {
  return "RoadBlock" + std::to_string(block);
}

double z_of(const std::vector<engine::Node>& pose, const std::string& name) {
  return static_cast<double>(pose[static_cast<std::size_t>(road_model().node(name))].translation.z);
}

}  // namespace

TEST_CASE("no roadside object is on the road or reaches beyond its block") {
  for (int block = 0; block < cabin::kBlocks; ++block) {
    const engine::Mesh& mesh = mesh_of(block_name(block));
    CHECK(mesh.vertex_count > 500);
    for (std::uint32_t i = 0; i < mesh.vertex_count; ++i) {
      const glm::vec3 p = road_model().vertices[mesh.first_vertex + i].position;
      CHECK((p.x <= -5.7f || p.x >= 2.2f));
      CHECK(p.z <= 6.0f);
      CHECK(p.z >= -126.0f);
    }
  }
}

TEST_CASE("a sunken block shows nothing above the fields") {
  float highest = 0.0f;
  for (int block = 0; block < cabin::kBlocks; ++block) {
    for (const engine::Primitive& p : mesh_of(block_name(block)).primitives) highest = std::max(highest, p.high.y);
  }
  CHECK(highest > 5.0f);
  CHECK(static_cast<double>(highest) + cabin::kHiddenHeight < -0.5);
}

TEST_CASE("no two blocks look alike") {
  for (int a = 0; a < cabin::kBlocks; ++a) {
    for (int b = a + 1; b < cabin::kBlocks; ++b) {
      const engine::Mesh& first = mesh_of(block_name(a));
      const engine::Mesh& second = mesh_of(block_name(b));
      bool same = first.vertex_count == second.vertex_count;
      for (std::uint32_t i = 0; same && i < first.vertex_count; ++i) {
        same = road_model().vertices[first.first_vertex + i].position ==
               road_model().vertices[second.first_vertex + i].position;
      }
      CHECK_FALSE(same);
    }
  }
}

TEST_CASE("the road moves towards a driving car, at the car's speed, also after a thousand kilometres") {
  const cabin::Roadside road(road_model());
  std::vector<engine::Node> pose = road_model().nodes;
  for (const double start : {0.5, 1e6 + 0.5}) {
    road.place(start, 0.0, pose);
    const double strip = z_of(pose, "RoadStrip"), block = z_of(pose, block_name(2));
    road.place(start + 0.25, 0.0, pose);
    CHECK(z_of(pose, "RoadStrip") - strip == doctest::Approx(0.25).epsilon(1e-4));
    CHECK(z_of(pose, block_name(2)) - block == doctest::Approx(0.25).epsilon(1e-3));
    road.place(start, 0.0, pose);  // the car reverses to the start
    CHECK(z_of(pose, "RoadStrip") == strip);
  }
}

TEST_CASE("uphill by 10 % the road rises 10 m in 100 m ahead of the car and falls behind it; the hills do not move") {
  const cabin::Roadside road(road_model());
  std::vector<engine::Node> level = road_model().nodes, hill = level;
  const double slope = std::atan(0.10);
  // A point of a node is at `at` on the level road. Returns the place of this point on the slope.
  const auto moved = [&](const char* name, glm::vec3 at) {
    const engine::Node& from = level[static_cast<std::size_t>(road_model().node(name))];
    const engine::Node& to = hill[static_cast<std::size_t>(road_model().node(name))];
    return glm::vec3(to.local() * glm::inverse(from.local()) * glm::vec4(at, 1.0f));
  };
  for (const double distance : {3.0, 7777.7}) {
    road.place(distance, 0.0, level);
    road.place(distance, slope, hill);
    for (const char* name : {"RoadStrip", "Land", "RoadBlock0", "RoadBlock3", "RoadBlock5"}) {
      CAPTURE(name);
      for (const float ahead : {-50.0f, 0.0f, 100.0f, 400.0f}) {
        const glm::vec3 at = moved(name, {0.335f, -0.53f, -ahead});
        CHECK(at.x == doctest::Approx(0.335).epsilon(1e-4));
        CHECK(at.y + 0.53f == doctest::Approx(ahead * std::sin(slope)).epsilon(1e-3));
        CHECK(-at.z == doctest::Approx(ahead * std::cos(slope)).epsilon(1e-3));
      }
    }
    const glm::vec3 hills{100.0f, 20.0f, -500.0f};
    CHECK(glm::distance(moved("Hills", hills), hills) < 1e-6f);
  }
}

TEST_CASE("in reverse on a slope the road moves parallel to itself, away and up") {
  const cabin::Roadside road(road_model());
  std::vector<engine::Node> pose = road_model().nodes;
  const double slope = 0.15;
  const auto strip = [&] { return pose[static_cast<std::size_t>(road_model().node("RoadStrip"))].translation; };
  road.place(6.0, slope, pose);
  const glm::vec3 before = strip();
  road.place(5.5, slope, pose);
  CHECK(strip().z - before.z == doctest::Approx(-0.5 * std::cos(slope)).epsilon(1e-4));
  CHECK(strip().y - before.y == doctest::Approx(0.5 * std::sin(slope)).epsilon(1e-4));
}

TEST_CASE("the strip extends from behind the mirrors' view to the hills, at any position of the car") {
  double near = -1e9, far = 1e9;
  for (const engine::Primitive& p : mesh_of("RoadStrip").primitives) {
    near = std::max(near, static_cast<double>(p.high.z));
    far = std::min(far, static_cast<double>(p.low.z));
  }
  CHECK(near > 100.0);
  CHECK(far + cabin::kTileLength < -420.0);
}

TEST_CASE("the road needs at most 11 draws and 12000 triangles") {
  CHECK(engine::draw_count(road_model()) <= 11);
  CHECK(road_model().triangle_count() <= 12000);
  MESSAGE(engine::draw_count(road_model()) << " draws, " << road_model().triangle_count() << " triangles");
}

}  // namespace gearshift::test
