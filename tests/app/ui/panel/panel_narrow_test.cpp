// The panel in windows and in a headset's eye that are narrower than the panel's layout needs.
#include <cmath>

#include <doctest/doctest.h>

#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.min.x < b.max.x - 1.0 && b.min.x < a.max.x - 1.0 && a.min.y < b.max.y - 1.0 && b.min.y < a.max.y - 1.0;
}

}  // namespace

TEST_CASE("STOP is shown at any width, Arm from 300 pixels on, and nothing in the status bar overlaps") {
  PanelRig rig;
  rig.input.message.clear();
  for (int width = 60; width <= 1600; width += 20) {
    CAPTURE(width);
    rig.screen.width = static_cast<float>(width);
    rig.frame();
    rig.frame();
    const ControlRect stop = rig.rect("stop");
    CHECK(stop.min.x >= 0.0);
    CHECK(stop.max.x <= width);
    CHECK(stop.max.x - stop.min.x >= 40.0);
    if (width >= 300) CHECK(rig.panel.control_rect("arm").has_value());
    std::vector<PixelBox> boxes;
    for (const DrawnText& text : drawn_texts())
      if (text.box.min.y > 720.0 - 65.0) boxes.push_back(text.box);
    for (const char* name : {"stop", "arm", "record", "replay"}) {
      const auto found = rig.panel.control_rect(name);
      if (!found) continue;
      for (const PixelBox& box : boxes) {
        const bool inside = box.min.x >= found->min.x && box.max.x <= found->max.x;
        CHECK((inside || !overlap(box, {found->min, found->max})));
      }
    }
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j) CHECK_FALSE(overlap(boxes[i], boxes[j]));
  }
}

TEST_CASE("if both columns leave no room between them, the plots are omitted and the tuning remains complete") {
  TuningRig rig;
  for (const float width : {640.0f, 800.0f, 1000.0f, 1280.0f}) {
    CAPTURE(width);
    rig.screen.width = width;
    rig.frame();
    rig.frame();
    CHECK(rig.panel.control_rect("reset_view").has_value() == (width >= 1000.0f));
    const ControlRect slider = rig.rect("wall_stiffness_n_per_m"), middle = rig.panel.cabin_area();
    CHECK(slider.max.x - slider.min.x > 200.0);
    CHECK(slider.min.x >= middle.max.x);
    CHECK(middle.max.x - middle.min.x > 0.3 * static_cast<double>(width));
    CHECK(middle.max.y <= rig.rect("stop").min.y);
    CHECK_FALSE(rig.panel.covers(0.5 * (middle.min + middle.max)));
  }
  rig.panel.set_visible(false);
  rig.frame();
  CHECK(rig.panel.cabin_area().max == glm::dvec2(1280.0, 720.0));
}
