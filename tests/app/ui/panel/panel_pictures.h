// Pictures of the panel on common screen sizes, for developers to look at.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/image/image.h"
#include "tests/app/ui/panel/panel_rig.h"
#include "tests/engine/ui/ui_raster.h"

namespace gearshift::test {

struct Screen {
  int width, height;
  float scale;
};
inline constexpr Screen kScreens[] = {{1280, 720, 1.0f}, {1920, 1080, 1.0f}, {3840, 2160, 2.0f}, {3840, 2160, 3.0f}};
inline constexpr Screen kEye = {640, 720, 1.0f};  // the picture for one eye of a headset

inline void show_on(PanelRig& rig, const Screen& screen) {
  rig.screen.width = static_cast<float>(screen.width);
  rig.screen.height = static_cast<float>(screen.height);
  rig.screen.scale = screen.scale;
  for (int i = 0; i < 2; ++i) rig.frame();
}

inline void settle(PanelRig& rig) {
  for (int i = 0; i < 6; ++i) rig.frame();  // tables and windows need a few frames to settle their size
}

inline engine::Image picture_of(PanelRig& rig) {
  settle(rig);
  return UiRaster(*ImGui::GetDrawData(), {92, 110, 124}).draw();
}

// If the environment variable GEARSHIFT_PICTURES names a folder, writes the picture into that folder.
inline void show(PanelRig& rig, const std::string& name) {
  settle(rig);
  if (const char* folder = std::getenv("GEARSHIFT_PICTURES"))
    engine::write_png(std::filesystem::path(folder) / name, picture_of(rig));
}

inline std::string name_of(const Screen& screen, std::string_view picture) {
  return std::string(picture) + "_" + std::to_string(screen.width) + "_" +
         std::to_string(static_cast<int>(screen.scale)) + ".png";
}

}  // namespace gearshift::test
