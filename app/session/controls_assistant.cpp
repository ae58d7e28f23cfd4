#include "app/session/controls_assistant.h"

#include <algorithm>
#include <fstream>
#include <utility>
#include <variant>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <fmt/format.h>

#include "app/ui/input/bound_controllers.h"
#include "app/ui/input/controls_dialog.h"
#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"
#include "haptics/files/text_file.h"
#include "haptics/files/verified_file.h"
#include "haptics/gate/lockout.h"

namespace gearshift::session {
namespace {

// In a sequential gate, the driver opens the way from one gear into another by holding a control. Empty if nothing locks
// it.
std::optional<ui::Action> opens(const haptics::Gate& gate, int from, int to) {
  for (const haptics::Lockout& lockout : haptics::lockouts(gate)) {
    if (!haptics::is_sequential(gate) || lockout.from_gear != from) continue;
    if (haptics::locked_gear(gate, lockout) != to) continue;
    if (lockout.kind == haptics::LockoutKind::push_down) return ui::Action::push_down;
    if (lockout.kind == haptics::LockoutKind::lift) return ui::Action::lift;
  }
  return std::nullopt;
}

std::string shift_request(const ui::DriverInput::MissedGear& missed, const haptics::Gate& gate,
                          const ui::Bindings& bindings, const std::vector<engine::Controller>& all) {
  const char* name = haptics::gear_name(missed.gear);
  if (!haptics::has_gear(gate, missed.gear)) return fmt::format("This gearbox has no gear {}.", name);
  if (missed.of_shifter) return fmt::format("Your shifter is in {}, but the lever is not. Press the clutch.", name);
  const std::optional<ui::Action> opening = opens(gate, missed.engaged, missed.gear);
  if (!opening) return fmt::format("The lever did not reach {}. Press the clutch.", name);
  const std::vector<std::string> inputs = ui::bound_inputs(bindings, *opening, all);
  return fmt::format("{} is locked out. Hold {}{} while you shift down.", name,
                     *opening == ui::Action::lift ? "the lift ring up" : "the knob down",
                     inputs.empty() ? "" : fmt::format(" ({})", inputs.front()));
}

// One name per line. Empty if there is no such file.
std::set<std::string> read_names(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::set<std::string> names;
  for (std::string name; std::getline(stream, name);) names.insert(name);
  return names;
}

}  // namespace

ControlsAssistant::ControlsAssistant(ui::DriverInput& driver, std::filesystem::path own_file,
                                     std::filesystem::path declined_file, ui::Bindings shipped)
    : driver_(driver),
      own_file_(std::move(own_file)),
      declined_file_(std::move(declined_file)),
      shipped_(std::move(shipped)),
      declined_(read_names(declined_file_)) {}

void ControlsAssistant::update(const std::vector<engine::Controller>& controllers, double seconds) {
  controllers_ = ui::controllers_to_set_up(controllers);
  if (!is_described(controllers)) describe(controllers);
  if (!setup_) return;
  setup_->frame(controllers, seconds);
  const bool was_tried = std::exchange(is_tried_, setup_->is_over());
  if (is_tried_ && !was_tried) driver_.rebind(setup_->bindings());
}

bool ControlsAssistant::is_described(const std::vector<engine::Controller>& controllers) const {
  const auto is_same = [](const engine::Controller& a, const engine::Controller& b) {
    return a.name == b.name && a.id == b.id && a.guid == b.guid && a.can_be_read == b.can_be_read &&
           a.gamepad.has_value() == b.gamepad.has_value() && a.axes.size() == b.axes.size() &&
           a.buttons.size() == b.buttons.size();
  };
  return described_ && described_rebinds_ == driver_.rebinds() &&
         std::equal(described_->begin(), described_->end(), controllers.begin(), controllers.end(), is_same);
}

void ControlsAssistant::describe(const std::vector<engine::Controller>& controllers) {
  described_ = controllers;
  described_rebinds_ = driver_.rebinds();
  forget_replugged();
  unbound_.clear();
  for (const engine::Controller* one : ui::unbound_controllers(driver_.bindings(), controllers))
    if (one->can_be_read) unbound_.push_back(haptics::printable(one->name));
  sentences_ = ui::describe_bound(driver_.bindings(), controllers);
  problems_ = sentences_.size();
  for (std::string& sentence : ui::describe_unbound(driver_.bindings(), controllers, declined_))
    sentences_.push_back(std::move(sentence));
}

// A controller that is plugged in while the program runs is offered, also if it was declined before.
void ControlsAssistant::forget_replugged() {
  std::set<std::string> present;
  for (const engine::Controller& one : controllers_) present.insert(haptics::printable(one.name));
  for (const std::string& name : present)
    if (present_ && !present_->contains(name)) declined_.erase(name);
  present_ = std::move(present);
}

// If the file cannot be written, the answer applies to this session.
std::string ControlsAssistant::decline() {
  declined_.insert(unbound_.begin(), unbound_.end());
  described_.reset();
  if (declined_file_.empty()) return {};
  std::set<std::string> names = read_names(declined_file_);
  names.insert(unbound_.begin(), unbound_.end());
  try {
    std::error_code ignored;  // ignored, because the write below reports the failure
    std::filesystem::create_directories(declined_file_.parent_path(), ignored);
    haptics::write_verified_file(declined_file_, fmt::format("{}\n", fmt::join(names, "\n")),
                                 [](const auto& written) { (void)haptics::read_text_file(written); });
  } catch (const haptics::FileError& error) {
    return fmt::format("{} The controllers will be offered again at the next start.", error.what());
  }
  return {};
}

std::string ControlsAssistant::take(engine::WindowInput& input, bool uses_escape) {
  if (!setup_->is_over()) std::erase_if(input.controllers, ui::can_be_set_up);
  const auto is_escape = [](const engine::InputEvent& event) {
    const auto* const key = std::get_if<engine::KeyEvent>(&event);
    return key != nullptr && key->down && key->key == GLFW_KEY_ESCAPE;
  };
  const bool cancels = !uses_escape && std::erase_if(input.events, is_escape) > 0;
  return cancels ? cancel() : std::string();
}

std::string ControlsAssistant::apply(const ui::ControlsCommand& command, const haptics::Gate& gate) {
  if (std::holds_alternative<ui::StartControls>(command)) {
    before_ = driver_.bindings();
    setup_.emplace(before_, shipped_, ui::gears_to_set_up(gate));
    is_tried_ = false;
  } else if (std::holds_alternative<ui::DeclineControls>(command)) {
    return decline();
  } else if (!setup_) {
    return {};
  } else if (const auto* answer = std::get_if<ui::AnswerControls>(&command)) {
    setup_->answer(answer->answer);
  } else if (std::holds_alternative<ui::CancelControls>(command)) {
    return cancel();
  } else {
    return save();
  }
  return {};
}

bool ControlsAssistant::press_enter(std::string& message) {
  if (!setup_) return false;
  const auto choices = setup_->choices();
  const bool has_done = !choices.empty() && choices.front().answer == ui::ControlsSetup::Answer::done;
  if (setup_->is_over())
    message = save();
  else if (has_done)
    setup_->answer(ui::ControlsSetup::Answer::done);
  return true;
}

// If the file cannot be written, the new bindings apply to this session.
std::string ControlsAssistant::save() {
  const ui::Bindings bindings = setup_->bindings();
  end(bindings);
  if (own_file_.empty()) return "Your home folder is unknown, so these controls apply to this session only.";
  try {
    ui::save_bindings(bindings, own_file_);
  } catch (const haptics::FileError& error) {
    return fmt::format("{} The controls apply to this session only.", error.what());
  }
  return fmt::format("Saved: {}", own_file_.string());
}

std::string ControlsAssistant::cancel() {
  end(before_);
  return "Cancelled: the controls are as before.";
}

void ControlsAssistant::end(const ui::Bindings& bindings) {
  driver_.rebind(bindings);
  setup_.reset();
}

ui::ControlsView ControlsAssistant::view(const haptics::Gate& gate, bool offers) {
  offers_.clear();
  for (const std::string& name : unbound_)
    if (offers && !declined_.contains(name)) offers_.push_back(name);
  request_.clear();
  if (setup_) return {&*setup_, controllers_, {}, {}};
  if (const auto missed = driver_.missed_gear())
    request_ = shift_request(*missed, gate, driver_.bindings(), controllers_);
  else if (problems_ > 0)
    request_ = sentences_.front();
  return {nullptr, controllers_, offers_, request_};
}

}  // namespace gearshift::session
