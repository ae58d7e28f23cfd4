// Translates input for Dear ImGui, private to this library.
#pragma once

#include "engine/ui/imgui_queue.h"
#include "engine/ui/ui_input.h"

namespace gearshift::engine {

class UiQueue {
 public:
  void push(const UiEvents& events);
  void start_frame() { queue_.start_frame(); }  // call before NewFrame

 private:
  void push(const UiButton& event);
  void push(const UiScroll& event);
  void push(const UiKey& event);
  void push(char32_t letter) { queue_.add_letter(letter); }

  ImGuiQueue queue_;
  bool focused_ = true;
  bool control_ = false;  // held after the events so far
};

}  // namespace gearshift::engine
