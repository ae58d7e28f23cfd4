#include "app/train/ui_scale.h"

#include <set>

#include <doctest/doctest.h>

using namespace gearshift;

TEST_CASE("the panel grows with the picture above 1080 lines, and with the display's own scale") {
  UiScale scale;
  CHECK(scale.follow(720, 1.0f) == 1.0f);
  CHECK(scale.follow(1080, 1.0f) == 1.0f);
  CHECK(scale.follow(2160, 1.0f) == 2.0f);
  CHECK(scale.follow(720, 1.5f) == 1.5f);
  CHECK(scale.follow(2160, 1.5f) == 2.0f);
}

TEST_CASE("an edge dragged from 1080 to 2160 lines makes four other scales, and never one too large for the picture") {
  UiScale scale;
  std::set<float> scales;
  for (int height = 1080; height <= 2160; ++height) {
    const float now = scale.follow(height, 1.0f);
    CHECK(now <= static_cast<float>(height) / 1080.0f);
    scales.insert(now);
  }
  CHECK(scales == std::set<float>{1.0f, 1.25f, 1.5f, 1.75f, 2.0f});
}

TEST_CASE("a window that is minimised keeps its scale") {
  UiScale scale;
  scale.follow(2160, 1.0f);
  CHECK(scale.follow(0, 1.0f) == 2.0f);
}
