#include "app/ui/input/bindings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

#include <fmt/core.h>

#include "app/ui/input/key_names.h"
#include "haptics/files/printable.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::ui {
namespace {

constexpr int kMaxPads = 16, kMaxAxes = 64, kMaxButtons = 128;
constexpr double kMinSpan = 0.1;    // [1] minimum distance of `from` and `to`; a shorter axis would act as a switch
constexpr double kMinSide = 0.05;   // [1] minimum fraction of a lever's range on each side of its centre
constexpr double kMaxZones = 0.95;  // [1] maximum sum of dead zone and end zone

// Splits "Left, Keypad 4" at the commas and trims the spaces.
std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    std::string word = list.substr(begin, end - begin);
    word.erase(0, word.find_first_not_of(' '));
    word.erase(word.find_last_not_of(' ') + 1);
    words.push_back(std::move(word));
    begin = end + 1;
  }
  return words;
}

std::optional<int> button_of(std::string_view word) {
  if (word.empty() || word.size() > 3 || word.find_first_not_of("0123456789") != std::string_view::npos) return {};
  const int button = std::atoi(std::string(word).c_str());
  return button < kMaxButtons ? std::optional(button) : std::nullopt;
}

// Reads a table with lines of the form ACTION = "NAME, NAME, ...". `of` converts a name to its key or button code.
// `kind` describes valid names in error messages.
std::map<Action, std::vector<int>> read_actions(const haptics::TomlTable& table,
                                                const std::function<std::optional<int>(std::string_view)>& of,
                                                const std::string& kind) {
  std::map<Action, std::vector<int>> bound;
  std::map<int, std::string_view> used;
  for (const ActionInfo& action : all_actions()) {
    if (!table.has(action.key)) continue;
    for (const std::string& word : words_of(table.text(action.key))) {
      const std::optional<int> code = of(word);
      if (!code) table.fail(action.key, fmt::format("\"{}\" is not valid; use {}", word, kind));
      const auto [other, is_new] = used.emplace(*code, action.key);
      if (!is_new) table.fail(action.key, fmt::format("\"{}\" is already bound to {}", word, other->second));
      bound[action.action].push_back(*code);
    }
  }
  table.reject_unknown_keys();
  return bound;
}

int read_integer(const haptics::TomlTable& table, std::string_view key, int max) {
  const double number = table.number_or(key, 0.0, {0.0, static_cast<double>(max)});
  if (number != std::floor(number)) table.fail(key, "must be a whole number");
  return static_cast<int>(number);
}

struct BoundAxis {
  std::string_view action;
  AxisBinding axis;
};

// True if both bindings use the same part of the same axis. Two pedals may share an axis, each using one half; their
// dead zones may overlap, because the measured rest of one may be a count beyond that of the other.
bool overlap(const AxisBinding& a, const AxisBinding& b) {
  if (a.stick != b.stick || a.pad != b.pad || a.axis != b.axis) return false;
  const auto start = [](const AxisBinding& axis) { return axis.from + axis.dead_zone * (axis.to - axis.from); };
  const auto [a_low, a_high] = std::minmax({start(a), a.to});
  const auto [b_low, b_high] = std::minmax({start(b), b.to});
  return a_low < b_high && b_low < a_high;
}

void read_centre(const haptics::TomlTable& table, AxisBinding& read) {
  if (!table.has("centre")) return;
  read.centre = table.number("centre", {-1.0, 1.0});
  const double fraction = (*read.centre - read.from) / (read.to - read.from);
  if (!(fraction > kMinSide && fraction < 1.0 - kMinSide))
    table.fail("centre", fmt::format("must lie well between \"from\" ({}) and \"to\" ({})", read.from, read.to));
}

