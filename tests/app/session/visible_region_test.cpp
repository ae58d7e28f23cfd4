// The view straight ahead is centred in the part of the window that the panel leaves free.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "app/cabin/view/cabin_view.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using doctest::Approx;

TEST_CASE("the cabin is centred in the free part, and the field of view spans that part's shorter side") {
  const double field = 72.0 * std::numbers::pi / 180.0;
  struct Case {
    glm::dvec2 size;
    VisibleRegion visible, expected;
  };
  const VisibleRegion all, next_to_panel{{0.25, 0.0}, {0.75, 0.9}}, right{{0.0, 0.0}, {0.52, 0.8}},
      slit{{0.48, 0.0}, {0.52, 0.9}};
  for (const Case& c : {Case{{1280, 720}, all, all}, Case{{1280, 720}, next_to_panel, next_to_panel},
                        Case{{640, 720}, right, right}, Case{{640, 720}, slit, all}, Case{{320, 900}, all, all}}) {
    const View view = view_from(EyePose{}, fov_around(field, c.size, c.visible), 0.05);
    const glm::dvec2 low = c.expected.low * c.size, high = c.expected.high * c.size, middle = 0.5 * (low + high);
    const glm::dvec3 ahead = project(view, {0.0, 0.0, -3.0}, c.size);
    CHECK(ahead.x == Approx(middle.x).epsilon(1e-5));
    CHECK(ahead.y == Approx(middle.y).epsilon(1e-5));
    const double half = 0.5 * std::min(high.x - low.x, high.y - low.y), tangent = std::tan(0.5 * field);
    const glm::dvec3 right_edge = project(view, {3.0 * tangent, 0.0, -3.0}, c.size);
    const glm::dvec3 top_edge = project(view, {0.0, 3.0 * tangent, -3.0}, c.size);
    CHECK(right_edge.x - middle.x == Approx(half).epsilon(1e-4));
    CHECK(middle.y - top_edge.y == Approx(half).epsilon(1e-4));
  }
}
