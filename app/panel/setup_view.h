// What is fixed while the loop runs: set here, and taken by starting the loop anew.
#pragma once

#include <array>
#include <string>

#include "app/panel/panel.h"
#include "app/panel/setup_fields.h"

namespace gearshift {

class SetupView {
 public:
  void draw(Controls& controls, const PanelInput& input, PanelRequests& out);

 private:
  void follow(const HapticConfig& runs);
  void draw_fields(Controls& controls);
  void draw_choices(Controls& controls);
  void draw_restart(Controls& controls, const PanelInput& input, PanelRequests& out);
  void judge(const PanelInput& input);

  using Values = std::array<double, kSetupFields.size() + 4>;  // the fields, hold, energy control, limiter and study
  static Values values_of(const HapticConfig& config);

  HapticConfig staged_;
  Values running_{}, judged_{};
  std::string refused_, told_;  // of what is staged
  bool known_ = false;
};

}  // namespace gearshift
