// How everything looks: fonts, colours, spacing. Dark and quiet, so that picture and warnings stand out.
#pragma once

#include <imgui.h>

namespace gearshift {

// In this order in the atlas. Sizes in pixels at scale 1, line height included.
enum class UiFont : int { body, small, title, prompt, digits };

ImFont* ui_font(UiFont font);  // of the current context
float ui_em();                 // [px] size of the body font: what everything is measured in

// For the scope of a block.
class WithFont {
 public:
  explicit WithFont(UiFont font) { ImGui::PushFont(ui_font(font)); }
  ~WithFont() { ImGui::PopFont(); }
  WithFont(const WithFont&) = delete;
  WithFont& operator=(const WithFont&) = delete;
};

namespace ink {
inline constexpr ImU32 kPanel = IM_COL32(21, 25, 31, 244);
inline constexpr ImU32 kWell = IM_COL32(13, 16, 20, 255);  // what plots and fields stand in
inline constexpr ImU32 kRaised = IM_COL32(42, 50, 60, 255);
inline constexpr ImU32 kRaisedHover = IM_COL32(55, 66, 79, 255);
inline constexpr ImU32 kLine = IM_COL32(52, 61, 72, 255);
inline constexpr ImU32 kText = IM_COL32(226, 232, 239, 255);
inline constexpr ImU32 kSoft = IM_COL32(146, 158, 171, 255);
inline constexpr ImU32 kAccent = IM_COL32(86, 171, 214, 255);
inline constexpr ImU32 kAccentDeep = IM_COL32(40, 92, 122, 255);
inline constexpr ImU32 kGood = IM_COL32(98, 186, 122, 255);
inline constexpr ImU32 kWarn = IM_COL32(238, 170, 66, 255);
inline constexpr ImU32 kBad = IM_COL32(226, 76, 66, 255);
inline constexpr ImU32 kBadDeep = IM_COL32(190, 40, 35, 255);
}  // namespace ink

ImU32 with_alpha(ImU32 colour, float alpha);  // alpha 0 to 1, of what it has

// Loads the fonts into the current context's atlas and sets its style, for that scale.
void apply_ui_style(float scale);

}  // namespace gearshift
