// Dear ImGui with our own Vulkan pipelines: context, font, drawing. Dear ImGui's own Vulkan backend (version 1.86, as
// in Debian 12) requires a VkRenderPass, which this engine does not use.
#pragma once

#include <memory>

#include "engine/gpu/gpu.h"
#include "engine/gpu/overlay.h"
#include "engine/ui/ui_input.h"

namespace gearshift::engine {

struct UiInput {
  float width = 1280.0f, height = 720.0f;  // [px]
  float seconds = 1.0f / 60.0f;            // [s] since the last frame, > 0
  float scale = 1.0f;                      // size of text and widgets: 1 at 96 dpi, 3 on a 4K television
};

// One Dear ImGui context with our style and font at the given scale. Needs no GPU: windows can be built, clicked and
// inspected without one. Keyboard navigation is on. No settings or log file is read or written.
class UiContext {
 public:
  UiContext();  // makes the context current
  ~UiContext();
  UiContext(const UiContext&) = delete;
  UiContext& operator=(const UiContext&) = delete;

  void feed(const UiEvents& events);  // mouse, keys and text, for as many frames as they need
  void begin(const UiInput& input);   // makes the context current and calls ImGui::NewFrame
  void end();                         // calls ImGui::Render

 private:
  struct State;
  std::unique_ptr<State> state_;
  friend class UiOverlay;
};

// Draws the context's newest frame. Each slot (frame in flight) has its own buffers, which grow as needed. The font is
// the only supported texture: any other texture throws std::logic_error.
class UiOverlay final : public Overlay {
 public:
  UiOverlay(Gpu& gpu, UiContext& context);
  ~UiOverlay() override;
  void draw(VkCommandBuffer commands, VkExtent2D extent, int slot) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::engine
