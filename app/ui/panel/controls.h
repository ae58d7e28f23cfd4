// Records where each named control was drawn, so that a test or script can click the control. Also counts the texts
// that did not fit.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "haptics/files/parameter.h"

struct ImGuiWindow;  // of imgui_internal.h

namespace gearshift::ui {

// A control that the Tab key reaches.
struct TabStop {
  ImGuiID id;
  ImGuiWindow* window;
  ImVec2 min, max;  // [px]
};

struct ControlRect {
  glm::dvec2 min{0.0}, max{0.0};  // [px]
};

class Controls {
 public:
  void begin_frame() noexcept;

  // Returns the control's place; empty if the control was not drawn in this frame or is scrolled out of view.
  std::optional<ControlRect> rect(std::string_view name) const;
  int shortened() const noexcept { return shortened_; }  // number of texts in this frame that did not fit

  // In the order in which they were drawn in the last frame, also those that are scrolled out of view.
  std::span<const TabStop> tab_stops() const noexcept { return last_stops_; }

  void mark(std::string_view name);                               // records the last ImGui item under this name
  const char* join(std::string_view kind, std::string_view key);  // "kind: key", valid until the next call

  bool button(const char* name, const char* label, ImVec2 size = {0.0f, 0.0f});
  bool button(const char* name, const char* label, ImVec2 size, ImU32 colour);
  // Draws a drop-down list, `width` [px] wide. Returns the chosen option if it differs from the current one. `label`:
  // converts an option to its displayed text; if null, options are displayed unchanged.
  std::optional<std::string> choice(const char* name, std::string_view current, std::span<const std::string> options,
                                    float width, std::string (*label)(std::string_view) = nullptr);
  // Draws a slider of the remaining width, in the unit of the display. Returns true if the user changed the value.
  bool slider(const char* key, const haptics::FileRange& range, const haptics::Display& display, double& value);
  // Draws a dash in the curve's colour, then the text in the small font, e.g. "f_h 12.3 N".
  void legend(ImU32 colour, std::string_view text);
  // Draws one line, at most `width` [px] wide: in the small font if necessary, with an ellipsis as a last resort.
  void line(std::string_view text, float width, ImU32 colour);

 private:
  struct Place {
    ControlRect rect;
    std::uint64_t frame = 0;
  };
  std::map<std::string, Place, std::less<>> places_;
  std::vector<TabStop> stops_, last_stops_;  // of this frame and of the last one
  std::uint64_t frame_ = 0;
  int shortened_ = 0;
  std::string joined_;
};

}  // namespace gearshift::ui
