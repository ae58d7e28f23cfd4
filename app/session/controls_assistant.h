// Offers to set up controllers that have no effect yet, and leads through the steps in the window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/ui/input/controls_setup.h"
#include "app/ui/input/driver_input.h"
#include "app/ui/panel/panel.h"

namespace gearshift::session {

class ControlsAssistant {
 public:
  // `own_file`: the user's bindings, written when the user saves. `declined_file`: names of the controllers that the user
  // does not want to set up, one per line. Both are empty if the user has no folder for them. `shipped`: see
  // ui::ControlsSetup.
  ControlsAssistant(ui::DriverInput& driver, std::filesystem::path own_file, std::filesystem::path declined_file,
                    ui::Bindings shipped);

  // Call once per frame, with the controllers that are plugged in, without the one that is used as a force-feedback
  // stick.
  void update(const std::vector<engine::Controller>& controllers, double seconds);
  bool is_setting_up() const { return setup_.has_value(); }
  // Sentences about controllers that do not work as bound, or have no effect yet. They change only if controllers come
  // and go, or the bindings change.
  const std::vector<std::string>& sentences() const { return sentences_; }
  // Call while setting up. Removes from the window's input what must not reach the driver: the controllers with which
  // the user answers, and Escape, which cancels, unless it has another use now (`uses_escape`). Returns a message for
  // the user; empty if there is none.
  std::string take(engine::WindowInput& input, bool uses_escape);

  // `gate`: the one in force, whose gears the set-up asks for. Returns a message like take().
  std::string apply(const ui::ControlsCommand& command, const haptics::Gate& gate);
  // The Enter key. Returns false if nothing is being set up.
  bool press_enter(std::string& message);

  // Valid until the next update() or apply(). `offers`: whether to offer new controllers.
  ui::ControlsView view(const haptics::Gate& gate, bool offers);

 private:
  bool is_described(const std::vector<engine::Controller>& controllers) const;
  void describe(const std::vector<engine::Controller>& controllers);
  void forget_replugged();
  std::string decline();
  std::string save();
  std::string cancel();
  void end(const ui::Bindings& bindings);

  ui::DriverInput& driver_;
  std::filesystem::path own_file_, declined_file_;
  ui::Bindings shipped_;
  std::optional<ui::ControlsSetup> setup_;
  ui::Bindings before_;    // bindings before the set-up
  bool is_tried_ = false;  // the driver uses the new bindings
  std::vector<engine::Controller> controllers_;
  std::optional<std::vector<engine::Controller>> described_;  // controllers for which the members below were made
  std::uint64_t described_rebinds_ = 0;                       // DriverInput::rebinds() then
  std::vector<std::string> unbound_;                          // names of controllers without effect
  std::vector<std::string> sentences_;                        // see sentences()
  std::size_t problems_ = 0;                      // how many of them, at the front, are about bound controllers
  std::set<std::string> declined_;                // names of controllers that are not offered
  std::optional<std::set<std::string>> present_;  // names of all controllers that can be set up
  std::vector<std::string> offers_;
  std::string request_;
};

}  // namespace gearshift::session