void read_axis(const haptics::TomlTable& axes, std::string_view key, std::optional<AxisBinding>& axis,
               std::vector<BoundAxis>& used) {
  if (!axes.has(key)) return;
  const haptics::TomlTable table = axes.table(key);
  AxisBinding read;
  if (table.has("stick")) read.stick = table.text("stick");
  read.pad = read_integer(table, "pad", kMaxPads - 1);
  (void)table.number("axis", {0.0, kMaxAxes - 1.0});  // rejects a missing key, which read_integer() accepts
  read.axis = read_integer(table, "axis", kMaxAxes - 1);
  read.from = table.number_or("from", read.from, {-1.0, 1.0});
  read.to = table.number_or("to", read.to, {-1.0, 1.0});
  if (std::abs(read.to - read.from) < kMinSpan)
    table.fail("to", fmt::format("must differ from \"from\" ({}) by at least {}", read.from, kMinSpan));
  if (key.starts_with("lever")) read_centre(table, read);
  read.dead_zone = table.number_or("dead_zone", read.dead_zone, {0.0, 0.9});
  read.end_zone = table.number_or("end_zone", read.end_zone, {0.0, 0.9});
  if (read.dead_zone + read.end_zone > kMaxZones)
    table.fail("end_zone",
               fmt::format("the sum of end_zone and dead_zone ({}) must not exceed {}", read.dead_zone, kMaxZones));
  const auto other = std::find_if(used.begin(), used.end(), [&](const auto& one) { return overlap(one.axis, read); });
  if (other != used.end()) table.fail("axis", fmt::format("is already bound to {}", other->action));
  table.reject_unknown_keys();
  used.push_back({key, read});
  axis = read;
}

void read_axes(const haptics::TomlTable& root, Bindings& bindings) {
  if (!root.has("pad_axes")) return;
  const haptics::TomlTable axes = root.table("pad_axes");
  std::vector<BoundAxis> used;
  read_axis(axes, "lever_select", bindings.lever_select, used);
  read_axis(axes, "lever_shift", bindings.lever_shift, used);
  read_axis(axes, "throttle", bindings.throttle, used);
  read_axis(axes, "brake", bindings.brake, used);
  read_axis(axes, "clutch", bindings.clutch, used);
  axes.reject_unknown_keys();
}

void read_buttons(const haptics::TomlTable& root, Bindings& bindings) {
  if (!root.has("pad_buttons")) return;
  const haptics::TomlTable table = root.table("pad_buttons");
  if (table.has("stick")) bindings.button_stick = table.text("stick");
  bindings.pad_buttons = read_actions(table, button_of, fmt::format("a button number from 0 to {}", kMaxButtons - 1));
}

void read_lever(const haptics::TomlTable& root, Bindings& bindings) {
  if (!root.has("lever")) return;
  const haptics::TomlTable lever = root.table("lever");
  if (lever.has("mode"))
    bindings.lever_mode = lever.choice("mode", {"moves", "places"}) == "moves" ? LeverMode::moves : LeverMode::places;
  bindings.stick_speed = lever.number_or("full_speed_m_per_s", bindings.stick_speed, {0.01, 2.0});
  lever.reject_unknown_keys();
}

void read_pace(const haptics::TomlTable& root, Bindings& bindings) {
  if (!root.has("pace")) return;
  const haptics::TomlTable pace = root.table("pace");
  bindings.mouse_mm_per_px = pace.number_or("mouse_mm_per_px", bindings.mouse_mm_per_px, {0.005, 5.0});
  bindings.key_speed = pace.number_or("lever_key_m_per_s", bindings.key_speed, {0.01, 2.0});
  vehicle::PedalTiming& pedals = bindings.pedal_timing;
  pedals.pedal_time = pace.number_or("pedal_key_s", pedals.pedal_time, {0.01, 5.0});
  pedals.slip_time = pace.number_or("clutch_key_slip_s", pedals.slip_time, {0.01, 10.0});
  pace.reject_unknown_keys();
}

std::string joined(const std::vector<int>& codes, const std::function<std::string(int)>& name) {
  std::string list;
  for (const int code : codes) list += (list.empty() ? "" : ", ") + name(code);
  return list;
}

// Returns the help text of an axis: the text of the action with the same key. The lever's axes have no such action and
// get a separate text.
std::string_view axis_help(std::string_view key) {
  for (const ActionInfo& action : all_actions())
    if (action.key == key) return action.help;
  return key == "lever_select" ? "move the lever sideways" : "move the lever forward and back";
}

}  // namespace

Bindings read_bindings(const std::filesystem::path& file) {
  const haptics::TomlTable root = haptics::TomlTable::parse(haptics::read_text_file(file), file.string());
  Bindings bindings;
  if (root.has("keys"))
    bindings.keys =
        read_actions(root.table("keys"), key_of, "a key such as A, 7, F1, Left, Space, Left Shift or Keypad 4");
  read_buttons(root, bindings);
  read_axes(root, bindings);
  read_lever(root, bindings);
  read_pace(root, bindings);
  root.reject_unknown_keys();
  if (!bindings.keys.contains(Action::stop))
    root.fail({}, "[keys] has no key for stop; set one, so that you can always turn forces off");
  return bindings;
}

