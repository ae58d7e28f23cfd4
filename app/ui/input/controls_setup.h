// Asks the user to move each pedal, lever and shifter once, and binds what moved: the steps of this dialogue, without
// clock, screen and devices. The window's card (ui/panel/controls_card.h) and the terminal (controls_dialog.h) show it.
//
//   ControlsSetup setup(bindings, shipped);
//   while (!setup.is_over()) {
//     show setup.prompt(), setup.note() and setup.choices()
//     setup.frame(controllers, seconds);     each frame
//     setup.answer(...)                      when the user has chosen
//   }
//   use setup.bindings()
#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "app/ui/input/axis_detector.h"
#include "app/ui/input/bindings.h"
#include "haptics/gate/gate.h"

namespace gearshift::ui {

class ControlsSetup {
 public:
  enum class Answer { done, skip, back, gear_buttons, two_buttons, lever, other, stays, returns, steps, held, toggled };
  struct Choice {
    Answer answer;
    const char* key;  // what to type in a terminal; "" stands for Enter
    const char* label;
  };

  // `shipped`: the bindings that game pads get back where another way of shifting replaces the lever's axes. `gears`: the
  // gears that a shifter with a button per gear is asked for, in order.
  ControlsSetup(Bindings start, const Bindings& shipped, std::vector<int> gears);

  void frame(const std::vector<engine::Controller>& controllers, double seconds);
  // `answer` is one of choices(). Ignored while is_resting().
  void answer(Answer answer);

  const std::string& prompt() const noexcept { return prompt_; }
  const std::string& note() const noexcept { return note_; }  // what was found, or why the step is asked again
  std::span<const Choice> choices() const noexcept;
  // The consequence of Answer::skip: "you still use the clutch with A". Empty if the step cannot be skipped.
  std::string if_skipped() const;
  bool is_resting() const noexcept { return is_resting_; }  // measures a released control
  std::size_t step() const noexcept { return step_; }
  std::size_t steps() const noexcept { return steps_.size(); }
  bool is_over() const noexcept { return step_ == steps_.size(); }
  // For a picture of the present step: the axis that moves; the control or the gear that is asked for.
  std::optional<AxisDetector::MovingAxis> moving() const { return detector_ ? detector_->moving() : std::nullopt; }
  const AxisInfo* axis() const noexcept { return is_over() ? nullptr : steps_[step_].axis; }
  std::optional<int> gear() const noexcept;
  const Bindings& bindings() const noexcept { return bindings_; }

 private:
  enum class Kind { axis, hand_brake_button, shifting, neutral, gear, direction, lever_mode };
  struct Step {
    Kind kind = Kind::axis;
    const AxisInfo* axis = nullptr;    // Kind::axis
    int gear = haptics::kNeutralGear;  // Kind::gear
    Action action = Action::shift_up;  // Kind::direction
  };
  struct Button {
    ControllerName of;
    int which = 0, number = 0;  // as ControllerButtons::which; the button
    auto operator<=>(const Button& other) const {
      return std::tie(of.stick, which, number) <=> std::tie(other.of.stick, other.which, other.number);
    }
    bool operator==(const Button& other) const { return std::is_eq(*this <=> other); }
    bool is_on(const ControllerButtons& one) const { return one.of.stick == of.stick && one.which == which; }
  };
  using Buttons = std::set<Button>;

  void begin_step();
  void repeat(const std::string& reason);
  void next(const std::string& found);
  void choose_shifting(Answer answer);
  void erase_shifting_except(Answer way);
  void choose_hand_brake(Answer answer);
  void finish_axis();
  void finish_gear();
  void finish_direction();
  bool was_asked(const std::function<bool(const Step&)>& about) const;  // in an earlier step
  std::string meaning_in_this_run(const Button& button) const;
  void refuse_button(const std::string& other);
  void bind(const Button& button, Action action);
  void bind_gear(const Button& button, int gear);
  void finish();
  ControllerButtons& buttons_of(const Button& button);
  void release_button(const Button& button);

  Bindings bindings_, shipped_;
  std::vector<int> gears_;
  std::vector<Step> steps_;
  std::size_t step_ = 0;
  std::vector<Bindings> before_;  // the bindings before each step, for Answer::back
  std::string prompt_, note_;
  std::optional<AxisDetector> detector_;
  bool is_resting_ = false;
  double rest_time_ = 0.0;  // [s] and number of frames measured at rest
  int rest_frames_ = 0;
  std::vector<engine::Controller> all_;  // controllers of the last frame
  Buttons down_, neutral_, pressed_;     // held now; held in neutral; pressed during this step
  std::optional<Button> hand_brake_;     // found in this run
};

// True for a controller that the user can set up: all except game pads, whose controls are known. (An encoder that is
// built into pads, shifters and handbrakes alike counts as unknown.)
bool can_be_set_up(const engine::Controller& controller);
std::vector<engine::Controller> controllers_to_set_up(const std::vector<engine::Controller>& all);

// The gears of a gate in the order in which the set-up asks for them: 1, 2, ..., reverse.
std::vector<int> gears_to_set_up(const haptics::Gate& gate);
// Those of all shipped gates together.
std::vector<int> gears_to_set_up();

}  // namespace gearshift::ui
