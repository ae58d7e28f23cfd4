// Sets parameters that are fixed while the loop runs; they take effect when the loop is restarted.
#pragma once

#include <optional>
#include <string>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

class SetupView {
 public:
  void draw(Controls& controls, const PanelInput& input, PanelCommands& out);

 private:
  void follow(const haptics::HapticConfig& running);
  void draw_fields(Controls& controls);
  void draw_restart(Controls& controls, const PanelInput& input, PanelCommands& out);
  void judge(const PanelInput& input);

  // All inputs on which the check depends.
  struct Basis {
    haptics::HapticConfig config;
    haptics::DeviceSpec device;
    double stiffest_feel = 0.0;  // [N/m] of the gate
    bool operator==(const Basis&) const = default;
  };

  bool is_changed() const;  // the staged values differ from the running ones

  haptics::HapticConfig staged_;
  std::optional<haptics::HapticConfig> running_;  // without its tuning, which has its own tab
  std::optional<Basis> judged_;                   // inputs of the last check
  std::string rejection_, limits_text_;           // verdict
};

}  // namespace gearshift::ui