std::vector<std::string> describe_unbound(const Bindings& bindings, const std::vector<engine::PadState>& sticks) {
  std::map<std::string, std::string> controls;  // of each stick that the bindings name
  const auto add = [&controls](const std::string& stick, const char* control) {
    if (!stick.empty()) controls[stick] += (controls[stick].empty() ? "" : ", ") + std::string(control);
  };
  for (const auto& [axis, control] : {std::pair{&bindings.lever_select, "lever"},
                                      {&bindings.throttle, "throttle"},
                                      {&bindings.brake, "brake"},
                                      {&bindings.clutch, "clutch"}})
    if (*axis) add((*axis)->stick, control);
  if (!bindings.pad_buttons.empty()) add(bindings.button_stick, "buttons");
  std::vector<std::string> sentences;
  for (const auto& [stick, names] : controls) {
    const bool is_there = std::any_of(sticks.begin(), sticks.end(),
                                      [&name = stick](const engine::PadState& s) { return matches_stick(s, name); });
    if (!is_there)
      sentences.push_back(
          fmt::format("{} is not plugged in, so it moves no {}; plug it in, or run: gearshift devices --calibrate",
                      haptics::printable(stick), names));
  }
  for (const engine::PadState& stick : sticks) {
    const bool is_named = std::any_of(controls.begin(), controls.end(),
                                      [&](const auto& named) { return matches_stick(stick, named.first); });
    if (!stick.is_pad && !stick.axes.empty() && !is_named)
      sentences.push_back(
          fmt::format("{} was found; it moves nothing until you set it up: gearshift devices --calibrate",
                      haptics::printable(stick.name)));
  }
  return sentences;
}

std::vector<DrivingKey> driving_keys(const Bindings& bindings) {
  constexpr Action kInOrder[] = {Action::clutch,      Action::brake,      Action::throttle, Action::throttle_light,
                                 Action::clutch_hold, Action::hand_brake, Action::ignition, Action::starter,
                                 Action::push_down,   Action::lift};
  constexpr std::string_view kShort[] = {"clutch",    "brake",    "throttle", "a little throttle", "hold the clutch",
                                         "handbrake", "ignition", "starter",  "knob down",         "lift ring"};
  std::vector<DrivingKey> keys;
  for (std::size_t i = 0; i < std::size(kInOrder); ++i)
    if (const auto bound = bindings.keys.find(kInOrder[i]); bound != bindings.keys.end() && !bound->second.empty())
      keys.push_back({kShort[i], key_label(bound->second.front())});
  return keys;
}

std::string help_text(const Bindings& bindings) {
  std::string text;
  const auto line = [&text](const std::string& control, std::string_view action) {
    text += fmt::format("{}\t{}\n", control, action);
  };
  for (const ActionInfo& action : all_actions())
    if (const auto keys = bindings.keys.find(action.action); keys != bindings.keys.end())
      line(joined(keys->second, key_label), action.help);
  line("Mouse", "move the lever (click the cabin first)");
  for (const ActionInfo& action : all_actions())
    if (const auto buttons = bindings.pad_buttons.find(action.action); buttons != bindings.pad_buttons.end())
      line(joined(buttons->second,
                  [&](int button) {
                    return bindings.button_stick.empty() ? "Pad " + pad_button_label(button)
                                                         : fmt::format("{} button {}", bindings.button_stick, button);
                  }),
           action.help);
  const std::pair<const std::optional<AxisBinding>&, std::string_view> axes[] = {
      {bindings.lever_select, "lever_select"},
      {bindings.lever_shift, "lever_shift"},
      {bindings.throttle, "throttle"},
      {bindings.brake, "brake"},
      {bindings.clutch, "clutch"}};
  for (const auto& [axis, key] : axes)
    if (axis)
      line(axis->stick.empty() ? "Pad " + pad_axis_label(axis->axis)
                               : fmt::format("{} axis {}", axis->stick, axis->axis),
           axis_help(key));
  return text;
}

}  // namespace gearshift::ui
