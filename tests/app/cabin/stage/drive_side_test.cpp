// A right-hand-drive cabin compared with the left-hand-drive cabin, and with the model file from which both are made.
#include "app/cabin/stage/drive_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/cabin/stage/mesh_parts.h"
#include "app/cabin/stage/stage.h"
#include "engine/model/gltf.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

constexpr const char* kFolder = GEARSHIFT_ASSETS "/models";
constexpr std::array kSides{cabin::DriveSide::left, cabin::DriveSide::right};
// [m] x of a point plus x of its mirror image. The mirror plane is at the lever, x = 0.33 m.
constexpr float kTwice = 0.66f;

cabin::StageConfig cabin_of(cabin::DriveSide side, bool open_gate = false) {
  cabin::StageConfig config;
  config.gate = shipped_gate("six_speed_r_left_up");
  config.open_gate = open_gate;
  config.drive = side;
  return config;
}

cabin::Stage stage_of(cabin::DriveSide side, bool open_gate = false) {
  return cabin::Stage(cabin_of(side, open_gate), kFolder);
}

glm::mat4 world_in(const cabin::Stage& stage, std::string_view name) {
  return stage.scene().nodes[static_cast<std::size_t>(cabin::required_node(stage.model(), name))].world;
}

glm::dvec3 place_in(const cabin::Stage& stage, std::string_view name) {
  return glm::dvec3(world_in(stage, name)[3]);
}

// All vertices of a model in its rest pose in world space, searchable by position.
class Cloud {
 public:
  explicit Cloud(const engine::Model& model) {
    const std::vector<glm::mat4> world = engine::rest_pose(model);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      if (model.nodes[i].skin != engine::kNone) continue;
      for (const cabin::MeshPart& part : cabin::transformed_parts(model, static_cast<int>(i), world[i])) {
        for (const engine::Vertex& vertex : part.mesh_data.vertices) cells_[cell(vertex.position)].push_back(vertex);
      }
    }
  }

  bool has(const engine::Vertex& wanted) const {
    for (int i = 0; i < 8; ++i) {
      const glm::vec3 aside = 0.4f * kCell * glm::vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      const auto there = cells_.find(cell(wanted.position + aside));
      if (there == cells_.end()) continue;
      if (std::any_of(there->second.begin(), there->second.end(),
                      [&](const engine::Vertex& v) { return same(v, wanted); }))
        return true;
    }
    return false;
  }

 private:
  static constexpr float kCell = 1e-3f;  // [m] size of a search cell

  static std::array<int, 3> cell(glm::vec3 p) {
    return {static_cast<int>(std::floor(p.x / kCell)), static_cast<int>(std::floor(p.y / kCell)),
            static_cast<int>(std::floor(p.z / kCell))};
  }

  static bool same(const engine::Vertex& a, const engine::Vertex& b) {
    return glm::distance(a.position, b.position) < 2e-6f && glm::distance(a.normal, b.normal) < 1e-4f &&
           glm::distance(a.tangent, b.tangent) < 1e-4f && a.uv0 == b.uv0 && a.uv1 == b.uv1;
  }

  std::map<std::array<int, 3>, std::vector<engine::Vertex>> cells_;
};

engine::Vertex mirrored(engine::Vertex vertex) {
  vertex.position.x = kTwice - vertex.position.x;
  vertex.normal.x = -vertex.normal.x;
  vertex.tangent.x = -vertex.tangent.x;
  vertex.tangent.w = -vertex.tangent.w;
  return vertex;
}

engine::Vertex moved_by(engine::Vertex vertex, float x) {
  vertex.position.x += x;
  return vertex;
}

// The nodes that are shifted along x with their children, and not mirrored. Each value is the shift [m].
const std::map<std::string_view, float> kMoved = {
    {"Cluster", 0.66f},       {"SteeringColumn", 0.66f}, {"PedalClutch", 0.66f},
    {"PedalBrake", 0.66f},    {"PedalThrottle", 0.66f},  {"RadioScreen", -0.01f},
    {"ClimatePrint", -0.01f}, {"HazardButton", -0.01f},  {"LeverPivot", 0.0f},
    {"Boot", 0.0f},           {"GatePlate", 0.0f}};

