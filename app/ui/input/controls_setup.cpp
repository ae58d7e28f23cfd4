#include "app/ui/input/controls_setup.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "app/ui/input/bound_controllers.h"
#include "haptics/files/printable.h"

namespace gearshift::ui {
namespace {

constexpr double kRestTime = 1.0;   // [s]
constexpr int kMaxShippedGear = 6;  // of the shipped gates

using Choice = ControlsSetup::Choice;
using Answer = ControlsSetup::Answer;

constexpr Choice kDoneOrSkip[] = {{Answer::done, "", "Done"}, {Answer::skip, "-", "Skip"}, {Answer::back, "b", "Back"}};
constexpr Choice kDone[] = {{Answer::done, "", "Done"}, {Answer::back, "b", "Back"}};
constexpr Choice kBack[] = {{Answer::back, "b", "Back"}};
constexpr Choice kHandBrakes[] = {{Answer::held, "1", "On while it is down"},
                                  {Answer::toggled, "2", "On or off at each press"},
                                  {Answer::back, "b", "Back"}};
constexpr Choice kShifting[] = {{Answer::gear_buttons, "1", "A shifter with gears"},
                                {Answer::two_buttons, "2", "Paddles or a sequential shifter"},
                                {Answer::lever, "3", "A lever with axes"},
                                {Answer::other, "4", "Mouse, keys or game pad"},
                                {Answer::back, "b", "Back"}};
constexpr Choice kLeverAnswers[] = {{Answer::stays, "y", "It stays"},
                                    {Answer::returns, "n", "It springs back"},
                                    {Answer::steps, "s", "It is sequential"},
                                    {Answer::back, "b", "Back"}};

// `all`: the controllers that are plugged in, of which several may be equal.
std::string describe(const ControllerName& of, int which, const char* kind, int number,
                     const std::vector<engine::Controller>& all) {
  const std::string text = fmt::format("{} {} of {}", kind, number, haptics::printable(of.stick));
  const auto count = std::count_if(all.begin(), all.end(),
                                   [&](const engine::Controller& one) { return name_of(one).stick == of.stick; });
  return count < 2 ? text : fmt::format("{}, number {} of {} in the order of their ports", text, which + 1, count);
}

std::string gear_text(int gear) {
  return gear == haptics::kReverseGear ? "REVERSE" : fmt::format("gear {}", gear);
}

void erase_action(Bindings& bindings, Action action) {
  for (ControllerButtons& one : bindings.controllers) one.actions.erase(action);
}

void erase_gear(Bindings& bindings, int gear) {
  for (ControllerButtons& one : bindings.controllers) one.gears.erase(gear);
}

void erase_hand_brake(Bindings& bindings) {
  bindings.hand_brake.reset();
  for (const Action action : {Action::hand_brake_hold, Action::hand_brake}) erase_action(bindings, action);
}

}  // namespace

bool can_be_set_up(const engine::Controller& controller) {
  return controller.can_be_read && !is_game_pad(controller);
}

std::vector<engine::Controller> controllers_to_set_up(const std::vector<engine::Controller>& all) {
  std::vector<engine::Controller> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), can_be_set_up);
  return some;
}

std::vector<int> gears_to_set_up(const haptics::Gate& gate) {
  std::vector<int> gears;
  for (int gear = 1; gear <= haptics::kMaxGear; ++gear)
    if (haptics::has_gear(gate, gear)) gears.push_back(gear);
  if (haptics::has_gear(gate, haptics::kReverseGear)) gears.push_back(haptics::kReverseGear);
  return gears;
}

std::vector<int> gears_to_set_up() {
  std::vector<int> gears(kMaxShippedGear);
  std::iota(gears.begin(), gears.end(), 1);
  gears.push_back(haptics::kReverseGear);
  return gears;
}

ControlsSetup::ControlsSetup(Bindings start, const Bindings& shipped, std::vector<int> gears)
    : bindings_(std::move(start)), shipped_(shipped), gears_(std::move(gears)) {
  for (const AxisInfo& axis : kAxes)
    if (!axis.is_lever) steps_.push_back({Kind::axis, &axis});
  steps_.push_back({Kind::shifting});
  begin_step();
}

std::span<const Choice> ControlsSetup::choices() const noexcept {
  if (is_over()) return kBack;
  switch (steps_[step_].kind) {
    case Kind::shifting:
      return kShifting;
    case Kind::lever_mode:
      return kLeverAnswers;
    case Kind::hand_brake_button:
      return kHandBrakes;
    case Kind::neutral:
      return kDone;
    default:
      return std::span(kDoneOrSkip).first(step_ == 0 ? 2 : 3);
  }
}

