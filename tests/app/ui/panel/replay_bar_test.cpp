// A recorded drive in the panel: the commands of clicks on the replay bar, and the positions at which paths are
// drawn.
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/ui/panel/gate_view.h"
#include "app/ui/panel/palette.h"
#include "tests/app/lessons/replay/lesson_trace.h"
#include "tests/app/ui/panel/coach_views.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::ui;
using namespace gearshift::vehicle;

namespace {

struct ReplayRig : PanelRig {
  Player player{upshifts().file};

  explicit ReplayRig(bool panel_shown = false) {
    panel.set_visible(panel_shown);
    input.replay = &player;
    settle();
  }
  void settle() {
    for (int i = 0; i < 5; ++i) frame();
  }
};

}  // namespace

TEST_CASE("one click each plays, pauses, slows, closes a replay, and shows one shift or the whole drive") {
  for (const bool panel_shown : {true, false}) {
    CAPTURE(panel_shown);
    ReplayRig rig(panel_shown);
    CHECK(value(rig.click("replay_play"), &PlayReplay::on) == false);  // a click on the running replay asks for a pause
    rig.player.play(false);
    rig.frame();
    CHECK(value(rig.click("replay_play"), &PlayReplay::on) == true);
    CHECK(value(rig.click("replay_pace: 0.1"), &SetPace::pace) == 0.1);
    CHECK(value(rig.click("replay_pace: 2"), &SetPace::pace) == 2.0);
    CHECK(value(rig.click("replay_shift: 1"), &ShowShift::index) == 1);
    CHECK(has<ShowWholeDrive>(rig.click("replay_whole")));
    CHECK(has<CloseReplay>(rig.click("replay_close")));
    CHECK(rig.frame().empty());
  }
}

TEST_CASE("the scrub bar seeks over its full width within the shown part of the drive") {
  ReplayRig rig;
  for (const bool whole_drive : {true, false}) {
    CAPTURE(whole_drive);
    rig.player.select_shift(whole_drive ? std::nullopt : std::optional<std::size_t>(1));
    rig.settle();
    const double from = rig.player.from(), to = rig.player.to();
    for (const double fraction : {0.25, 0.5, 0.75}) {
      rig.point("replay_time", fraction);
      rig.frame();
      rig.events.mouse_down[0] = true;
      PanelCommands asked = rig.frame();
      rig.events.mouse_down[0] = false;
      PanelRig::merge(asked, rig.frame());
      const auto seek = find<SeekReplay>(asked);
      REQUIRE(seek);
      CHECK(std::abs(seek->time - (from + fraction * (to - from))) < 0.02 * (to - from));
    }
  }
}

TEST_CASE(
    "the scrub bar's handle is below the time line of the curves; units and both paths of a shift have a legend") {
  ReplayRig rig;
  rig.player.select_shift(std::nullopt);
  for (const double fraction : {0.0, 0.3, 1.0}) {
    rig.player.seek(rig.player.from() + fraction * (rig.player.to() - rig.player.from()));
    rig.settle();
    const ControlRect bar = rig.rect("replay_time");
    std::vector<glm::dvec2> handle = drawn_in(ui::ink::kAccent);
    std::erase_if(handle, [&](glm::dvec2 at) { return at.y < bar.min.y || at.y > bar.max.y; });
    CHECK(std::abs(box_of(handle).middle().x - (bar.min.x + fraction * (bar.max.x - bar.min.x))) < 1.0);
  }
  for (const char* unit : {"%", "rpm", "N"}) CHECK(is_drawn(unit));
  CHECK_FALSE(is_drawn("shortest"));
  rig.player.select_shift(1);
  rig.settle();
  CHECK(is_drawn("shortest"));
  CHECK(is_drawn("path"));
}

TEST_CASE("a replay names its recording's car and gate, and for a known run its learner, lesson and date") {
  ReplayRig rig(true);
  rig.input.car_name = "diesel";
  rig.input.gate_name = "four_speed";
  rig.settle();
  const auto says = [](const std::string& words) {
    const std::vector<DrawnText> texts = drawn_texts();
    return std::any_of(texts.begin(), texts.end(), [&](const DrawnText& text) {
      return text.text.find(without_blanks(words)) != std::string::npos;
    });
  };
  CHECK(says("lesson.trace"));
  CHECK(says("Hatchback"));
  CHECK(says("5-speed, R bottom right"));
  CHECK(says("not the recording's"));  // a note beside the lists of cars and gates
  rig.input.coach = half_way();
  rig.input.coach.runs.push_back({4, 1, "no date", rig.player.file().string(), result_of("hill_start", {})});
  rig.settle();
  CHECK(says("Hill start"));
  CHECK(says("Ada Example"));
  CHECK(says("no date"));
  CHECK_FALSE(says("lesson.trace"));
  rig.input.replay = nullptr;
  rig.settle();
  CHECK_FALSE(says("not the recording's"));
}