const float* displacement_of(const engine::Model& cabin, int node) {
  for (; node != engine::kNone; node = cabin.nodes[static_cast<std::size_t>(node)].parent) {
    const auto found = kMoved.find(cabin.nodes[static_cast<std::size_t>(node)].name);
    if (found != kMoved.end()) return &found->second;
  }
  return nullptr;
}

// The number of triangles whose vertex normals point away from their front face. `vertices` are in world space.
int inside_out(const engine::Model& model, std::span<const engine::Vertex> vertices, const engine::Mesh& mesh) {
  int wrong = 0;
  for (const engine::Primitive& primitive : mesh.primitives) {
    for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
      std::array<engine::Vertex, 3> v;
      for (std::uint32_t k = 0; k < 3; ++k)
        v[k] = vertices[model.indices[primitive.first_index + i + k] - mesh.first_vertex];
      const glm::vec3 face = glm::cross(v[1].position - v[0].position, v[2].position - v[0].position);
      const glm::vec3 normal = v[0].normal + v[1].normal + v[2].normal;
      wrong += glm::dot(face, normal) < -0.1f * glm::length(face) ? 1 : 0;
    }
  }
  return wrong;
}

// The number of a model's triangles with vertex normals that point to the triangle's back. The hand's skin is omitted,
// and so are the RoadBlock nodes, because the normals of their leaves point away from the tree crown's centre.
int inside_out(const engine::Model& model) {
  int wrong = 0;
  for (const engine::Node& node : model.nodes) {
    if (node.mesh == engine::kNone || node.skin != engine::kNone || node.name.starts_with("RoadBlock")) continue;
    const engine::Mesh& mesh = model.meshes[static_cast<std::size_t>(node.mesh)];
    wrong += inside_out(model, std::span(model.vertices).subspan(mesh.first_vertex, mesh.vertex_count), mesh);
  }
  return wrong;
}

const std::vector<engine::Vertex>& skin_in(const cabin::Stage& stage) {
  const int mesh = stage.model().nodes[static_cast<std::size_t>(cabin::required_node(stage.model(), "HandMesh"))].mesh;
  const auto& deformed = stage.scene().deformed;
  return std::find_if(deformed.begin(), deformed.end(), [&](const engine::DeformedMesh& d) { return d.mesh == mesh; })
      ->vertices;
}

// [m^3] The hand's volume by the divergence theorem. The sleeve is open at the elbow, so the result depends on the
// origin. The knob is the origin in both cabins.
double hand_volume(const cabin::Stage& stage) {
  const engine::Model& model = stage.model();
  const engine::Mesh& mesh = model.meshes[static_cast<std::size_t>(
      model.nodes[static_cast<std::size_t>(cabin::required_node(model, "HandMesh"))].mesh)];
  const std::vector<engine::Vertex>& skin = skin_in(stage);
  double six_times = 0.0;
  for (const engine::Primitive& primitive : mesh.primitives) {
    for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
      std::array<glm::dvec3, 3> p;
      for (std::uint32_t k = 0; k < 3; ++k)
        p[k] =
            glm::dvec3(skin[model.indices[primitive.first_index + i + k] - mesh.first_vertex].position) - stage.knob();
      six_times += glm::dot(p[0], glm::cross(p[1], p[2]));
    }
  }
  return six_times / 6.0;
}

cabin::StageInput lever_over(glm::dvec2 plane) {
  cabin::StageInput input;
  input.lever.proxy = input.lever.lever = plane;
  return input;
}

}  // namespace

TEST_CASE("the right-hand-drive body is the file's, mirrored at the lever; lever, prints, wheel and pedals are not") {
  const engine::Model cabin = engine::read_gltf(std::string(kFolder) + "/cabin.glb");
  const Cloud right(stage_of(cabin::DriveSide::right).model());
  const std::vector<glm::mat4> world = engine::rest_pose(cabin);
  int body = 0, upright = 0;
  for (std::size_t i = 0; i < cabin.nodes.size(); ++i) {
    const std::string& name = cabin.nodes[i].name;
    // Skip the door mirrors, because the stage curves their flat glass.
    if (name.starts_with("DoorMirror") && name.ends_with("Surface")) continue;
    const float* shift = displacement_of(cabin, static_cast<int>(i));
    int missing = 0;
    for (const cabin::MeshPart& part : cabin::transformed_parts(cabin, static_cast<int>(i), world[i])) {
      for (const engine::Vertex& vertex : part.mesh_data.vertices) {
        missing += right.has(shift == nullptr ? mirrored(vertex) : moved_by(vertex, *shift)) ? 0 : 1;
        ++(shift == nullptr ? body : upright);
      }
    }
    CHECK_MESSAGE(missing == 0, name);
  }
  MESSAGE(body << " vertices mirrored, " << upright << " moved");
  CHECK(body > 10000);
  CHECK(upright > 5000);
}

