// State shared by context and overlay, private to this library.
#pragma once

#include <imgui.h>

#include <cstdint>

#include "engine/ui/ui.h"
#include "engine/ui/ui_queue.h"

namespace gearshift::engine {

// Id of the font's texture in draw commands. The type of ids is a pointer or, since 1.91.4, a number.
inline ImTextureID font_texture() {
  static char font_marker;  // the address of this variable is the id
  return reinterpret_cast<ImTextureID>(&font_marker);
}

// A new context, which is then the current one.
inline ImGuiContext* make_context() {
  ImGuiContext* context = ImGui::CreateContext();
  ImGui::SetCurrentContext(context);
  return context;
}

struct UiContext::State {
  ImGuiContext* context = make_context();
  UiQueue queue;                   // after the context, which it needs
  float scale = 0.0f;              // scale for which style and font were built
  std::uint64_t font_version = 0;  // number of times the atlas was built
};

}  // namespace gearshift::engine
