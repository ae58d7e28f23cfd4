#include "app/ui/panel/key_legend.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"
#include "haptics/files/ascii.h"
#include "haptics/gate/gate.h"

namespace gearshift::ui {
namespace {

float cap_width(const std::string& key) {
  return width_of(key, engine::UiFont::small) + 0.7f * engine::ui_em();
}

void draw_cap(const std::string& key) {
  ImFont* font = engine::ui_font(engine::UiFont::small);
  const float em = engine::ui_em(), width = cap_width(key), height = engine::ui_font_size(font) + 0.15f * em;
  const ImVec2 low = ImGui::GetCursorScreenPos(), high(low.x + width, low.y + height);
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ink::kRaised, 0.22f * em);
  list.AddRect(low, high, ink::kSoft, 0.22f * em);
  list.AddText(font, engine::ui_font_size(font), {low.x + 0.35f * em, low.y}, ink::kText, key.c_str());
}

// A phrase of the prompts, in lower case, and the action that does it. A longer phrase comes before a part of it.
struct Mention {
  std::string_view phrase, action;
};
constexpr Mention kMentions[] = {{"start the engine", "starter"},
                                 {"switch the engine off", "ignition"},
                                 {"starter", "starter"},
                                 {"ignition", "ignition"},
                                 {"handbrake", "handbrake"},
                                 {"clutch", "clutch"},
                                 {"brake", "brake"},
                                 {"throttle", "throttle"},
                                 {"accelerate", "throttle"},
                                 {"revs", "throttle"}};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// Where the phrase ends in the text as whole words, in any case; npos if it is not there.
std::size_t end_of_phrase(std::string_view text, std::string_view phrase) {
  for (std::size_t i = 0; i + phrase.size() <= text.size(); ++i) {
    const std::size_t end = i + phrase.size();
    const bool is_whole = (i == 0 || !is_letter(text[i - 1])) && (end == text.size() || !is_letter(text[end]));
    const auto equal = [](char a, char b) { return haptics::ascii_lower(a) == b; };
    if (is_whole && std::equal(phrase.begin(), phrase.end(), text.begin() + static_cast<std::ptrdiff_t>(i),
                               [&](char b, char a) { return equal(a, b); }))
      return end;
  }
  return std::string_view::npos;
}

// The key of the action; empty if the device at hand names it itself, or has none.
std::string_view key_of(std::span<const KeyHint> keys, std::string_view action) {
  const auto hint = std::find_if(keys.begin(), keys.end(), [&](const KeyHint& one) { return one.action == action; });
  return hint == keys.end() ? std::string_view() : std::string_view(hint->key);
}

std::string first(std::string_view what, std::string_view key) {
  return key.empty() ? fmt::format("{} first.", what) : fmt::format("{} first: {}.", what, key);
}

}  // namespace

std::string name_inputs(std::string_view text, std::span<const KeyHint> keys) {
  std::string named(text);
  std::vector<std::string_view> done;
  for (const Mention& mention : kMentions) {
    const std::string_view key = key_of(keys, mention.action);
    const std::size_t end = end_of_phrase(named, mention.phrase);
    if (key.empty() || end == std::string::npos || std::find(done.begin(), done.end(), key) != done.end()) continue;
    named.insert(end, fmt::format(" ({})", key));
    done.push_back(key);
  }
  return named;
}

std::string early_reply(const EarlyInput& input, const vehicle::VehicleState& car, std::span<const KeyHint> keys) {
  if (car.clutch_bite <= 0.0) return {};
  const bool is_off = !car.running && !car.ignition, clutch_up = car.pedals.clutch < car.clutch_bite;
  if (is_off && (input.starter || input.throttle)) return first("Ignition", key_of(keys, "ignition"));
  if (!car.running && input.starter && car.gear != haptics::kNeutralGear && clutch_up)
    return first("Clutch", key_of(keys, "clutch"));
  if (!car.running && input.throttle && !car.cranking) return first("Starter", key_of(keys, "starter"));
  if (car.running && input.shifts && clutch_up) return first("Clutch", key_of(keys, "clutch"));
  return {};
}

void draw_keys(std::span<const KeyHint> keys) {
  const float em = engine::ui_em();
  bool first = true;
  for (const KeyHint& hint : keys) {
    const float width = cap_width(hint.key) + 0.3f * em + width_of(hint.action, engine::UiFont::small);
    if (!first) {
      ImGui::SameLine(0.0f, 0.8f * em);
      if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
    }
    first = false;
    draw_cap(hint.key);
    ImGui::SameLine(0.0f, 0.3f * em);
    put(hint.action, ink::kSoft, engine::UiFont::small);
  }
}

void draw_restart_prompt(std::span<const KeyHint> keys) {
  const auto starter = std::find_if(
      keys.begin(), keys.end(), [](const KeyHint& hint) { return hint.action.find("starter") != std::string::npos; });
  const std::string words = starter == keys.end() ? std::string("Press the clutch, then the starter.")
                                                  : "Press the clutch, then the starter (" + starter->key + ").";
  put_wrapped(words, ink::kBad, engine::UiFont::title);
}

const char* mouse_prompt(bool mouse_moves_lever, bool panel_shown) {
  if (mouse_moves_lever) return "The mouse controls the lever (Esc releases the mouse)";
  return panel_shown ? "Click the cabin to move the lever with the mouse" : "Click to move the lever with the mouse";
}

}  // namespace gearshift::ui