TEST_CASE(
    "no node has a mirroring transform on either side, and the right has no more inverted triangles than the left") {
  for (const bool open_gate : {false, true}) {
    const cabin::Stage left = stage_of(cabin::DriveSide::left, open_gate),
                       right = stage_of(cabin::DriveSide::right, open_gate);
    for (const engine::NodeState& node : right.scene().nodes) CHECK(glm::determinant(glm::mat3(node.world)) > 0.0f);
    CHECK(inside_out(right.model()) == inside_out(left.model()));
    CHECK(inside_out(right.model()) < 100);
  }
}

TEST_CASE("lever, knob, boot and gate plate are the same on both sides, at any lever position") {
  for (const bool open_gate : {false, true}) {
    cabin::Stage left = stage_of(cabin::DriveSide::left, open_gate),
                 right = stage_of(cabin::DriveSide::right, open_gate);
    for (const glm::dvec2 plane : {glm::dvec2(0.0), glm::dvec2(-0.035, 0.040), glm::dvec2(0.050, -0.030)}) {
      left.place(lever_over(plane));
      right.place(lever_over(plane));
      CHECK(glm::distance(left.knob(), right.knob()) < 1e-6);
      for (const char* name : {"Knob", "KnobCap", "LeverPivot", "GhostKnob", "Boot"}) {
        const glm::mat4 a = world_in(left, name), b = world_in(right, name);
        for (int k = 0; k < 4; ++k) CHECK(glm::distance(a[k], b[k]) < 1e-6f);
      }
    }
    if (!open_gate) continue;
    for (const char* material : {"GateMetal", "GateInk"}) {
      std::array<std::vector<engine::Vertex>, 2> plate;
      for (const auto& [stage, vertices] : {std::pair(&left, &plate[0]), std::pair(&right, &plate[1])}) {
        const engine::Model& model = stage->model();
        for (const cabin::MeshPart& part : cabin::parts_of(model, cabin::required_node(model, "Static"))) {
          if (part.material == cabin::required_material(model, material)) *vertices = part.mesh_data.vertices;
        }
      }
      REQUIRE(plate[0].size() > 100);
      REQUIRE(plate[0].size() == plate[1].size());
      for (std::size_t i = 0; i < plate[0].size(); ++i)
        CHECK(glm::distance(plate[0][i].position, plate[1][i].position) < 1e-6f);
    }
  }
}

TEST_CASE("dials, display and wheel are moved to the driver's side without rotation") {
  const cabin::Stage left = stage_of(cabin::DriveSide::left), right = stage_of(cabin::DriveSide::right);
  for (const char* name : {"TachDial", "SpeedDial", "GearPanel", "LampTurnLeft", "LampTurnRight", "ShiftUp",
                           "TachNeedle", "SteeringWheel"}) {
    CAPTURE(name);
    const glm::mat4 a = world_in(left, name), b = world_in(right, name);
    for (int k = 0; k < 3; ++k) CHECK(glm::distance(a[k], b[k]) < 1e-6f);
    CHECK(glm::distance(b[3] - a[3], glm::vec4(kTwice, 0.0f, 0.0f, 0.0f)) < 1e-6f);
  }
}

TEST_CASE("on either side, clutch, brake and throttle are in this order from left to right, in front of the driver") {
  for (const cabin::DriveSide side : kSides) {
    const cabin::Stage stage = stage_of(side);
    const double clutch = place_in(stage, "PedalClutch").x, brake = place_in(stage, "PedalBrake").x;
    const double throttle = place_in(stage, "PedalThrottle").x, driver = stage.driver_eye().position.x;
    CHECK(clutch < brake);
    CHECK(brake < throttle);
    CHECK(clutch < driver);
    CHECK(driver < throttle);
    CHECK(throttle - driver < 0.15);
  }
}

