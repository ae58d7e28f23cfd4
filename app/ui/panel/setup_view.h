// Sets parameters that are fixed while the loop runs; they take effect when the loop is restarted.
#pragma once

#include <array>
#include <string>

#include "app/ui/panel/panel.h"
#include "app/ui/panel/setup_fields.h"

namespace gearshift::ui {

class SetupView {
 public:
  void draw(Controls& controls, const PanelInput& input, PanelRequests& out);

 private:
  void follow(const haptics::HapticConfig& running);
  void draw_fields(Controls& controls);
  void draw_choices(Controls& controls);
  void draw_restart(Controls& controls, const PanelInput& input, PanelRequests& out);
  void judge(const PanelInput& input);

  using Values = std::array<double, kSetupFields.size() + 4>;  // fields first, then four drop-down lists
  static Values values_of(const haptics::HapticConfig& config);

  haptics::HapticConfig staged_;
  Values running_{}, judged_{};
  std::string rejection_, limits_text_;  // result of the check of staged_
  bool has_values_ = false;
};

}  // namespace gearshift::ui
