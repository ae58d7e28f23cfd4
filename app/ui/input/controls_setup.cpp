#include "app/ui/input/controls_setup.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift::ui {
namespace {

constexpr double kRestTime = 1.0;  // [s]
constexpr int kMaxSetupGear = 7;
// DragonRise's encoder: GLFW's table has it as a pad, SDL has dropped it because makers wire it in different ways.
constexpr const char* kGenericEncoder = "0079:0006";

using Choice = ControlsSetup::Choice;
using Answer = ControlsSetup::Answer;

constexpr Choice kDoneOrSkip[] = {{Answer::done, "", "Done"}, {Answer::skip, "-", "Skip"}, {Answer::back, "b", "Back"}};
constexpr Choice kShifting[] = {{Answer::gear_buttons, "1", "A shifter with gears"},
                                {Answer::two_buttons, "2", "Paddles or a sequential shifter"},
                                {Answer::lever, "3", "A lever with axes"},
                                {Answer::other, "4", "Mouse, keys or game pad"},
                                {Answer::back, "b", "Back"}};
constexpr Choice kLeverModes[] = {
    {Answer::stays, "y", "It stays"}, {Answer::returns, "n", "It springs back"}, {Answer::back, "b", "Back"}};

std::string describe(const ControllerName& of, const char* kind, int number) {
  return fmt::format("{} {} of {}", kind, number, haptics::printable(of.stick));
}

std::string gear_text(int gear) {
  return gear == haptics::kReverseGear ? "REVERSE" : fmt::format("gear {}", gear);
}

void erase_gears(Bindings& bindings) {
  for (ControllerButtons& one : bindings.controllers) one.gears.clear();
}

void erase_action(Bindings& bindings, Action action) {
  for (ControllerButtons& one : bindings.controllers) one.actions.erase(action);
}

}  // namespace

bool can_be_set_up(const engine::Controller& controller) {
  return controller.can_be_read && (!controller.gamepad || controller.id == kGenericEncoder);
}

std::vector<engine::Controller> controllers_to_set_up(const std::vector<engine::Controller>& all) {
  std::vector<engine::Controller> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), can_be_set_up);
  return some;
}

ControlsSetup::ControlsSetup(Bindings start, const Bindings& shipped) : bindings_(std::move(start)), shipped_(shipped) {
  for (const AxisInfo& axis : kAxes)
    if (!axis.is_lever) steps_.push_back({Kind::axis, &axis});
  steps_.push_back({Kind::shifting});
  begin_step();
}

std::span<const Choice> ControlsSetup::choices() const noexcept {
  if (is_over()) return {};
  if (steps_[step_].kind == Kind::shifting) return kShifting;
  if (steps_[step_].kind == Kind::lever_mode) return kLeverModes;
  return std::span(kDoneOrSkip).first(step_ == 0 ? 2 : 3);
}

std::optional<int> ControlsSetup::gear() const noexcept {
  const bool asks_gear = !is_over() && (steps_[step_].kind == Kind::gear || steps_[step_].kind == Kind::neutral);
  return asks_gear ? std::optional(steps_[step_].gear) : std::nullopt;
}

void ControlsSetup::begin_step() {
  before_.resize(step_);
  before_.push_back(bindings_);
  detector_.reset();
  pressed_.clear();
  is_resting_ = false;
  if (is_over()) {
    finish();
    prompt_ = "Try every control. Then save.";
    return;
  }
  const Step& now = steps_[step_];
  switch (now.kind) {
    case Kind::axis:
      detector_.emplace(now.axis->is_lever ? AxisDetector::Control::lever : AxisDetector::Control::pedal);
      prompt_ = now.axis->prompt;
      break;
    case Kind::shifting:
      prompt_ = "How do you shift?";
      break;
    case Kind::neutral:
      prompt_ = "Put the shifter into NEUTRAL.";
      break;
    case Kind::gear:
      prompt_ = fmt::format("Put the shifter into {} and leave it there.", gear_text(now.gear));
      break;
    case Kind::direction:
      prompt_ = now.action == Action::shift_up ? "Shift UP once." : "Shift DOWN once.";
      break;
    case Kind::lever_mode:
      prompt_ = "Does the lever stay in place when you let go of it?";
      break;
  }
}

