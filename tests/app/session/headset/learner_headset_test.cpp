// A headset in use at the lever: the user's seat in the cabin, the controllers, and how the program handles a headset
// that is lost and comes back.
#include "app/session/learner_headset.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/xr/headset_thread.h"
#include "tests/engine/window/injected_faults.h"
#include "tests/support/gates.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/temp_folder.h"
#include "tests/support/xr_runtime/control.h"

using namespace gearshift;
using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;
using glm::dvec3;
using Kind = xr_test::Event::Kind;

namespace {

constexpr double kBound = 0.020;  // [m] largest allowed offset between the felt and the drawn lever
constexpr dvec3 kUp{0.0, 1.0, 0.0};

// The true pose of the room in the cabin. With this pose, the lever is drawn where the real lever is.
const EyePose kTruth{{-0.7, -0.6, 0.9}, glm::angleAxis(0.8, kUp)};

xr_test::Pose pose_of(const EyePose& pose) {
  return {pose.position, pose.orientation};
}

// All tests share one stage, so that it is loaded only once. It is never drawn.
Stage& cabin() {
  static const auto stage = [] {
    StageConfig config;
    config.gate = shipped_gate("paper");
    return std::make_unique<Stage>(config, GEARSHIFT_ASSETS "/models");
  }();
  return *stage;
}

// Searches until a headset is found, or for at most `seconds`.
bool finds(LearnerHeadset& headset, double seconds = 20.0) {
  const auto begun = std::chrono::steady_clock::now();
  bool found = headset.is_found();
  while (!found && std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() < seconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    found = headset.is_found();
  }
  return found;
}

// Searches until there is something to report.
std::string failure(LearnerHeadset& headset) {
  std::string message = headset.take_message();
  for (int i = 0; i < 20000 && message.empty(); ++i) {
    CHECK_FALSE(finds(headset, 0.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    message = headset.take_message();
  }
  return message;
}

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

struct Worn {
  explicit Worn(HeadsetSetup wanted = {}, bool stage_space = true, bool tells_place = true, bool tells_presence = false)
      : window(320, 200, "worn"), setup(std::move(wanted)), placed(tells_place) {
    choose_software_driver();
    xr_test::Control& xr = xr_test::control();
    xr.start();
    xr.script.stage = stage_space;
    xr.script.user_presence = tells_presence;
    xr.script.stage_origin = {};  // the spaces LOCAL and STAGE coincide
    xr.script.recommended_width = 32;
    xr.script.recommended_height = 32;
    xr.script.head = [this](double) {
      xr_test::Pose pose = pose_of(head);
      pose.position_valid = placed;
      return pose;
    };
    xr.script.aim[1] = [this](double) {
      xr_test::Pose pose = pose_of(hand);
      pose.tracked = hand_tracked;
      return pose;
    };
    xr.script.inputs["/user/hand/right/input/trigger/value"] = [this](double) { return trigger ? 1.0 : 0.0; };
    xr.script.inputs["/user/hand/right/input/b/click"] = [this](double) { return menu ? 1.0 : 0.0; };
    setup.view.samples = 1;
    setup.view.panel = {320, 200};
    wear();
  }

  ~Worn() {
    headset.reset();
    xr_test::control().ends_hangs = true;
    CHECK(HeadsetThread::wait_for_ended(std::chrono::seconds(20)));
    CHECK(xr_test::complaints() == "");
  }

  void wear() {
    headset = std::make_unique<LearnerHeadset>(setup, window, ui);
    REQUIRE(finds(*headset));
    REQUIRE(headset->open());
    (void)headset->take_message();        // drops the message that names the headset
    for (int i = 0; i < 6; ++i) frame();  // until the OpenXR session has the focus
  }

  void frame() {
    // Calls turn() until a frame is shown. On a busy machine, one call may show none.
    const xr_test::Record& record = xr_test::control().record;
    const std::size_t frames = record.frames.size();
    do turn();
    while (headset->is_open() && record.frames.size() == frames && record.state >= XR_SESSION_STATE_SYNCHRONIZED &&
           record.state <= XR_SESSION_STATE_FOCUSED);
  }

  void turn() {
    window.poll();
    ui.begin({320.0f, 200.0f, 0.01f, 1.0f});
    ui.end();
    (void)headset->begin(*stage);
    if (headset->is_open()) headset->draw({}, {}, {{0.25, 0.0}, {0.75, 0.8}}, camera("driver"));
  }

  void hold_lever(glm::dvec2 plane) {
    StageInput input;
    input.lever.lever = input.lever.proxy = plane;
    stage->place(input);
  }

  // Moves the controller's tip to the top of the real knob plus `error` [m], and pulls the trigger once.
  void touch(glm::dvec2 plane, dvec3 error = dvec3(0.0)) {
    hold_lever(plane);
    hand = EyePose{inverse(kTruth) * stage->knob_top() + error, held()};
    frame();
    trigger = true;
    frame();
    trigger = false;
    frame();
  }

  // Touches the knob at three lever positions and saves the result.
  void touch_all() {
    ask(StartTouching{});
    for (const glm::dvec2 gear : {glm::dvec2(0, 0), glm::dvec2(-0.036, 0.04), glm::dvec2(0.036, -0.04)}) touch(gear);
    ask(SaveTouches{});
    frame();
  }

  void ask(const HeadsetCommand& command) { headset->apply(command, kBound); }

  gearshift::engine::Window window;
  UiContext ui;
  HeadsetSetup setup;
  Stage* stage = &cabin();
  // The head is about 13 cm from the driver's eyes, because no user sits exactly there.
  EyePose head{inverse(kTruth) * (camera("driver").position + dvec3(0.1, 0.05, -0.06)),
               glm::angleAxis(-1.1, kUp) * glm::angleAxis(-0.3, dvec3(1, 0, 0))};
  EyePose hand;
  double turns = 0.785;  // [rad] turn or tilt of the controller between touches
  int holds = 0;
  glm::dquat held() {
    const dvec3 axes[] = {kUp, kUp, dvec3(1, 0, 0)};
    const int i = holds++ % 3;
    return glm::angleAxis(i == 0 ? 0.0 : turns, axes[i]);
  }
  bool trigger = false, menu = false;
  bool placed = true;        // whether the headset tracks the head's position
  bool hand_tracked = true;  // if false, the controller's position is only an estimate
  std::unique_ptr<LearnerHeadset> headset;
};

dvec3 driver_eye(DriveSide side = DriveSide::left) {
  return camera("driver", side).position;
}

// Checks that the head is at `eye` in the cabin and that the user looks along the road.
void check_sits(const Worn& worn, dvec3 eye) {
  CHECK(glm::distance(worn.headset->head().position, eye) < 1e-6);
  const dvec3 look = worn.headset->head().orientation * dvec3(0, 0, -1);
  CHECK(std::abs(look.x) < 1e-6);
  CHECK(look.z < 0.0);
}

}  // namespace

TEST_CASE("with the headset put on or recentred, the user is at the wheel, at the chosen height, on either side") {
  for (const DriveSide side : {DriveSide::left, DriveSide::right}) {
    HeadsetSetup setup;
    setup.seat.drive = side;
    setup.seat.height = 0.03;
    Worn worn(setup);
    check_sits(worn, driver_eye(side) + 0.03 * kUp);
    worn.head.position += dvec3(0.1, 0.02, 0.0);  // the user leans, and the cabin must not follow
    worn.frame();
    CHECK(glm::distance(worn.headset->head().position, driver_eye(side) + 0.03 * kUp) > 0.09);
    worn.headset->recentre();
    worn.frame();
    check_sits(worn, driver_eye(side) + 0.03 * kUp);
  }
}

TEST_CASE("with measured distances the knob is drawn at its true distance from the eyes") {
  HeadsetSetup setup;
  setup.seat.knob = KnobDistance{0.25, 0.40, 0.35};
  Worn worn(setup);
  const dvec3 eye = worn.stage->knob_at_rest() - dvec3(0.25, -0.40, -0.35);
  check_sits(worn, eye);
}

TEST_CASE("a knob touched at three lever positions is drawn where it really is, also in the next session") {
  const TempFolder folder;
  HeadsetSetup setup;
  setup.seat_file = folder.path() / "headset.toml";
  auto today = std::make_unique<Worn>(setup);
  Worn& worn = *today;
  worn.ask(StartTouching{});
  CHECK(worn.headset->report().touching);
  for (const glm::dvec2 gear : {glm::dvec2(0, 0), glm::dvec2(-0.036, 0.04), glm::dvec2(0.036, -0.04)}) worn.touch(gear);
  CHECK(worn.headset->report().touches == 3);
  // The seat file is written only when the touches are saved.
  CHECK(read_seat(setup.seat_file).touched.has_value() == false);
  CHECK(worn.headset->report().worst_touch < 1e-4);
  worn.ask(SaveTouches{});
  worn.frame();
  CHECK(glm::distance(worn.headset->head().position, kTruth * worn.head.position) < 1e-3);
  worn.headset->recentre();  // recentring must not move the touched lever
  worn.frame();
  CHECK(glm::distance(worn.headset->head().position, kTruth * worn.head.position) < 1e-3);

  today.reset();

  setup.seat = read_seat(setup.seat_file);
  REQUIRE(setup.seat.touched);
  Worn tomorrow(setup);
  CHECK(glm::distance(tomorrow.headset->head().position, kTruth * tomorrow.head.position) < 1e-3);
  CHECK(tomorrow.headset->touch_error() == setup.seat.touch_error);
  tomorrow.ask(ForgetTouches{});
  tomorrow.frame();
  check_sits(tomorrow, driver_eye());
  CHECK_FALSE(read_seat(setup.seat_file).touched);
}

TEST_CASE("touches that do not fit the lever are rejected with error and limit, and nothing is saved") {
  const TempFolder folder;
  HeadsetSetup setup;
  setup.seat_file = folder.path() / "headset.toml";
  Worn worn(setup);
  worn.ask(StartTouching{});
  worn.touch({0.0, 0.0});
  worn.ask(SaveTouches{});  // one touch determines neither the room's direction nor the tip's error
  CHECK(worn.headset->take_message().find("at least three positions") != std::string::npos);
  worn.touch({-0.036, 0.04}, {0.0, 0.06, 0.0});  // the tip is 6 cm too high
  worn.touch({0.036, -0.04});
  worn.ask(SaveTouches{});
  const std::string news = worn.headset->take_message();
  int error = 0;
  REQUIRE(std::sscanf(news.c_str(),
                      "the drawn lever could be as much as %d mm away from the real one, but only 20 mm is allowed",
                      &error) == 1);
  CHECK(error >= 40);  // [mm] two thirds of the tip's error of 60 mm remain after the fit
  worn.frame();
  check_sits(worn, driver_eye());
  CHECK_FALSE(read_seat(setup.seat_file).touched);
}

TEST_CASE("touches without turning the controller are rejected, and touches while it is untracked are ignored") {
  Worn worn;
  worn.turns = 0.1;
  worn.touch_all();
  CHECK(worn.headset->take_message().find("turn the controller sideways") != std::string::npos);
  CHECK_FALSE(worn.headset->report().is_touched);
  worn.ask(ForgetTouches{});
  worn.ask(StartTouching{});
  worn.hand_tracked = false;
  worn.touch({0.0, 0.0});
  CHECK(worn.headset->report().touches == 0);
  worn.hand_tracked = true;
  worn.touch({0.0, 0.0});
  CHECK(worn.headset->report().touches == 1);
}

TEST_CASE("a lever touched in a different room is not used and stays saved: the user sits at the wheel") {
  HeadsetSetup setup;
  setup.seat.touched = kTruth;
  setup.seat.touched->position += dvec3(9.0, 0.0, 3.0);
  Worn worn(setup);
  check_sits(worn, driver_eye());
  CHECK_FALSE(worn.headset->report().is_touched);
  // Moves the head to where the saved lever is within reach.
  worn.head.position -= glm::conjugate(kTruth.orientation) * dvec3(9.0, 0.0, 3.0);
  worn.headset->recentre();
  worn.frame();
  CHECK(worn.headset->report().is_touched);
  CHECK(glm::distance(worn.headset->head().position, kTruth * worn.head.position + dvec3(9.0, 0.0, 3.0)) < 1e-6);
}

TEST_CASE("a failed opening is retried after a pause, which doubles with each failure") {
  HeadsetSetup setup;
  Worn worn(setup);
  worn.headset.reset();
  xr_test::control().start();
  xr_test::control().script.failures = {{"xrCreateSession", XR_ERROR_RUNTIME_FAILURE, 1},
                                        {"xrCreateSession", XR_ERROR_RUNTIME_FAILURE, 1}};
  worn.headset = std::make_unique<LearnerHeadset>(setup, worn.window, worn.ui);
  CHECK(failure(*worn.headset).find("xrCreateSession failed") != std::string::npos);
  const int sessions = xr_test::control().record.calls["xrCreateSession"];
  const auto attempts = [&] { return xr_test::control().record.calls["xrCreateSession"] - sessions; };
  // The pause is 2 s, and this attempt fails, too.
  for (int i = 0; i < 20 && attempts() == 0; ++i) CHECK_FALSE(finds(*worn.headset, 0.5));
  CHECK(attempts() == 1);
  CHECK(worn.headset->take_message().empty());  // an unchanged message is not reported again
  CHECK_FALSE(finds(*worn.headset, 2.0));       // the pause is 4 s
  REQUIRE(finds(*worn.headset));
  CHECK(worn.headset->open());
}

TEST_CASE("taking the headset off is reported once, a second later, but not if the user takes it off to quit") {
  for (const bool leaves : {false, true}) {
    CAPTURE(leaves);
    Worn worn;
    const double now = xr_test::control().record.frames.back().time;
    xr_test::control().script.polls_before_ready = 1000000;
    xr_test::control().script.timeline = {leaves ? xr_test::Event{now + 0.05, Kind::exit}
                                                 : xr_test::Event{now + 0.05, Kind::stopping}};
    CHECK(worn.headset->is_worn());
    for (int i = 0; i < 12; ++i) worn.frame();
    CHECK_FALSE(worn.headset->is_worn());
    CHECK(worn.headset->take_message().empty());
    std::this_thread::sleep_for(std::chrono::milliseconds(1050));
    worn.frame();
    const bool is_reported =
        worn.headset->take_message() == "the headset was taken off, so the desktop shows the cabin";
    CHECK(is_reported == !leaves);
    worn.frame();
    CHECK(worn.headset->take_message().empty());
  }
}

TEST_CASE(
    "without a persistent space, touches hold only for this session, and the saved seat of a different room is kept") {
  const TempFolder folder;
  HeadsetSetup setup;
  setup.seat_file = folder.path() / "headset.toml";
  setup.seat.touched = EyePose{{1.0, 0.0, 0.0}, glm::dquat(1, 0, 0, 0)};
  setup.is_new = true;
  Worn worn(setup, false);
  check_sits(worn, driver_eye());  // the seat does not use the saved lever, which belongs to a different room
  CHECK_FALSE(worn.headset->report().is_touched);
  worn.touch_all();
  CHECK(worn.headset->report().is_touched);
  CHECK(worn.headset->take_message().find("to this session only") != std::string::npos);
  worn.ask(RecentreSeat{});
  worn.ask(SetSeatHeight{0.02});
  REQUIRE(read_seat(setup.seat_file).touched);
  CHECK(read_seat(setup.seat_file).touched->position == glm::dvec3(1.0, 0.0, 0.0));
}

TEST_CASE("discarding new touches restores the saved ones") {
  const TempFolder folder;
  HeadsetSetup setup;
  setup.seat_file = folder.path() / "headset.toml";
  Worn worn(setup);
  worn.touch_all();
  const dvec3 before = worn.headset->head().position;
  worn.ask(StartTouching{});
  worn.touch({0.0, 0.0}, {0.3, 0.0, 0.0});
  CHECK(glm::distance(worn.headset->head().position, before) > 0.2);
  worn.ask(ForgetTouches{});
  worn.frame();
  CHECK(glm::distance(worn.headset->head().position, before) < 1e-9);
  CHECK(read_seat(setup.seat_file).touched.has_value());
}

TEST_CASE("the seat is set only while frames are shown: a headset lying on a table is calibrated when it is put on") {
  Worn worn;
  xr_test::Control& xr = xr_test::control();
  const double now = xr.record.frames.back().time;
  check_sits(worn, driver_eye());
  xr.script.timeline = {xr_test::Event{now + 0.05, Kind::stopping}, xr_test::Event{now + 0.4, Kind::ready}};
  for (int i = 0; i < 12; ++i) worn.frame();
  const EyePose worn_head = worn.head;
  worn.head = {{2.0, 0.1, 1.0}, glm::angleAxis(1.5, dvec3(0, 0, 1))};  // the headset lies on a table
  xr.script.polls_before_ready = 0;
  for (int i = 0; i < 400 && xr.record.state != XR_SESSION_STATE_SYNCHRONIZED; ++i) worn.frame();
  worn.head = worn_head;  // the user puts the headset on again
  worn.head.position += dvec3(0.3, 0.0, 0.2);
  for (int i = 0; i < 10; ++i) worn.frame();
  REQUIRE(xr.record.state == XR_SESSION_STATE_FOCUSED);
  check_sits(worn, driver_eye());
}

// Monado and WiVRn keep the session for a while: it is only not visible, or XR_EXT_user_presence tells.
TEST_CASE("a headset taken off is noticed while its session lasts, said once, and back on the head the seat is right") {
  for (const bool tells : {false, true}) {
    CAPTURE(tells);
    Worn worn({}, true, true, tells);
    xr_test::Control& xr = xr_test::control();
    xr.script.pacing = xr_test::Pacing::real;
    const auto play = [&](Kind kind, double seconds) {
      xr.script.timeline = {xr_test::Event{xr.record.frames.back().time, kind}};
      for (const Clock::time_point begun = Clock::now(); seconds_since(begun) < seconds;) worn.frame();
    };
    play(Kind::present, 0.2);
    check_sits(worn, driver_eye());
    play(tells ? Kind::absent : Kind::synchronized, 3.3);
    CHECK(worn.headset->take_message() == "the headset was taken off, so the desktop shows the cabin");
    worn.head.position += dvec3(0.3, 0.0, 0.2);  // the next user sits elsewhere
    play(tells ? Kind::present : Kind::focused, 1.0);
    check_sits(worn, driver_eye());
    CHECK(worn.headset->take_message().empty());
    play(Kind::synchronized, 0.5);  // another program is shown for a moment
    worn.head.position += dvec3(0.1, 0.0, 0.0);
    play(Kind::focused, 1.5);
    CHECK(glm::distance(worn.headset->head().position, driver_eye()) > 0.09);
    CHECK(worn.headset->take_message().empty());
  }
}

TEST_CASE(
    "without position tracking the user is at the wheel; once it works, at the wheel or, if touched, at the lever") {
  HeadsetSetup setup;
  setup.seat.height = 0.03;
  const dvec3 eye = driver_eye() + 0.03 * kUp;
  for (const bool touched : {false, true}) {
    CAPTURE(touched);
    if (touched) setup.seat.touched = kTruth;
    Worn worn(setup, true, false);
    check_sits(worn, eye);
    CHECK(worn.headset->report().orientation_only);
    const dvec3 ahead = worn.headset->head().orientation * dvec3(0, 0, -1);
    worn.head.orientation = glm::angleAxis(0.5, kUp) * worn.head.orientation;
    worn.frame();
    CHECK(glm::distance(worn.headset->head().position, eye) < 1e-6);
    const dvec3 turned = worn.headset->head().orientation * dvec3(0, 0, -1);
    CHECK(glm::distance(turned, glm::angleAxis(0.5, kUp) * ahead) < 1e-6);
    worn.placed = true;
    worn.frame();
    CHECK_FALSE(worn.headset->report().orientation_only);
    if (touched)
      CHECK(glm::distance(worn.headset->head().position, kTruth * worn.head.position) < 1e-6);
    else
      check_sits(worn, eye);
    worn.placed = false;  // losing the position for a short time must not move the view
    const dvec3 before = worn.headset->head().position;
    worn.frame();
    CHECK(glm::distance(worn.headset->head().position, before) < 1e-6);
  }
}

TEST_CASE("when the origin of the STAGE space moves, a touched lever stays where it is") {
  Worn worn;
  worn.ask(StartTouching{});
  for (const glm::dvec2 gear : {glm::dvec2(0, 0), glm::dvec2(-0.036, 0.04), glm::dvec2(0.036, -0.04)}) worn.touch(gear);
  worn.ask(SaveTouches{});
  worn.frame();
  const dvec3 before = worn.headset->head().position;
  xr_test::Control& xr = xr_test::control();
  const xr_test::Pose moved{dvec3(0.4, 0.0, -0.3), glm::angleAxis(1.2, kUp)};
  xr.script.timeline = {xr_test::change_space(xr.record.frames.back().time + 0.05, xr_test::Space::stage, moved)};
  for (int i = 0; i < 20; ++i) {
    worn.frame();
    CHECK(glm::distance(worn.headset->head().position, before) < 1e-5);
  }
}

TEST_CASE("the controller points at the learner's card, and its menu button opens the complete panel") {
  Worn worn;
  worn.frame();
  const DriveSide side = DriveSide::left;
  const HangingPanel card = hang_card(driver_eye(), side, {320.0, 200.0}, {0.25, 0.0}, {0.75, 0.8});
  // The head's first pose has placed the cabin: the head is at the driver's eyes and looks ahead.
  const EyePose cabin_from_room = seat_at_eyes(worn.head, {driver_eye(), {}}, 0.0);
  const dvec3 from{0.3, 0.2, -0.1};
  const dvec3 target = card.pose * dvec3(0.05, -0.1, 0.0);
  worn.hand = inverse(cabin_from_room) * look_at(from, target);
  worn.frame();
  REQUIRE(worn.headset->pointer());
  CHECK(worn.headset->pointer()->hit.at.x == doctest::Approx(0.5 + 0.05 / card.size.x * 0.5).epsilon(1e-4));
  CHECK_FALSE(worn.headset->pointer()->selects);
  REQUIRE(worn.headset->beam());
  CHECK(glm::distance(worn.headset->beam()->from, from) < 1e-5);
  CHECK(glm::distance(worn.headset->beam()->to, target) < 1e-5);
  worn.trigger = true;
  worn.frame();
  REQUIRE(worn.headset->pointer());
  CHECK(worn.headset->pointer()->selects);
  worn.trigger = false;
  worn.menu = true;
  worn.frame();
  worn.frame();
  const HangingPanel panel = hang_panel(driver_eye(), side, {320.0, 200.0});
  worn.hand = inverse(cabin_from_room) * look_at(from, panel.pose.position);
  worn.frame();
  worn.frame();
  REQUIRE(worn.headset->pointer());
  CHECK(worn.headset->pointer()->hit.at.x == doctest::Approx(0.5).epsilon(1e-4));
  const auto& quad = *xr_test::control().record.frames.back().quad();
  CHECK(quad.width == doctest::Approx(1.5));
  // The controller points away from the panel.
  worn.hand.orientation = glm::angleAxis(3.0, kUp) * worn.hand.orientation;
  worn.frame();
  CHECK_FALSE(worn.headset->pointer());
}

namespace {

// [s] The longest of some turns, which end when `until` holds, or after 8 s.
template <class Until>
double longest_turn(Worn& worn, const Until& until) {
  double longest = 0.0;
  for (const Clock::time_point begun = Clock::now(); !until() && seconds_since(begun) < 20.0;) {
    const Clock::time_point turned = Clock::now();
    worn.turn();
    longest = std::max(longest, seconds_since(turned));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return longest;
}

}  // namespace

// The other keys, pedals and the panel are on the thread that draws, so it must not wait for the OpenXR runtime. In
// xrWaitFrame a runtime may hold back a frame for ever. From all other calls it must return; else the headset is lost.
TEST_CASE("a runtime that hangs in a call blocks nothing, is left behind, and found again once it returns") {
  for (const char* call :
       {"xrPollEvent", "xrWaitFrame", "xrBeginFrame", "xrLocateViews", "xrAcquireSwapchainImage", "xrEndFrame"}) {
    CAPTURE(call);
    Worn worn;
    xr_test::Control& xr = xr_test::control();
    worn.frame();
    xr.script.hangs = {{call}};
    const bool may_hold = call == std::string("xrWaitFrame");
    CHECK(longest_turn(worn, [&] { return xr.hanging > 0 && worn.headset->is_held(); }) < 1.0);
    const Clock::time_point begun = Clock::now();
    CHECK(longest_turn(worn, [&] { return !worn.headset->is_open() || (may_hold && seconds_since(begun) > 6.0); }) <
          1.0);
    CHECK(worn.headset->is_open() == may_hold);
    if (!may_hold) {
      CHECK(worn.headset->take_message().find("has not answered for 5 s; the desktop") != std::string::npos);
      // OpenXR allows only one instance, and the lost one is still open.
      if (call == std::string("xrEndFrame")) CHECK_FALSE(finds(*worn.headset, 2.5));
    }
    xr.ends_hangs = true;
    if (may_hold) {
      worn.frame();
      CHECK(worn.headset->is_worn());
      continue;
    }
    CHECK(finds(*worn.headset));
    CHECK(worn.headset->open());
    worn.frame();
    CHECK(worn.headset->is_open());
  }
}

TEST_CASE("a runtime that hangs while a headset is opened is left behind after 10 s, and found again once it returns") {
  Worn worn;
  worn.headset.reset();
  xr_test::Control& xr = xr_test::control();
  REQUIRE(HeadsetThread::wait_for_ended(std::chrono::seconds(20)));
  xr.script.hangs = {{"xrCreateInstance"}};
  worn.headset = std::make_unique<LearnerHeadset>(worn.setup, worn.window, worn.ui);
  CHECK(failure(*worn.headset).find("the OpenXR runtime has not answered for 10 s; the desktop") != std::string::npos);
  xr.ends_hangs = true;
  CHECK(finds(*worn.headset));
}

TEST_CASE("a GPU lost while the OpenXR runtime holds a frame back blocks nothing, and the headset opens again later") {
  Worn worn;
  xr_test::Control& xr = xr_test::control();
  worn.frame();
  xr.script.hangs = {{"xrWaitFrame"}};
  CHECK(longest_turn(worn, [&] { return xr.hanging > 0 && worn.headset->is_held(); }) < 1.0);
  injected_faults.next_present = VK_ERROR_DEVICE_LOST;
  CHECK(longest_turn(worn, [&] { return !worn.headset->is_open(); }) < 1.0);
  CHECK_FALSE(worn.headset->is_open());
  CHECK_FALSE(finds(*worn.headset, 2.5));
  xr.ends_hangs = true;
  CHECK(finds(*worn.headset));
  CHECK(worn.headset->open());
}

TEST_CASE("a lost headset is reported once, searched for, and reopened when it is back") {
  for (const bool instance : {false, true}) {
    CAPTURE(instance);
    Worn worn;
    (void)worn.headset->take_message();
    xr_test::Control& xr = xr_test::control();
    const double now = xr.record.frames.back().time;
    xr.script.timeline = {instance ? xr_test::Event{now, Kind::instance_loss}
                                   : xr_test::Event{now, Kind::loss_pending}};
    for (int i = 0; i < 5 && worn.headset->is_open(); ++i) worn.frame();
    REQUIRE_FALSE(worn.headset->is_open());
    CHECK(worn.headset->take_message().find("the desktop shows the cabin. The lever keeps running.") !=
          std::string::npos);
    CHECK_FALSE(worn.headset->is_found());  // the search begins only after a pause
    if (instance) {
      xr.script.headset = false;
      CHECK(failure(*worn.headset).find("no headset is connected") != std::string::npos);
      CHECK_FALSE(finds(*worn.headset, 2.5));
      CHECK(worn.headset->take_message().empty());  // an unchanged message is reported only once
    }
    xr.start();
    REQUIRE(finds(*worn.headset));
    CHECK(worn.headset->open());
    worn.frame();
    CHECK(worn.headset->is_open());
  }
}

TEST_CASE("a key opens the whole panel, too, and a headset without a known controller says so") {
  Worn worn;
  CHECK(worn.headset->report().has_controller);
  CHECK_FALSE(worn.headset->take_opened());
  worn.headset->toggle_panel();
  CHECK(worn.headset->take_opened());
  worn.frame();
  CHECK(xr_test::control().record.frames.back().quad()->width == doctest::Approx(1.5));
  worn.headset->toggle_panel();
  worn.frame();
  CHECK(xr_test::control().record.frames.back().quad()->width == doctest::Approx(0.75));
  CHECK_FALSE(worn.headset->take_opened());
}