TEST_CASE("the hand on the right is the mirror image for the mirrored lever position, and no skin is inside out") {
  cabin::Stage left = stage_of(cabin::DriveSide::left), right = stage_of(cabin::DriveSide::right);
  for (const glm::dvec2 plane : {glm::dvec2(0.0), glm::dvec2(-0.035, 0.040), glm::dvec2(0.050, -0.030)}) {
    left.place(lever_over({-plane.x, plane.y}));
    right.place(lever_over(plane));
    const std::vector<engine::Vertex>&a = skin_in(left), &b = skin_in(right);
    REQUIRE(a.size() == b.size());
    float worst = 0.0f;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const engine::Vertex image = mirrored(a[i]);
      worst = std::max(worst, glm::distance(image.position, b[i].position));
      worst = std::max(worst, 1e-2f * glm::distance(image.normal, b[i].normal));
      worst = std::max(worst, 1e-2f * glm::distance(image.tangent, b[i].tangent));
    }
    CHECK(worst < 1e-5f);
    CHECK(hand_volume(left) > 5e-4);
    CHECK(hand_volume(right) == doctest::Approx(hand_volume(left)).epsilon(1e-4));
  }
  right.place(lever_over({0.0, 0.0}));
  glm::dvec3 middle(0.0);
  for (const engine::Vertex& vertex : skin_in(right)) middle += glm::dvec3(vertex.position);
  middle /= static_cast<double>(skin_in(right).size());
  CHECK(middle.x > right.knob().x + 0.01);  // the arm comes from the driver, who is on the right
}

TEST_CASE("also on the right, the ghost's hand has the same offset from the hand as the ghost's knob from the knob") {
  cabin::Stage stage = stage_of(cabin::DriveSide::right);
  cabin::StageInput input = lever_over({-0.035, 0.020});
  input.lever.lever = {-0.060, 0.020};
  input.lever.flags = haptics::kFlagGhost;
  stage.place(input);
  CHECK(glm::distance(place_in(stage, "GhostHand"), stage.ghost_knob() - stage.knob()) < 1e-6);
}

TEST_CASE("on either side the driver sees first gear's slot left of third's and ahead of second's") {
  for (const cabin::DriveSide side : kSides) {
    cabin::Stage stage = stage_of(side, true);
    const haptics::Gate gate = cabin_of(side).gate;
    const double field = cabin::camera_field("driver") * std::numbers::pi / 180.0;
    const engine::View view = engine::view_from(stage.driver_eye(), engine::symmetric_fov(field, 16.0 / 9.0), 0.05);
    const auto pixel_in = [&](int gear) {
      stage.place(lever_over(haptics::rest_position(gate, gear)));
      return engine::project(view, place_in(stage, "Knob"), {1280.0, 720.0});
    };
    const glm::dvec3 first = pixel_in(1), second = pixel_in(2), third = pixel_in(3);
    for (const glm::dvec3 at : {first, second, third}) CHECK(at.z > 0.0);
    CHECK(first.x < third.x - 5.0);
    CHECK(first.y < second.y - 5.0);
    const double to_lever = first.x - 640.0;
    CHECK((side == cabin::DriveSide::left ? to_lever : -to_lever) > 0.0);
  }
}

TEST_CASE("the interior mirror shows each driver a level view to the rear") {
  for (const cabin::DriveSide side : kSides) {
    const cabin::Stage stage = stage_of(side);
    const glm::dmat4 mirror(world_in(stage, "InteriorMirrorSurface"));
    const glm::dvec3 look = glm::normalize(glm::dvec3(mirror[3]) - stage.driver_eye().position);
    const glm::dvec3 on = glm::reflect(look, glm::dvec3(mirror[2]));
    CHECK(glm::dot(look, glm::dvec3(mirror[2])) < 0.0);
    CHECK(on.z > 0.97);
    CHECK(std::abs(on.x) < 0.2);
  }
}