void ControlsSetup::repeat(const std::string& reason) {
  begin_step();
  note_ = reason + " Try again.";
}

void ControlsSetup::next(const std::string& found) {
  ++step_;
  begin_step();
  note_ = found;
}

void ControlsSetup::frame(const std::vector<engine::Controller>& all, double seconds) {
  if (is_over()) return;
  const std::vector<engine::Controller> controllers = controllers_to_set_up(all);
  Buttons down;
  std::map<std::string, int> equal;  // number of controllers so far, by name
  for (const engine::Controller& one : controllers) {
    const int which = equal[name_of(one).stick]++;
    for (std::size_t i = 0; i < one.buttons.size(); ++i)
      if (one.buttons[i] != 0) down.insert({name_of(one), which, static_cast<int>(i)});
  }
  std::set_difference(down.begin(), down.end(), down_.begin(), down_.end(), std::inserter(pressed_, pressed_.end()));
  down_ = std::move(down);
  if (detector_ && is_resting()) {
    detector_->record_rest(controllers);
    rest_time_ += seconds;
    ++rest_frames_;
    if (rest_time_ >= kRestTime && rest_frames_ >= AxisDetector::kMinRestFrames) finish_axis();
  } else if (detector_) {
    detector_->record_move(controllers);
  }
}

void ControlsSetup::answer(Answer answer) {
  if (is_over() || is_resting()) return;
  const Step now = steps_[step_];
  if (answer == Answer::back && step_ > 0) {
    bindings_ = before_[--step_];
    note_.clear();
    begin_step();
  } else if (answer == Answer::skip) {
    next("Skipped: it stays as it was.");
  } else if (now.kind == Kind::shifting) {
    choose_shifting(answer);
  } else if (now.kind == Kind::lever_mode) {
    bindings_.lever_mode = answer == Answer::stays ? LeverMode::places : LeverMode::moves;
    next({});
  } else if (now.kind == Kind::axis) {
    is_resting_ = true;
    rest_time_ = 0.0;
    rest_frames_ = 0;
    prompt_ = "Now don't touch anything for a second.";
    note_.clear();
  } else if (now.kind == Kind::neutral) {
    neutral_ = down_;
    next({});
  } else if (now.kind == Kind::gear) {
    finish_gear();
  } else {
    finish_direction();
  }
}

// Adds the steps that the way of shifting needs, and removes what other ways have bound.
void ControlsSetup::choose_shifting(Answer answer) {
  steps_.resize(step_ + 1);
  for (const AxisInfo& info : kAxes)
    if (info.is_lever) bindings_.*info.axis = shipped_.*info.axis;
  bindings_.lever_mode = shipped_.lever_mode;
  erase_gears(bindings_);
  for (const Action action : {Action::shift_up, Action::shift_down}) erase_action(bindings_, action);
  if (answer == Answer::gear_buttons) {
    steps_.push_back({Kind::neutral});
    for (int gear = 1; gear <= kMaxSetupGear; ++gear) steps_.push_back({Kind::gear, nullptr, gear});
    steps_.push_back({Kind::gear, nullptr, haptics::kReverseGear});
  } else if (answer == Answer::two_buttons) {
    for (const Action action : {Action::shift_up, Action::shift_down})
      steps_.push_back({Kind::direction, nullptr, haptics::kNeutralGear, action});
  } else if (answer == Answer::lever) {
    for (const AxisInfo& axis : kAxes)
      if (axis.is_lever) steps_.push_back({Kind::axis, &axis});
    steps_.push_back({Kind::lever_mode});
  }
  next({});
}

