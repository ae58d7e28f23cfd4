// Sets parameters that are fixed while the loop runs; they take effect when the loop is restarted.
#pragma once

#include <optional>
#include <string>

#include "app/ui/panel/panel.h"
#include "app/ui/panel/tuning_check.h"

namespace gearshift::ui {

class SetupView {
 public:
  void draw(Controls& controls, const PanelInput& input, PanelCommands& out);

 private:
  void follow(const haptics::HapticConfig& running);
  void draw_fields(Controls& controls);
  void draw_restart(Controls& controls, const PanelInput& input, PanelCommands& out);
  void judge(const PanelInput& input);

  bool is_changed() const;  // the staged values differ from the running ones

  haptics::HapticConfig staged_;
  std::optional<haptics::HapticConfig> running_;  // without its tuning, which has its own tab
  std::optional<TuningQuestion> judged_;          // by the last check
  std::string rejection_, limits_text_;           // verdict
};

}  // namespace gearshift::ui