TEST_CASE("no number next to the curves touches another number or the unit, and the curves begin next to the numbers") {
  ReplayRig rig;
  for (const bool whole_drive : {true, false}) {
    rig.player.select_shift(whole_drive ? std::nullopt : std::optional<std::size_t>(1));
    rig.settle();
    const ControlRect bar = rig.rect("replay_time");
    std::vector<DrawnText> numbers = drawn_texts();
    std::erase_if(numbers, [&](const DrawnText& text) {
      const bool is_number = text.text.find_first_not_of("0123456789") == std::string::npos;
      return !is_number || text.box.min.x > bar.min.x + 60.0 || text.box.max.y > bar.min.y;
    });
    CHECK(numbers.size() >= 6);  // each of the three plots, one above the other, has at least two numbers
    for (std::size_t i = 0; i < numbers.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        CAPTURE(numbers[i].text);
        CAPTURE(numbers[j].text);
        CHECK(std::abs(numbers[i].box.min.y - numbers[j].box.min.y) > ui_font_size(UiFont::small));
      }
    double right = 0.0;
    for (const DrawnText& number : numbers) right = std::max(right, number.box.max.x);
    std::vector<glm::dvec2> engine = drawn_in(ui::ink::kEngine);
    std::erase_if(engine, [&](glm::dvec2 at) { return at.y < numbers.front().box.min.y; });  // drops the legend
    REQUIRE(engine.size() > 50);
    for (const DrawnText& number : numbers)
      for (const glm::dvec2 at : engine)
        CHECK_FALSE((at.x < number.box.max.x && at.y > number.box.min.y && at.y < number.box.max.y));
  }
}

TEST_CASE("every shift is marked at its begin, also while only one shift is shown") {
  ReplayRig rig;
  const RecordedDrive& drive = rig.player.drive();
  REQUIRE(drive.shifts().size() > 2);
  const ControlRect bar = rig.rect("replay_time");
  for (const bool whole_drive : {true, false}) {
    rig.player.select_shift(whole_drive ? std::nullopt : std::optional<std::size_t>(0));
    rig.settle();
    for (std::size_t i = 0; i + 1 < drive.shifts().size(); ++i) {
      const double fraction = (drive.shifts()[i].record.begin - drive.begin()) / (drive.end() - drive.begin());
      const ControlRect mark = rig.rect("replay_shift: " + std::to_string(i));
      CHECK(std::abs(mark.min.x - (bar.min.x + fraction * (bar.max.x - bar.min.x))) < 2.0);
      CHECK(mark.max.x < rig.rect("replay_shift: " + std::to_string(i + 1)).min.x);
    }
  }
}

TEST_CASE("the bar covers the area behind it, leaves the cabin above it free, and hides the lesson's card") {
  ReplayRig rig;
  rig.input.coach = over(result_of("hill_start", some_errors()));
  rig.settle();
  const ControlRect close = rig.rect("replay_close"), middle = rig.panel.cabin_area();
  CHECK(rig.panel.covers(0.5 * (close.min + close.max)));
  CHECK(middle.max.y < rig.rect("replay_shift: 0").min.y);
  CHECK(middle.max.y > 360.0);
  CHECK_FALSE(rig.panel.covers({640.0, middle.max.y - 2.0}));
  CHECK_FALSE(rig.panel.control_rect("lesson_again").has_value());
  rig.input.replay = nullptr;
  rig.settle();
  CHECK(rig.rect("lesson_again").min.y > rig.panel.cabin_area().max.y);
  rig.input.coach = half_way();
  rig.settle();
  CHECK(rig.panel.cabin_area().max == glm::dvec2(1280.0, 720.0));
}