// A handbrake may also be a button.
void ControlsSetup::finish_axis() {
  const AxisInfo& info = *steps_[step_].axis;
  try {
    const AxisBinding found = detector_->result();
    for (const AxisInfo& other : kAxes) {
      std::optional<AxisBinding>& bound = bindings_.*other.axis;
      if (&other == &info || other.axis == info.axis || !bound || !overlap(*bound, found)) continue;
      const bool is_of_this_run = bound != before_.front().*other.axis;
      if (is_of_this_run) return repeat(fmt::format("This axis is bound to another control already ({}).", other.help));
      bound.reset();
    }
    bindings_.*info.axis = found;
    if (info.axis == &Bindings::hand_brake) erase_action(bindings_, Action::hand_brake_hold);
    next(
        fmt::format("Found: {}, from {:.2f} to {:.2f}.", describe(found.of, "axis", found.axis), found.from, found.to));
  } catch (const std::invalid_argument& refused) {
    if (info.axis != &Bindings::hand_brake || pressed_.size() != 1) return repeat(refused.what());
    const Button button = *pressed_.begin();
    erase_action(bindings_, Action::hand_brake_hold);
    bindings_.hand_brake.reset();
    bind(button, Action::hand_brake_hold);
    next(fmt::format("Found: {}.", describe(button.of, "button", button.number)));
  }
}

void ControlsSetup::finish_gear() {
  Buttons held;
  std::set_difference(down_.begin(), down_.end(), neutral_.begin(), neutral_.end(), std::inserter(held, held.end()));
  if (held.empty()) return repeat("No button of a shifter is held in this gear.");
  if (held.size() > 1) return repeat("Several buttons are held. Touch only the shifter.");
  const Button button = *held.begin();
  for (const ControllerButtons& one : bindings_.controllers)
    for (const auto& [gear, buttons] : one.gears)
      if (button.is_on(one) && std::find(buttons.begin(), buttons.end(), button.number) != buttons.end())
        return repeat(fmt::format("This button is {} already.", gear_text(gear)));
  bind_gear(button, steps_[step_].gear);
  // Some shifters also hold a button in neutral.
  for (const Button& one : neutral_)
    if (one.of == button.of && one.which == button.which && !down_.contains(one)) bind_gear(one, haptics::kNeutralGear);
  next(fmt::format("Found: {}.", describe(button.of, "button", button.number)));
}

void ControlsSetup::finish_direction() {
  if (pressed_.empty()) return repeat("No button was pressed.");
  if (pressed_.size() > 1) return repeat("Several buttons were pressed. Press only one.");
  const Button button = *pressed_.begin();
  bind(button, steps_[step_].action);
  next(fmt::format("Found: {}.", describe(button.of, "button", button.number)));
}

// Controllers whose last button was bound to something else are no longer named.
void ControlsSetup::finish() {
  std::erase_if(bindings_.controllers,
                [](const ControllerButtons& one) { return one.actions.empty() && one.gears.empty(); });
}

ControllerButtons& ControlsSetup::buttons_of(const Button& button) {
  const auto known = std::find_if(bindings_.controllers.begin(), bindings_.controllers.end(),
                                  [&](const auto& one) { return button.is_on(one); });
  if (known != bindings_.controllers.end()) return *known;
  return bindings_.controllers.emplace_back(ControllerButtons{button.of, button.which, {}, {}});
}

// A button has one meaning, so its old one ends.
void ControlsSetup::release_button(const Button& button) {
  ControllerButtons& one = buttons_of(button);
  const auto release = [&](auto& bound) {
    for (auto& [meaning, buttons] : bound) std::erase(buttons, button.number);
    std::erase_if(bound, [](const auto& entry) { return entry.second.empty(); });
  };
  release(one.actions);
  release(one.gears);
}

void ControlsSetup::bind(const Button& button, Action action) {
  release_button(button);
  buttons_of(button).actions[action] = {button.number};
}

void ControlsSetup::bind_gear(const Button& button, int gear) {
  release_button(button);
  buttons_of(button).gears[gear] = {button.number};
}

}  // namespace gearshift::ui
