#include "engine/ui/ui_style.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

namespace gearshift::engine {
namespace {

// Font from Debian's package fonts-dejavu-core. Its digits have equal widths, so that changing numbers do not jitter.
constexpr const char* kRegular = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr const char* kBold = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";

// Letters in the font atlas: Latin-1, dashes and ellipsis, arrows, comparisons. Each pair is the first and last code
// point of a range; 0 ends the list.
constexpr ImWchar kLetters[] = {0x20, 0xff, 0x2010, 0x2026, 0x2190, 0x2193, 0x2264, 0x2265, 0};
// The regular fonts, in which keys are named, also have the first Latin extension, Greek and Cyrillic.
constexpr ImWchar kKeyLetters[] = {0x20, 0x17f, 0x384, 0x45f, 0x2010, 0x2026, 0x2190, 0x2193, 0x2264, 0x2265, 0};

struct FontFile {
  const char* path;
  float size;  // [px] at scale 1, including line spacing
  const ImWchar* letters;
};
constexpr FontFile kFonts[] = {{kRegular, 15.0f, kKeyLetters},
                               {kRegular, 13.0f, kKeyLetters},
                               {kBold, 16.0f, kLetters},
                               {kBold, 22.0f, kLetters},
                               {kBold, 42.0f, kLetters}};

void load_font(const FontFile& font, float scale) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.OversampleH = 2;
  config.SizePixels = std::round(font.size * scale);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(font.path, ignored)) {
    atlas.AddFontFromFileTTF(font.path, config.SizePixels, &config, font.letters);
  } else {
    atlas.AddFontDefault(&config);
  }
}

void set_sizes(ImGuiStyle& style) {
  style.WindowPadding = {10.0f, 8.0f};
  style.FramePadding = {7.0f, 3.0f};
  style.ItemSpacing = {7.0f, 5.0f};
  style.ItemInnerSpacing = {6.0f, 4.0f};
  style.CellPadding = {5.0f, 2.0f};
  style.ScrollbarSize = 11.0f;
  style.GrabMinSize = 11.0f;
  style.WindowBorderSize = 0.0f;
  style.PopupBorderSize = 1.0f;
  style.WindowRounding = 0.0f;
  style.ChildRounding = style.FrameRounding = style.GrabRounding = style.TabRounding = 3.0f;
  style.PopupRounding = 4.0f;
  style.ScrollbarRounding = 6.0f;
}

void set_colours(ImGuiStyle& style) {
  struct Choice {
    ImGuiCol_ what;
    ImU32 colour;
  };
  constexpr ImU32 kClear = IM_COL32(0, 0, 0, 0);
  constexpr Choice kChoices[] = {{ImGuiCol_Text, ink::kText},
                                 {ImGuiCol_TextDisabled, ink::kSoft},
                                 {ImGuiCol_WindowBg, ink::kPanel},
                                 {ImGuiCol_ChildBg, kClear},
                                 {ImGuiCol_PopupBg, IM_COL32(27, 32, 39, 252)},
                                 {ImGuiCol_Border, ink::kLine},
                                 {ImGuiCol_FrameBg, ink::kWell},
                                 {ImGuiCol_FrameBgHovered, IM_COL32(24, 30, 37, 255)},
                                 {ImGuiCol_FrameBgActive, IM_COL32(28, 36, 44, 255)},
                                 {ImGuiCol_Button, ink::kRaised},
                                 {ImGuiCol_ButtonHovered, ink::kRaisedHover},
                                 {ImGuiCol_ButtonActive, ink::kAccentDeep},
                                 {ImGuiCol_Header, ink::kAccentDeep},
                                 {ImGuiCol_HeaderHovered, ink::kRaisedHover},
                                 {ImGuiCol_HeaderActive, ink::kAccentDeep},
                                 {ImGuiCol_SliderGrab, IM_COL32(58, 124, 164, 255)},
                                 {ImGuiCol_SliderGrabActive, ink::kAccent},
                                 {ImGuiCol_CheckMark, ink::kAccent},
                                 {ImGuiCol_Separator, ink::kLine},
                                 {ImGuiCol_Tab, IM_COL32(30, 36, 44, 255)},
                                 {ImGuiCol_TabHovered, ink::kRaisedHover},
                                 {ImGuiCol_TabActive, ink::kAccentDeep},
                                 {ImGuiCol_TabUnfocused, IM_COL32(30, 36, 44, 255)},
                                 {ImGuiCol_TabUnfocusedActive, ink::kAccentDeep},
                                 {ImGuiCol_ScrollbarBg, kClear},
                                 {ImGuiCol_ScrollbarGrab, ink::kRaised},
                                 {ImGuiCol_NavHighlight, ink::kWarn},
                                 {ImGuiCol_TextSelectedBg, ink::kAccentDeep},
                                 {ImGuiCol_TableBorderLight, ink::kLine},
                                 {ImGuiCol_TableHeaderBg, kClear},
                                 {ImGuiCol_TitleBgActive, ink::kAccentDeep},
                                 {ImGuiCol_TitleBg, ink::kAccentDeep}};
  for (const Choice& choice : kChoices) style.Colors[choice.what] = ImGui::ColorConvertU32ToFloat4(choice.colour);
}

}  // namespace

ImFont* ui_font(UiFont font) {
  return ImGui::GetIO().Fonts->Fonts[static_cast<int>(font)];
}

float ui_font_size(const ImFont* font) {
#if IMGUI_VERSION_NUM >= 19200
  return font->LegacySize;
#else
  return font->FontSize;
#endif
}

float ui_font_size(UiFont font) {
  return ui_font_size(ui_font(font));
}

float ui_em() {
  return ui_font_size(UiFont::body);
}

WithFont::WithFont(UiFont font) {
#if IMGUI_VERSION_NUM >= 19200
  ImGui::PushFont(ui_font(font), ui_font_size(font));
#else
  ImGui::PushFont(ui_font(font));
#endif
}

ImU32 with_alpha(ImU32 colour, float alpha) {
  const float original = static_cast<float>((colour >> IM_COL32_A_SHIFT) & 0xff);
  const auto scaled = static_cast<ImU32>(std::lround(original * std::clamp(alpha, 0.0f, 1.0f)));
  return (colour & ~IM_COL32_A_MASK) | (scaled << IM_COL32_A_SHIFT);
}

void apply_ui_style(float scale) {
  ImGui::GetIO().Fonts->Clear();
  for (const FontFile& font : kFonts) load_font(font, scale);
  // Builds the atlas in the format that the overlay reads. Otherwise Dear ImGui 1.92 would build it again for the overlay,
  // and drop the id that the texture has by then.
  unsigned char* coverage = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&coverage, &width, &height);
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  set_sizes(style);
  set_colours(style);
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace gearshift::engine
