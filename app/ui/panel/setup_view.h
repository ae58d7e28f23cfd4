// Sets parameters that are fixed while the loop runs; they take effect when the loop is restarted.
#pragma once

#include <optional>
#include <string>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

class SetupView {
 public:
  void draw(Controls& controls, const PanelInput& input, PanelRequests& out);

 private:
  void follow(const haptics::HapticConfig& running);
  void draw_fields(Controls& controls);
  void draw_restart(Controls& controls, const PanelInput& input, PanelRequests& out);
  void judge(const PanelInput& input);

  bool is_changed() const;  // the staged values differ from the running ones

  haptics::HapticConfig staged_;
  std::optional<haptics::HapticConfig> running_;  // without its tuning, which has its own tab
  std::optional<haptics::HapticConfig> judged_;   // the staged values of the verdict
  std::string rejection_, limits_text_;           // verdict
};

}  // namespace gearshift::ui
