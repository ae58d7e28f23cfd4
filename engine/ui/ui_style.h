// Fonts, colours and spacing. Dark and subdued, so that the picture and warnings stand out.
#pragma once

#include <imgui.h>

namespace gearshift::engine {

// The fonts of the user interface, in their order in the font atlas.
enum class UiFont : int { body, small, title, prompt, digits };

ImFont* ui_font(UiFont font);            // a font of the current context
float ui_font_size(const ImFont* font);  // [px] the size at which it was loaded
float ui_font_size(UiFont font);
#if IMGUI_VERSION_NUM >= 19200
inline ImFontBaked& ui_glyphs(ImFont* font) {
  return *font->GetFontBaked(ui_font_size(font));
}
#else
inline const ImFont& ui_glyphs(ImFont* font) {
  return *font;
}
#endif
float ui_em();  // [px] size of the body font: the unit for all other sizes

// Sets a font for the enclosing block.
class WithFont {
 public:
  explicit WithFont(UiFont font);
  ~WithFont() { ImGui::PopFont(); }
  WithFont(const WithFont&) = delete;
  WithFont& operator=(const WithFont&) = delete;
};

namespace ink {
inline constexpr ImU32 kPanel = IM_COL32(21, 25, 31, 244);
inline constexpr ImU32 kWell = IM_COL32(13, 16, 20, 255);  // background of plots and fields
inline constexpr ImU32 kRaised = IM_COL32(42, 50, 60, 255);
inline constexpr ImU32 kRaisedHover = IM_COL32(55, 66, 79, 255);
inline constexpr ImU32 kLine = IM_COL32(52, 61, 72, 255);
inline constexpr ImU32 kText = IM_COL32(226, 232, 239, 255);
inline constexpr ImU32 kSoft = IM_COL32(146, 158, 171, 255);
inline constexpr ImU32 kAccent = IM_COL32(86, 171, 214, 255);
inline constexpr ImU32 kAccentDeep = IM_COL32(40, 92, 122, 255);
inline constexpr ImU32 kGood = IM_COL32(142, 203, 141, 255);
inline constexpr ImU32 kWarn = IM_COL32(238, 170, 66, 255);
inline constexpr ImU32 kBad = IM_COL32(249, 109, 93, 255);
inline constexpr ImU32 kBadDeep = IM_COL32(190, 40, 35, 255);
}  // namespace ink

ImU32 with_alpha(ImU32 colour, float alpha);  // alpha 0 to 1, multiplies the colour's alpha

// Loads the fonts into the current context's atlas and sets its style for the given scale.
void apply_ui_style(float scale);

}  // namespace gearshift::engine
