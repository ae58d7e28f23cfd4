// The queue of input events of the current Dear ImGui context. A frame of Dear ImGui sees each button and key in one
// state, so changes between two frames are spread over several frames, in order: a click counts where it was made,
// although the mouse has moved on since.
#pragma once

#include <imgui.h>

#include <deque>
#include <vector>

namespace gearshift::engine {

enum class UiModifier : int { shift, control, alt };

// ImGuiIO has had a queue since 1.87. For 1.86 the queue is here. It then spreads events by the rules of 1.90.
class ImGuiQueue {
 public:
  ImGuiQueue();                  // for the current context
  void add_position(ImVec2 at);  // [px]
  void add_button(int button, bool down);
  void add_scroll(ImVec2 lines);
  void add_key(ImGuiKey key, bool down);
  void add_modifier(UiModifier modifier, bool down);
  void add_letter(char32_t letter);
  void lose_focus();   // drops waiting events (not in 1.87 to 1.89.7), and releases keys and buttons
  void start_frame();  // call before NewFrame

#if IMGUI_VERSION_NUM < 18700
 private:
  enum class Kind { position, button, scroll, key, modifier, letter };
  struct Item {
    Kind kind;
    int code = 0;  // button, key, modifier or letter
    bool down = false;
    ImVec2 value{0.0f, 0.0f};  // position or scroll
  };
  static bool& state_of(const Item& item);
  static bool has_effect(const Item& item);
  static void apply(const Item& item);
  bool must_wait(const Item& item) const;
  bool has_applied(Kind kind) const;

  std::deque<Item> waiting_;
  std::vector<Item> applied_;  // events of this frame that changed something
#endif
};

}  // namespace gearshift::engine