TEST_CASE("a clutch that is pressed in a shift is drawn as a curve that rises at that time") {
  ReplayRig rig;
  rig.player.select_shift(1);
  rig.settle();
  // The clutch's curve has the accent colour. It is highest while the clutch pedal is down in the samples.
  double down_from = 1e9, down_to = 0.0;
  for (const DriveSample& sample : rig.player.drive().between(rig.player.from(), rig.player.to())) {
    if (sample.car.pedals.clutch < 0.93) continue;
    down_from = std::min(down_from, sample.time());
    down_to = std::max(down_to, sample.time());
  }
  REQUIRE(down_to > down_from);
  const ControlRect bar = rig.rect("replay_time");
  double below_legend = 0.0;
  for (const DrawnText& text : drawn_texts())
    if (text.text.starts_with("clutch")) below_legend = text.box.max.y;
  REQUIRE(below_legend > 0.0);
  std::vector<glm::dvec2> curve;
  for (const glm::dvec2 at : drawn_in(ui::ink::kAccent))
    if (at.y < bar.min.y && at.y > below_legend && at.x >= bar.min.x) curve.push_back(at);
  REQUIRE(curve.size() > 50);
  const double top = box_of(curve).min.y;
  double first = 1e9, last = 0.0;
  for (const glm::dvec2 at : curve) {
    if (at.y > top + 2.0) continue;  // 2 px are about 7 % of the pedal travel, which matches the limit 0.93 above
    first = std::min(first, at.x);
    last = std::max(last, at.x);
  }
  const auto time_at = [&](double x) {
    return rig.player.from() + (x - bar.min.x) / (bar.max.x - bar.min.x) * (rig.player.to() - rig.player.from());
  };
  const double pixel = (rig.player.to() - rig.player.from()) / (bar.max.x - bar.min.x);
  CHECK(std::abs(time_at(first) - down_from) < 6.0 * pixel);
  CHECK(std::abs(time_at(last) - down_to) < 6.0 * pixel);
}

TEST_CASE("in the gate the driven path is a solid line, and the ideal path is dashed") {
  const std::vector<glm::dvec2> driven{{-0.03, 0.03}, {-0.03, 0.0}, {0.0, 0.0}, {0.0, -0.03}};
  const std::vector<glm::dvec2> ideal{{-0.03, 0.03}, {-0.02, 0.0}, {0.0, -0.03}};
  UiContext ui;
  const Gate gate = paper_gate();
  HapticSnapshot now;
  const auto draw = [&](const ShownPaths& paths) {
    draw_in_window(ui, {640.0f, 480.0f}, [&] {
      draw_gate_view(ImGui::GetContentRegionAvail(), gate, describe_gate(gate), now, Trail(), 75.0, paths);
    });
  };
  draw({});
  CHECK(drawn_in(ui::ink::kDriven).empty());
  CHECK(drawn_in(ui::ink::kIdeal).empty());
  const auto disc_at = [&](glm::dvec2 place) {
    now.lever = now.proxy = place;
    draw({driven, ideal});
    return box_of(drawn_in(ui::ink::kProxy)).middle();
  };
  const glm::dvec2 zero = disc_at({0.0, 0.0});
  const double scale = disc_at({0.01, 0.0}).x - zero.x;  // [px] 10 mm in the gate view
  const auto pixel = [&](glm::dvec2 p) { return zero + 100.0 * scale * glm::dvec2(p.x, -p.y); };
  const auto distance_to = [&](const std::vector<glm::dvec2>& path, glm::dvec2 at) {
    double min = 1e9;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const glm::dvec2 a = pixel(path[i - 1]), b = pixel(path[i]);
      const double fraction = std::clamp(glm::dot(at - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
      min = std::min(min, glm::distance(at, a + fraction * (b - a)));
    }
    return min;
  };
  for (const glm::dvec2 at : drawn_in(ui::ink::kDriven)) CHECK(distance_to(driven, at) < 3.0);
  for (const glm::dvec2 at : drawn_in(ui::ink::kIdeal)) CHECK(distance_to(ideal, at) < 3.0);
  for (const glm::dvec2 corner : driven) {
    const std::vector<glm::dvec2> line = drawn_in(ui::ink::kDriven);
    CHECK(std::any_of(line.begin(), line.end(), [&](glm::dvec2 at) { return glm::distance(at, pixel(corner)) < 3.0; }));
  }
  // Each dash is a rectangle with four corners. Its length is that of its longer side.
  const std::vector<glm::dvec2> dashes = drawn_in(ui::ink::kIdeal);
  REQUIRE(dashes.size() % 4 == 0);
  double drawn = 0.0, length = 0.0;
  for (std::size_t i = 0; i < dashes.size(); i += 4)
    drawn += std::max(glm::distance(dashes[i], dashes[i + 1]), glm::distance(dashes[i], dashes[i + 2]));
  for (std::size_t i = 1; i < ideal.size(); ++i) length += glm::distance(pixel(ideal[i - 1]), pixel(ideal[i]));
  CHECK(drawn / length > 0.45);
  CHECK(drawn / length < 0.75);
}

TEST_CASE("while a drive is being loaded the bar names it, and Close cancels it") {
  PanelRig rig;
  rig.input.opening = "moving_off-20261122-000929-29480.trace";
  for (int i = 0; i < 3; ++i) rig.frame();
  CHECK(is_drawn("Opening moving_off-20261122-000929-29480.trace \u2026"));
  CHECK(has<CloseReplay>(rig.click("replay_close")));
  CHECK_FALSE(rig.panel.control_rect("replay_play").has_value());
  CHECK(rig.panel.cabin_area().max.y < rig.rect("replay_close").min.y);
}
