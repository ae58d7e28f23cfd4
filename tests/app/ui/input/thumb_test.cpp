// A simulated thumb shifts through the gates with a gamepad's stick. The stick has only a deflection, and springs back
// to its centre.
#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>

#include "app/ui/input/driver_input.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"
#include "haptics/loop/haptic_loop.h"
#include "tests/support/controllers.h"
#include "tests/support/gates.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;
using glm::dvec2;

namespace {

constexpr int kCyclesPerFrame = 16;
constexpr double kThumbFrame = 1e-3 * kCyclesPerFrame;  // [s]
constexpr int kReactionFrames = 9;                      // frames in the user's reaction time of about 0.15 s

// The shipped bindings of a gamepad, a thumb on the pad's stick, and a simulated lever in a gripping hand. The thumb
// sees the lever with a delay, the reaction time.
class ThumbDesk {
 public:
  ThumbDesk(const Gate& gate, LeverMode mode)
      : gate_(gate),
        bindings_(shipped(mode)),
        driver_({bindings_}),
        hand_(target_, 0.001),
        lever_(gripped(), 1'000'000, hand_),
        loop_({}, gate_, lever_, load_, inputs_) {
    driver_.set_gate(gate_, lever_.spec());
    loop_.arm();
    input_.controllers = {gamepad({})};
    rest(0.8);
  }

  // Shifts into `gear` by watching the lever's picture. In mode `moves` the deflection sets the hand's speed and grows
  // with the distance to the target. In mode `places` the deflection sets the hand's position. Returns false if the
  // shift takes more than 8 s.
  bool shift(int gear) {
    free_reverse(gear == kReverseGear);
    lean_ = {0.0, 0.0};
    for (double time = 0.0; time < 8.0; time += kThumbFrame) {
      if (loop_.snapshot().gear == gear && at_rest_of(gear)) {
        free_reverse(false);
        return true;
      }
      const dvec2 aim = waypoint(gear);
      thumb(bindings_.lever.mode == LeverMode::moves ? towards(aim) : hold_deflection(aim));
      frame();
    }
    return false;
  }

  // Keeps the stick deflected so that the lever stays in the gear.
  void hold(int gear, double seconds) {
    for (double time = 0.0; time < seconds; time += kThumbFrame) {
      thumb(hold_deflection(rest_position(gate_, gear)));
      frame();
    }
  }
  void rest(double seconds) {
    thumb({0.0, 0.0});
    for (double time = 0.0; time < seconds; time += kThumbFrame) frame();
  }
  int gear() const { return loop_.snapshot().gear; }
  const Gate& gate() const { return gate_; }

 private:
  static Bindings shipped(LeverMode mode) {
    Bindings bindings = read_bindings(GEARSHIFT_ASSETS "/bindings/default.toml");
    bindings.lever.mode = mode;
    return bindings;
  }
  static SimulatedLeverConfig gripped() {
    SimulatedLeverConfig config;
    config.hand = kGripHand;
    return config;
  }

  bool at_rest_of(int gear) const { return std::abs(visible_lever().y - rest_position(gate_, gear).y) < 0.006; }
  dvec2 visible_lever() const { return picture_.empty() ? dvec2{0.0, 0.0} : picture_.front(); }

  // The next target on the way out of the old slot, along the aisle and into the new slot. Once the lever is in the new
  // slot's column, the target is the gear's rest position. This is in the middle of the column, so the thumb keeps
  // pushing against the force that centres the lever.
  dvec2 waypoint(int gear) const {
    const dvec2 to = rest_position(gate_, gear), at = visible_lever();
    const bool in_column = std::abs(at.x - to.x) < 0.004;
    const bool in_aisle = std::abs(at.y) < gate_.half_aisle;
    if (in_column) return to;
    return {in_aisle ? to.x : at.x, 0.0};
  }

  // The deflection at which the hand would reach `aim` in 0.3 s; the hand's speed grows with the square of the
  // deflection. A thumb cannot hold a deflection below a fifth.
  dvec2 towards(dvec2 aim) const {
    dvec2 deflection{0.0, 0.0};
    for (int i = 0; i < 2; ++i) {
      const double distance = aim[i] - visible_lever()[i], fraction = std::abs(distance) / 0.3 / bindings_.lever.speed;
      if (std::abs(distance) > 0.0015)
        deflection[i] = std::copysign(std::clamp(std::sqrt(fraction), 0.2, 1.0), distance);
    }
    return deflection;
  }

