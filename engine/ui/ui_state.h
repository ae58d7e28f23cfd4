// What context and overlay share, within this room.
#pragma once

#include <imgui.h>

#include <cstdint>

#include "engine/ui/ui.h"

namespace gearshift {

// The font's texture, as draw commands name it.
inline ImTextureID font_texture() {
  static char is_the_font;  // its address stands for the texture
  return &is_the_font;
}

struct UiContext::State {
  ImGuiContext* context = nullptr;
  UiKeyQueue keys;
  float scale = 0.0f;              // that style and font were made for
  std::uint64_t font_version = 0;  // counts the builds of the atlas
};

}  // namespace gearshift
