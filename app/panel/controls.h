// Named controls: what stands where, so that a test or a script can click it, and whether its text had room.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>

namespace gearshift {

struct ControlRect {
  glm::dvec2 min{0.0}, max{0.0};  // [px]
};

class Controls {
 public:
  void begin_frame() noexcept;

  // Of this frame; nothing where the control was not drawn or is scrolled out of sight.
  std::optional<ControlRect> rect(std::string_view name) const;
  int shortened() const noexcept { return shortened_; }  // texts of this frame that had too little room

  void mark(std::string_view name);  // the item just made

  bool button(const char* name, const char* label, ImVec2 size = {0.0f, 0.0f});
  bool button(const char* name, const char* label, ImVec2 size, ImU32 colour);  // in that colour
  // A choice of several; what was chosen, where it is another one. width [px]; words: how an option is shown, else as
  // it is.
  std::optional<std::string> choice(const char* name, const std::string& current, std::span<const std::string> options,
                                    float width, std::string (*words)(const std::string&) = nullptr);
  // "f_h 12.3 N" after a dash in the colour of its curve, in the small font.
  void legend(ImU32 colour, std::string_view text);
  // One line in at most that width [px]: in the small font where need be, and with an ellipsis as a last resort.
  void line(std::string_view text, float width, ImU32 colour);

 private:
  struct Place {
    ControlRect rect;
    std::uint64_t frame = 0;
  };
  std::map<std::string, Place, std::less<>> places_;
  std::uint64_t frame_ = 0;
  int shortened_ = 0;
};

}  // namespace gearshift