std::string ControlsSetup::if_skipped() const {
  if (is_over()) return {};
  const Step& now = steps_[step_];
  std::string use;
  std::vector<std::string> inputs;
  if (now.kind == Kind::axis) {
    use = now.axis->is_lever ? std::string(now.axis->help) : fmt::format("use the {}", now.axis->help);
    inputs = bound_inputs(bindings_, *now.axis, all_);
    if (now.axis->is_lever) inputs.emplace_back("the mouse");
  } else if (now.kind == Kind::direction) {
    use = now.action == Action::shift_up ? "shift one gear up" : "shift one gear down";
    inputs = bound_inputs(bindings_, now.action, all_);
  } else if (now.kind == Kind::gear) {
    use = fmt::format("shift into {}", gear_text(now.gear));
    for (const ControllerButtons& one : bindings_.controllers)
      if (const auto bound = one.gears.find(now.gear); bound != one.gears.end())
        for (const int button : bound->second) inputs.push_back(describe(one.of, one.which, "button", button, all_));
    if (inputs.empty()) return fmt::format("in {} the shifter counts as in neutral", gear_text(now.gear));
  } else {
    return {};
  }
  return inputs.empty() ? fmt::format("you cannot {} until something is bound to it", use)
                        : fmt::format("you still {} with {}", use, fmt::join(inputs, ", "));
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
  const Step now = steps_[step_];
  if (now.axis != nullptr && now.axis->axis == &Bindings::hand_brake)  // asked again, what it was does not count
    std::erase_if(steps_, [](const Step& step) { return step.kind == Kind::hand_brake_button; });
  switch (now.kind) {
    case Kind::axis:
      detector_.emplace(now.axis->is_lever ? AxisDetector::Control::lever : AxisDetector::Control::pedal);
      prompt_ = now.axis->prompt;
      break;
    case Kind::hand_brake_button:
      prompt_ = "What does the button do to the handbrake?";
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
  const bool has_gears = std::any_of(steps_.begin(), steps_.end(), [](const Step& s) { return s.kind == Kind::gear; });
  if (is_over() && has_gears && std::find(gears_.begin(), gears_.end(), kMaxShippedGear) == gears_.end())
    note_ += " For a car with more gears, choose it and set up again: Skip keeps what is bound.";
}

void ControlsSetup::frame(const std::vector<engine::Controller>& all, double seconds) {
  if (is_over()) return;
  all_ = all;
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
  if (is_resting()) return;
  if (answer == Answer::back && step_ > 0) {
    bindings_ = before_[--step_];
    note_.clear();
    begin_step();
    return;
  }
  if (is_over()) return;
  const Step now = steps_[step_];
  if (answer == Answer::skip) {
    next(fmt::format("Skipped: {}.", if_skipped()));
  } else if (now.kind == Kind::hand_brake_button) {
    choose_hand_brake(answer);
  } else if (now.kind == Kind::shifting) {
    choose_shifting(answer);
  } else if (now.kind == Kind::lever_mode) {
    bindings_.lever.mode = answer == Answer::stays     ? LeverMode::places
                           : answer == Answer::returns ? LeverMode::moves
                                                       : LeverMode::steps;
    next({});
  } else if (now.kind == Kind::axis) {
    is_resting_ = true;
    rest_time_ = 0.0;
    rest_frames_ = 0;
    prompt_ = "Now don't touch anything for a second.";
    note_.clear();
  } else if (now.kind == Kind::neutral) {
    neutral_ = down_;
    erase_gear(bindings_, haptics::kNeutralGear);
    next({});
  } else if (now.kind == Kind::gear) {
    finish_gear();
  } else {
    finish_direction();
  }
}

// Removes what other ways of shifting have bound. What this way has on a controller that is plugged in stays until the
// user has moved something else, so that single gears can be added.
void ControlsSetup::erase_shifting_except(Answer way) {
  const Bindings before = bindings_;
  const auto keeps = [&](Answer answer, const ControllerName& of, int which) {
    return way == answer && (of.stick.empty() || find_controller(before, of, which, all_) != nullptr);
  };
  for (const AxisInfo& info : kAxes) {
    std::optional<AxisBinding>& axis = bindings_.*info.axis;
    if (info.is_lever && axis && !keeps(Answer::lever, axis->of, axis->which)) axis = shipped_.*info.axis;
  }
  if (way != Answer::lever) bindings_.lever.mode = shipped_.lever.mode;
  for (ControllerButtons& one : bindings_.controllers) {
    if (!keeps(Answer::gear_buttons, one.of, one.which)) one.gears.clear();
    if (keeps(Answer::two_buttons, one.of, one.which)) continue;
    for (const Action action : {Action::shift_up, Action::shift_down}) one.actions.erase(action);
  }
}

// Adds the steps that the way of shifting needs.
void ControlsSetup::choose_shifting(Answer answer) {
  steps_.resize(step_ + 1);
  erase_shifting_except(answer);
  if (answer == Answer::gear_buttons) {
    steps_.push_back({Kind::neutral});
    for (const int gear : gears_) steps_.push_back({Kind::gear, nullptr, gear});
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

// `hand_brake_`, which is bound as held, may also be one that switches.
void ControlsSetup::choose_hand_brake(Answer answer) {
  if (answer == Answer::toggled) {
    erase_action(bindings_, Action::hand_brake_hold);
    bind(*hand_brake_, Action::hand_brake);
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
      if (was_asked([&](const Step& step) { return step.axis == &other; }))
        return repeat(fmt::format("This axis is bound to another control already ({}).", other.help));
      bound.reset();
    }
    if (info.axis == &Bindings::hand_brake) erase_hand_brake(bindings_);
    bindings_.*info.axis = found;
    next(fmt::format("Found: {}, from {:.2f} to {:.2f}.", describe(found.of, found.which, "axis", found.axis, all_),
                     found.from, found.to));
  } catch (const std::invalid_argument& refused) {
    if (info.axis != &Bindings::hand_brake || pressed_.size() != 1) return repeat(refused.what());
    hand_brake_ = *pressed_.begin();
    erase_hand_brake(bindings_);
    bind(*hand_brake_, Action::hand_brake_hold);
    steps_.insert(steps_.begin() + static_cast<std::ptrdiff_t>(step_) + 1, {Kind::hand_brake_button});
    next(fmt::format("Found: {}.", describe(hand_brake_->of, hand_brake_->which, "button", hand_brake_->number, all_)));
  }
}

bool ControlsSetup::was_asked(const std::function<bool(const Step&)>& about) const {
  return std::any_of(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(step_), about);
}

// Describes what a button has been bound to in this run, or keeps from a skipped step. Empty if it is free.
std::string ControlsSetup::meaning_in_this_run(const Button& button) const {
  const auto has = [&](const std::vector<int>& buttons) {
    return std::find(buttons.begin(), buttons.end(), button.number) != buttons.end();
  };
  for (const ControllerButtons& one : bindings_.controllers) {
    if (!button.is_on(one)) continue;
    for (const auto& [action, buttons] : one.actions) {
      const bool is_hand_brake = action == Action::hand_brake || action == Action::hand_brake_hold;
      if (has(buttons) && is_hand_brake) return "handbrake";
      if (has(buttons) && was_asked([&](const Step& s) { return s.kind == Kind::direction && s.action == action; }))
        return "one gear up";
    }
    for (const auto& [gear, buttons] : one.gears)
      if (has(buttons) && was_asked([&](const Step& s) { return s.kind == Kind::gear && s.gear == gear; }))
        return gear_text(gear);
  }
  return {};
}

void ControlsSetup::refuse_button(const std::string& other) {
  repeat(fmt::format("This button is bound already ({}).", other));
}

void ControlsSetup::finish_gear() {
  Buttons held;
  std::set_difference(down_.begin(), down_.end(), neutral_.begin(), neutral_.end(), std::inserter(held, held.end()));
  if (held.empty()) return repeat("No button of a shifter is held in this gear.");
  if (held.size() > 1) return repeat("Several buttons are held. Touch only the shifter.");
  const Button button = *held.begin();
  if (const std::string other = meaning_in_this_run(button); !other.empty()) return refuse_button(other);
  bind_gear(button, steps_[step_].gear);
  // Some shifters also hold a button in neutral.
  for (const Button& one : neutral_)
    if (one.of == button.of && one.which == button.which && !down_.contains(one)) bind_gear(one, haptics::kNeutralGear);
  next(fmt::format("Found: {}.", describe(button.of, button.which, "button", button.number, all_)));
}

void ControlsSetup::finish_direction() {
  if (pressed_.empty())
    return repeat("No button was pressed. If your shifter has an axis, go back and choose the lever with axes.");
  if (pressed_.size() > 1) return repeat("Several buttons were pressed. Press only one.");
  const Button button = *pressed_.begin();
  if (const std::string other = meaning_in_this_run(button); !other.empty()) return refuse_button(other);
  erase_action(bindings_, steps_[step_].action);
  bind(button, steps_[step_].action);
  next(fmt::format("Found: {}.", describe(button.of, button.which, "button", button.number, all_)));
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
  erase_gear(bindings_, gear);
  release_button(button);
  buttons_of(button).gears[gear] = {button.number};
}

}  // namespace gearshift::ui
