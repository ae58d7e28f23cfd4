// Presets: save what runs under a name, and see in what another one differs.
#pragma once

#include <array>
#include <string>

#include "app/panel/panel.h"

namespace gearshift {

class PresetView {
 public:
  void draw(Controls& controls, const PanelInput& input, PanelRequests& out);

 private:
  void draw_save(Controls& controls, PanelRequests& out);
  void draw_compare(Controls& controls, const PanelInput& input, PanelRequests& out);

  std::array<char, 64> name_{};
  std::string compared_;  // the preset that was asked for
};

}  // namespace gearshift
