#include "app/session/ui_scale.h"

#include <cmath>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

#include "app/cabin/headset/hanging_panel.h"
#include "app/cabin/view/headset_view.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift::cabin;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;

TEST_CASE("the panel grows with the picture above 1080 lines, and with the display's own scale") {
  UiScale scale;
  CHECK(scale.follow(720, 1.0f) == 1.0f);
  CHECK(scale.follow(1080, 1.0f) == 1.0f);
  CHECK(scale.follow(2160, 1.0f) == 2.0f);
  CHECK(scale.follow(720, 1.5f) == 1.5f);
  CHECK(scale.follow(2160, 1.5f) == 2.0f);
}

TEST_CASE("a height dragged from 1080 to 2160 lines gives five scales in all, none too large for the picture") {
  UiScale scale;
  std::set<float> scales;
  for (int height = 1080; height <= 2160; ++height) {
    const float now = scale.follow(height, 1.0f);
    CHECK(now <= static_cast<float>(height) / 1080.0f);
    scales.insert(now);
  }
  CHECK(scales == std::set<float>{1.0f, 1.25f, 1.5f, 1.75f, 2.0f});
}

TEST_CASE("a minimised window keeps its scale") {
  UiScale scale;
  scale.follow(2160, 1.0f);
  CHECK(scale.follow(0, 1.0f) == 2.0f);
}

// The learner's card as seen from the driver's eyes. Current headsets have 20 to 35 px per degree, so a card with 30 px
// per degree loses little sharpness. ISO 9241-303 requires capitals to be at least 20 minutes of arc high. In the
// panel's font, capitals are 0.729 em high and lines 1.164 em (see hanging_panel_test.cpp).
TEST_CASE(
    "in a headset, the card has at least 30 px per degree, and its text has the same size with and without columns") {
  const glm::ivec2 size = HeadsetViewConfig{}.panel;
  for (const bool columns : {true, false}) {
    CAPTURE(columns);
    const float scale = UiScale::in_headset(size.x, columns);
    PanelRig rig;
    rig.screen = {static_cast<float>(size.x), static_cast<float>(size.y), 0.02f, scale};
    rig.panel.set_visible(columns);
    rig.frame();
    const ControlRect card = rig.panel.central_area();
    const HangingPanel hung =
        hang_card({}, DriveSide::left, size, card.min / glm::dvec2(size), card.max / glm::dvec2(size));
    const double px = hung.size.x / (card.max.x - card.min.x), away = glm::length(hung.pose.position);
    CHECK(std::numbers::pi / 180.0 / std::atan(px / away) >= 30.0);
    const double minutes = 60.0 * 180.0 / std::numbers::pi * std::atan(0.729 / 1.164 * 13.0 * scale * px / away);
    CHECK(minutes >= 20.0);
    CHECK(minutes <= 24.0);
  }
}
