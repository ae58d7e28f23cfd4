// Presets: save the current settings under a name, and compare them with another preset.
#pragma once

#include <array>
#include <string>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

class PresetView {
 public:
  void draw(Controls& controls, const PanelInput& input, PanelCommands& out);

 private:
  void draw_save(Controls& controls, PanelCommands& out);
  void draw_compare(Controls& controls, const PanelInput& input, PanelCommands& out);

  std::array<char, 64> name_{};
  std::string compared_;  // name of the preset to compare with
};

}  // namespace gearshift::ui
