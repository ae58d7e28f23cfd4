// Dear ImGui on our pipelines: context, font, draw data. Debian's 1.86 backend wants a VkRenderPass, we have none.
#pragma once

#include <memory>

#include "engine/gpu/gpu.h"
#include "engine/gpu/overlay.h"
#include "engine/ui/ui_input.h"

namespace gearshift {

struct UiInput {
  float width = 1280.0f, height = 720.0f;  // [px]
  float seconds = 1.0f / 60.0f;            // since the last frame, > 0
  float scale = 1.0f;                      // of text and widgets: 1 at 96 dpi, 3 on a 4K television
};

// One Dear ImGui context, with our style and font at the scale. Needs no GPU: what is drawn can be built, clicked and
// looked at without one. Keyboard navigation is on; nothing is read from or written to a file.
class UiContext {
 public:
  UiContext();  // makes the context current
  ~UiContext();
  UiContext(const UiContext&) = delete;
  UiContext& operator=(const UiContext&) = delete;

  void feed(const UiEvents& events);  // mouse, keys and text for the next begin()
  void begin(const UiInput& input);   // makes the context current, ImGui::NewFrame
  void end();                         // ImGui::Render

  // After begin(): what is fed belongs to the user interface and not to what lies behind it. The keyboard does while a
  // field is edited or the navigation's frame is seen, not because a panel was clicked.
  bool wants_mouse() const;
  bool wants_keys() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  friend class UiOverlay;
};

// Draws the context's last frame, once per frame and slot: each slot has buffers of its own, which grow with the frame.
// The font is the only texture: another one throws std::logic_error.
class UiOverlay final : public Overlay {
 public:
  UiOverlay(Gpu& gpu, UiContext& context);
  ~UiOverlay() override;
  void draw(VkCommandBuffer commands, VkExtent2D extent, int slot) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
