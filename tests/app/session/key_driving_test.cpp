// Lessons driven by the keyboard alone, on the virtual clock, at several frame rates: the keys are read once per frame, as
// in the window, and the driver reacts as late as a person does.
#include <functional>
#include <string>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <doctest/doctest.h>

#include "app/base/assets_path.h"
#include "app/session/session.h"
#include "app/ui/input/driver_input.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift;
using namespace gearshift::session;

namespace {

constexpr double kReaction = 0.4;  // [s] from what is seen to the key

class KeyDriver {
 public:
  KeyDriver(const std::string& lesson, double frames_per_second)
      : frame_(1.0 / frames_per_second), session_(choice(lesson)), input_({bindings()}) {
    session_.apply(ui::BeginLesson{});
    lessons_controls();
  }

  void down(int key) { window_.events.emplace_back(engine::KeyEvent{key, true, false, false, false}); }
  void up(int key) { window_.events.emplace_back(engine::KeyEvent{key, false, false, false, false}); }
  void tap(int key, int times = 1) {
    for (int i = 0; i < times; ++i) {
      down(key);
      up(key);
    }
  }
  // Waits until the driver sees it, and then for his reaction. False if the lesson is over, or it is not seen for 30 s.
  bool see(const std::function<bool()>& what) {
    for (double waited = 0.0; !what(); waited += frame_) {
      if (waited > 30.0 || is_over()) return false;
      frame();
    }
    pass(kReaction);
    return true;
  }
  void pass(double seconds) {
    for (double passed = 0.0; passed < seconds - 1e-9; passed += frame_) frame();
  }
  bool at_step(std::size_t step) const { return is_over() || session_.coach().view().now->step >= step; }
  bool is_over() const { return session_.coach().view().phase == lessons::LessonPhase::over; }
  const vehicle::VehicleState& car() const { return session_.car(); }
  const lessons::LessonResult& result() const { return *session_.coach().view().result; }

 private:
  static ui::Bindings bindings() { return ui::read_bindings(base::find_asset("bindings", "default")); }
  static SessionChoice choice(const std::string& lesson) {
    SessionChoice choice;
    choice.lesson = lesson;
    choice.help = false;
    choice.hand = "grip";
    choice.clock = runtime::RuntimeClock::virtual_time;
    choice.sound = engine::SoundOutput::none;
    choice.pedal_timing = bindings().pedal_timing;
    return choice;
  }
  void lessons_controls() {
    input_.set_gate(session_.runtime().gate(), session_.runtime().device());
    input_.recentre(session_.runtime().snapshot().lever);
    if (const auto car = session_.lever().take_switches()) input_.set_car(car->ignition, car->hand_brake);
  }
  void frame() {
    input_.feel(session_.shown().lever, session_.shown().gear);
    window_.focused = true;
    input_.update(window_, frame_, false, false);
    window_.events.clear();
    session_.lever().set_driver(input_.hand(), input_.controls(), input_.pedal_keys());
    session_.advance(frame_);
  }

  test::TempFolder folder_;
  test::Variable config_{"XDG_CONFIG_HOME", folder_.path().c_str()};
  test::Variable data_{"XDG_DATA_HOME", folder_.path().c_str()};
  double frame_;  // [s]
  Session session_;
  ui::DriverInput input_;
  engine::WindowInput window_;
};

std::string outcome(const KeyDriver& d) {
  std::string text = d.result().why;
  for (const lessons::DrivingError& error : d.result().errors) text += " | " + lessons::error_sentence(error);
  return text;
}

void hill_start_by(KeyDriver& d, double slow) {
  d.down(GLFW_KEY_A);
  REQUIRE(d.see([&] { return d.at_step(1); }));
  d.tap(GLFW_KEY_PAGE_UP);
  REQUIRE(d.see([&] { return d.at_step(2); }));
  d.tap(GLFW_KEY_D, 5);
  REQUIRE(d.see([&] { return d.car().engine_speed > 157.0; }));  // 1500 rpm
  d.up(GLFW_KEY_A);
  REQUIRE(d.see([&] { return d.at_step(3); }));
  d.pass(slow);
  d.tap(GLFW_KEY_H);
  d.see([&] { return d.is_over(); });
}
void hill_start(KeyDriver& d) {
  hill_start_by(d, 0.0);
}
// Looks for the key of the handbrake, while the clutch already holds the car.
void hesitant_hill_start(KeyDriver& d) {
  hill_start_by(d, 2.0);
}

void move_off(KeyDriver& d) {
  d.tap(GLFW_KEY_D, 3);
  d.pass(1.0);
  d.up(GLFW_KEY_A);
}

void stop(KeyDriver& d) {
  d.down(GLFW_KEY_S);
  d.down(GLFW_KEY_A);
}

void stop_and_go(KeyDriver& d) {
  d.down(GLFW_KEY_A);
  d.pass(kReaction);
  d.tap(GLFW_KEY_PAGE_UP);
  REQUIRE(d.see([&] { return d.at_step(1); }));
  d.tap(GLFW_KEY_H);
  for (std::size_t step = 2; step < 8; step += 2) {
    REQUIRE(d.see([&] { return d.at_step(step); }));
    d.up(GLFW_KEY_S);
    move_off(d);
    REQUIRE(d.see([&] { return d.at_step(step + 1); }));
    stop(d);
  }
  d.see([&] { return d.is_over(); });
}

void reverse(KeyDriver& d) {
  d.down(GLFW_KEY_A);
  REQUIRE(d.see([&] { return d.at_step(1); }));
  d.pass(1.5);
  d.tap(GLFW_KEY_PAGE_DOWN);
  REQUIRE(d.see([&] { return d.at_step(2); }));
  d.tap(GLFW_KEY_H);
  REQUIRE(d.see([&] { return d.at_step(3); }));
  move_off(d);
  REQUIRE(d.see([&] { return d.car().road_speed < -1.4; }));
  d.tap(GLFW_KEY_F, 2);
  REQUIRE(d.see([&] { return d.at_step(4); }));
  stop(d);
  REQUIRE(d.see([&] { return d.at_step(5); }));
  d.tap(GLFW_KEY_PAGE_UP, 2);
  REQUIRE(d.see([&] { return d.at_step(6); }));
  d.up(GLFW_KEY_S);
  move_off(d);
  d.see([&] { return d.is_over(); });
}

}  // namespace

TEST_CASE("hill start, stop and go, and reverse are passed by keys, alike at 5, 10, 30 and 144 frames per second") {
  const struct {
    const char* lesson;
    void (*drive)(KeyDriver&);
  } kDrives[] = {{"hill_start", hill_start},
                 {"hill_start", hesitant_hill_start},
                 {"stop_and_go", stop_and_go},
                 {"reverse", reverse}};
  for (const auto& [lesson, drive] : kDrives)
    for (const double rate : {5.0, 10.0, 30.0, 144.0}) {
      CAPTURE(lesson);
      CAPTURE(rate);
      KeyDriver driver(lesson, rate);
      drive(driver);
      INFO(outcome(driver));
      CHECK(driver.is_over());
      CHECK(driver.result().passed);
    }
}