  // The deflection that holds the lever at `aim`. The longer the lever stays away from `aim`, the further the hand's
  // target moves past `aim`, up to 25 mm. This pulls the lever over detents and against the centring.
  dvec2 hold_deflection(dvec2 aim) {
    lean_ = glm::clamp(lean_ + 4.0 * kThumbFrame * (aim - visible_lever()), -0.025, 0.025);
    return glm::clamp((aim + lean_) / hand_reach(gate_, lever_.spec()), -1.0, 1.0);
  }

  // Sets the deflection that the thumb wants. frame() moves the thumb there, at most from end to end in a fifth of a
  // second, and adds a tremor.
  void thumb(dvec2 wanted) { wanted_ = wanted; }
  void free_reverse(bool down) {  // pushes the knob and lifts the ring, as the lockout requires
    for (const Action action : {Action::push_down, Action::lift})
      for (const int button : bindings_.pad_buttons.at(action))
        input_.controllers[0].gamepad->buttons[static_cast<std::size_t>(button)] = down ? 1 : 0;
  }

  float raw_of(const AxisBinding& axis, double deflection) const {
    const double zone = axis.dead_zone, live = 1.0 - axis.dead_zone - axis.end_zone;
    const double fraction = deflection == 0.0 ? 0.0 : std::copysign(zone + live * std::abs(deflection), deflection);
    return static_cast<float>(0.5 * (axis.from + axis.to) + 0.5 * (axis.to - axis.from) * fraction);
  }

  void frame() {
    ++frames_;
    thumb_ = glm::clamp(wanted_, thumb_ - kThumbFrame * 10.0, thumb_ + kThumbFrame * 10.0);
    const dvec2 tremor = 0.03 * dvec2{std::sin(1.3 * frames_), std::sin(1.9 * frames_)};
    auto& axes = input_.controllers[0].gamepad->axes;
    axes[static_cast<std::size_t>(bindings_.lever_select->axis)] = raw_of(*bindings_.lever_select, thumb_.x + tremor.x);
    axes[static_cast<std::size_t>(bindings_.lever_shift->axis)] = raw_of(*bindings_.lever_shift, thumb_.y + tremor.y);
    if (thumb_ == dvec2{0.0, 0.0})
      for (const auto& axis : {bindings_.lever_select, bindings_.lever_shift})
        axes[static_cast<std::size_t>(axis->axis)] = 0.05f;  // a real stick never returns exactly to its centre
    driver_.feel(loop_.snapshot().lever);
    driver_.update(input_, kThumbFrame, false, false);
    target_.write(driver_.hand());
    for (int i = 0; i < kCyclesPerFrame; ++i) loop_.cycle(now_ += 1'000'000, 0);
    picture_.push_back(loop_.snapshot().proxy);
    if (picture_.size() > kReactionFrames) picture_.pop_front();
  }

  Gate gate_;
  Bindings bindings_;
  DriverInput driver_;
  LatestValue<HandTarget> target_;
  SmoothedHand hand_;
  SimulatedLever lever_;
  NoLoad load_;
  LoopInputs inputs_;
  HapticLoop loop_;
  WindowInput input_;
  std::deque<dvec2> picture_;
  dvec2 wanted_{0.0}, thumb_{0.0}, lean_{0.0};
  double frames_ = 0.0;
  std::int64_t now_ = 0;
};

std::vector<int> gears_of(const Gate& gate) {
  std::vector<int> gears;
  for (const Slot& slot : slots(gate)) gears.push_back(slot.gear);
  std::sort(gears.begin(), gears.end());
  return gears;
}

}  // namespace

TEST_CASE("in mode `moves` a thumb reaches every gear, and a gear stays engaged after the stick is released") {
  for (const char* name : {"paper", "six_speed_r_left_up"}) {
    ThumbDesk desk(shipped_gate(name), LeverMode::moves);
    for (const int gear : gears_of(desk.gate())) {
      CAPTURE(name);
      CAPTURE(gear);
      REQUIRE(desk.shift(gear));
      desk.rest(1.5);
      CHECK(desk.gear() == gear);
    }
  }
}

TEST_CASE("in mode `places` a thumb reaches every gear and must hold the stick, because the gear is left on release") {
  for (const char* name : {"paper", "six_speed_r_left_up"}) {
    ThumbDesk desk(shipped_gate(name), LeverMode::places);
    for (const int gear : gears_of(desk.gate())) {
      CAPTURE(name);
      CAPTURE(gear);
      REQUIRE(desk.shift(gear));
      desk.hold(gear, 1.5);
      CHECK(desk.gear() == gear);
    }
    desk.rest(1.5);
    CHECK(desk.gear() == kNeutralGear);
  }
}
