#include "app/cabin/stage/strokes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

double area_of(const std::vector<glm::dvec2>& corners) {
  double twice = 0.0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const glm::dvec2 u = corners[i + 1] - corners[i], v = corners[i + 2] - corners[i];
    twice += u.x * v.y - u.y * v.x;
  }
  return 0.5 * twice;
}

}  // namespace

TEST_CASE("a straight stroke covers its length times its width, plus two half discs as wide as the stroke") {
  const cabin::Stroke stroke{{{0.1, 0.2}, {0.4, 0.6}}, 0.06, glm::vec3(1.0f)};
  // The two half discs together are a polygon with 12 sides.
  const double polygon = 12.0 / 2.0 * 0.03 * 0.03 * std::sin(2.0 * 3.14159265358979 / 12.0);
  CHECK(area_of(cabin::stroke_triangles(stroke)) == doctest::Approx(0.5 * 0.06 + polygon));
}

TEST_CASE("gear labels differ from each other and stay inside their box") {
  std::set<std::string> seen;
  std::vector<int> gears{haptics::kNextGear, haptics::kPreviousGear};
  for (int gear = haptics::kReverseGear; gear <= haptics::kMaxGear; ++gear) gears.push_back(gear);
  for (const int gear : gears) {
    std::string shape;
    for (const cabin::Stroke& stroke : cabin::gear_label(gear, {0.5, 0.5}, 0.2, 0.02, glm::vec3(1.0f))) {
      for (const glm::dvec2 p : stroke.line) {
        CHECK(std::abs(p.x - 0.5) <= 0.0601);
        CHECK(std::abs(p.y - 0.5) <= 0.1001);
        shape += std::to_string(p.x) + "," + std::to_string(p.y) + ";";
      }
      for (std::size_t i = 0; i < cabin::stroke_triangles(stroke).size(); i += 3) {
        const auto corners = cabin::stroke_triangles(stroke);
        CHECK(area_of({corners[i], corners[i + 1], corners[i + 2]}) > -1e-9);
      }
    }
    CHECK(seen.insert(shape).second);
  }
}

TEST_CASE("every letter has a shape of its own inside its box, and a text is as long as text_length says") {
  const std::string all = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789abcdefgjloqrstuvwyz";
  std::set<std::string> seen;
  for (const char letter : all) {
    CAPTURE(letter);
    std::string shape;
    for (const cabin::Stroke& stroke : cabin::text_strokes({&letter, 1}, {0.5, 0.5}, 0.2, 0.02, glm::vec3(1.0f))) {
      for (const glm::dvec2 p : stroke.line) {
        CHECK(std::abs(p.x - 0.5) <= 0.0625);
        CHECK(std::abs(p.y - 0.5) <= 0.109);
        shape += std::to_string(p.x) + "," + std::to_string(p.y) + ";";
      }
    }
    CHECK(seen.insert(shape).second);
  }
  CHECK(cabin::text_length("10") == doctest::Approx(1.44));
}

TEST_CASE("a place's label lies beside all aisles where there is room") {
  const haptics::Gate gate = shipped_gate("selector_p_r_n_d");
  for (const haptics::Slot& place : haptics::slots(gate)) {
    const glm::dvec2 size{0.004, 0.006}, at = cabin::label_place(gate, place, size, 0.002);
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) CHECK_FALSE(haptics::in_free_space(gate, at + glm::dvec2(x, y) * size));
    CHECK(glm::distance(at, place.at) < 0.014);
  }
}

TEST_CASE("a six rotated by 180 degrees is a nine") {
  const engine::Image six =
      cabin::draw_strokes(cabin::gear_label(6, {0.5, 0.5}, 0.8, 0.1, glm::vec3(1.0f)), 64, glm::vec3(0.0f));
  const engine::Image nine =
      cabin::draw_strokes(cabin::gear_label(9, {0.5, 0.5}, 0.8, 0.1, glm::vec3(1.0f)), 64, glm::vec3(0.0f));
  int worst = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) worst = std::max(worst, std::abs(six.pixel(x, y)[0] - nine.pixel(63 - x, 63 - y)[0]));
  }
  CHECK(worst <= 1);
}

TEST_CASE("a drawn stroke covers as many pixels as its area") {
  const cabin::Stroke stroke{{{0.2, 0.5}, {0.8, 0.5}}, 0.1, glm::vec3(1.0f)};
  const engine::Image image = cabin::draw_strokes({stroke}, 256, glm::vec3(0.0f));
  double ink = 0.0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) ink += image.rgba[i] > 127 ? 1.0 : 0.0;
  CHECK(ink / (256.0 * 256.0) == doctest::Approx(0.6 * 0.1 + 3.14159265 * 0.05 * 0.05).epsilon(0.02));
  CHECK(image.pixel(128, 128)[0] == 255);
  CHECK(image.pixel(10, 10)[0] == 0);
}

TEST_CASE("the knob of every shipped gate shows each gear once, inside a round cap") {
  std::vector<std::string> names = shipped_names();
  names.insert(names.end(), std::begin(kMechanisms), std::end(kMechanisms));
  for (const std::string& name : names) {
    CAPTURE(name);
    const haptics::Gate gate = shipped_gate(name);
    for (const cabin::Stroke& stroke : cabin::shift_pattern(gate, glm::vec3(1.0f), glm::vec3(1.0f, 0.0f, 0.0f))) {
      for (const glm::dvec2 p : stroke.line) CHECK(glm::distance(p, glm::dvec2(0.5)) + 0.5 * stroke.width < 0.5);
    }
  }
}

}  // namespace gearshift::test