TEST_CASE("on the right each camera is mirrored, and road and shadow bounds match") {
  for (const char* name : {"driver", "ahead", "lever", "gate", "cluster", "gearbox"}) {
    const engine::EyePose left = cabin::camera(name), right = cabin::camera(name, cabin::DriveSide::right);
    const glm::dvec3 ahead = left.orientation * glm::dvec3(0.0, 0.0, -1.0);
    CHECK(glm::distance(right.position, {0.66 - left.position.x, left.position.y, left.position.z}) < 1e-12);
    CHECK(glm::distance(right.orientation * glm::dvec3(0.0, 0.0, -1.0), {-ahead.x, ahead.y, ahead.z}) < 1e-12);
    CHECK((right.orientation * glm::dvec3(1.0, 0.0, 0.0)).y == doctest::Approx(0.0));  // the camera stays level
  }
  const cabin::Stage left = stage_of(cabin::DriveSide::left), right = stage_of(cabin::DriveSide::right);
  CHECK(place_in(left, "RoadStrip").x + place_in(right, "RoadStrip").x == doctest::Approx(0.66));
  const engine::ShadowBounds a = left.scene().shadow_bounds, b = right.scene().shadow_bounds;
  CHECK(a.low.x + b.high.x == doctest::Approx(0.66));
  CHECK(a.high.x + b.low.x == doctest::Approx(0.66));
  CHECK(a.low.y == b.low.y);
}

TEST_CASE("on the right too, the important parts are in the centre square of the driver camera's picture") {
  const cabin::Stage stage = stage_of(cabin::DriveSide::right);
  const double field = cabin::camera_field("driver") * std::numbers::pi / 180.0;
  const engine::View view = engine::view_from(stage.driver_eye(), engine::symmetric_fov(field, 16.0 / 9.0), 0.05);
  for (const glm::dvec3 point : {place_in(stage, "TachDial"), place_in(stage, "SpeedDial"), stage.knob()}) {
    const glm::dvec3 at = engine::project(view, point, {1280.0, 720.0});
    CHECK(at.z > 0.0);
    CHECK(at.x > 320.0);
    CHECK(at.x < 960.0);
    CHECK(at.y < 652.0);
  }
}

TEST_CASE("the gearbox model is on the passenger's side, its columns in the gate's order, its rails beyond them") {
  for (const cabin::DriveSide side : kSides) {
    cabin::StageConfig config = cabin_of(side);
    config.cutaway = true;
    const cabin::Stage stage(config, kFolder);
    const double driver = stage.driver_eye().position.x, first = place_in(stage, "GearboxSet0").x;
    CHECK(first < place_in(stage, "GearboxSet1").x);
    CHECK((side == cabin::DriveSide::left ? first > 0.33 : first < 0.33));
    const double rail = place_in(stage, "Rail0").x - first;
    CHECK(rail * (driver - first) < 0.0);
  }
}

TEST_CASE("the road sign is on the driver's side of the road and is not mirrored") {
  for (const cabin::DriveSide side : kSides) {
    const cabin::Stage stage = stage_of(side);
    const engine::Model& model = stage.model();
    const float middle = side == cabin::DriveSide::left ? 3.2f : -3.2f;  // [m] x of the road sign's centre
    double reads = 0.0;
    for (const cabin::MeshPart& part : cabin::parts_of(model, cabin::required_node(model, "RoadBlock0"))) {
      for (std::size_t i = 0; i < part.mesh_data.indices.size(); i += 3) {
        std::array<engine::Vertex, 3> v;
        for (std::size_t k = 0; k < 3; ++k) v[k] = part.mesh_data.vertices[part.mesh_data.indices[i + k]];
        const bool is_front = std::all_of(v.begin(), v.end(), [&](const engine::Vertex& vertex) {
          return std::abs(vertex.position.x - middle) < 0.6f && std::abs(vertex.position.z + 57.0f) < 0.5f &&
                 vertex.position.y > 1.0f && vertex.normal.z > 0.9f;
        });
        if (!is_front) continue;
        const glm::vec2 u = v[1].uv0 - v[0].uv0, w = v[2].uv0 - v[0].uv0;
        // v points down, so in uv the triangles of a face that is not mirrored run clockwise.
        reads -= u.x * w.y - u.y * w.x;
      }
    }
    CHECK(reads > 1e-5);
  }
}

}  // namespace gearshift::test
