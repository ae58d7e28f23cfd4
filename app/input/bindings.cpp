#include "app/input/bindings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

#include <fmt/core.h>

#include "app/input/key_names.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift {
namespace {

constexpr int kMostPads = 16, kMostAxes = 64, kMostButtons = 128;
constexpr double kLeastSpan = 0.1;   // [1] of an axis, from `from` to `to`: a shorter one is a switch
constexpr double kLeastSide = 0.05;  // [1] of that, on either side of a lever's centre
constexpr double kMostZones = 0.95;  // [1] in which nothing happens

// "Left, Keypad 4" -> its words, without the spaces around them.
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
  return button < kMostButtons ? std::optional(button) : std::nullopt;
}

// One table of action = "name, name, ...". of: what a name means; kind: what it must be.
std::map<Action, std::vector<int>> read_actions(const TomlTable& table,
                                                const std::function<std::optional<int>(std::string_view)>& of,
                                                const std::string& kind) {
  std::map<Action, std::vector<int>> bound;
  std::map<int, std::string_view> taken;
  for (const ActionInfo& action : all_actions()) {
    if (!table.has(action.key)) continue;
    for (const std::string& word : words_of(table.text(action.key))) {
      const std::optional<int> code = of(word);
      if (!code) table.fail(action.key, fmt::format("\"{}\" must be {}", word, kind));
      const auto [other, is_new] = taken.emplace(*code, action.key);
      if (!is_new) table.fail(action.key, fmt::format("\"{}\" does {} already", word, other->second));
      bound[action.action].push_back(*code);
    }
  }
  table.refuse_unknown_keys();
  return bound;
}

int whole(const TomlTable& table, std::string_view key, int most) {
  const double number = table.number_or(key, 0.0, {0.0, static_cast<double>(most)});
  if (number != std::floor(number)) table.fail(key, "must be a whole number");
  return static_cast<int>(number);
}

// The axes that do something, and from where to where.
struct TakenAxis {
  std::string_view does;
  AxisBinding axis;
};

// Two pedals may be the halves of one axis.
bool overlap(const AxisBinding& a, const AxisBinding& b) {
  if (a.stick != b.stick || a.pad != b.pad || a.axis != b.axis) return false;
  const auto [a_low, a_high] = std::minmax(a.from, a.to);
  const auto [b_low, b_high] = std::minmax(b.from, b.to);
  return a_low < b_high && b_low < a_high;
}

void read_centre(const TomlTable& table, AxisBinding& read) {
  if (!table.has("centre")) return;
  read.centre = table.number("centre", {-1.0, 1.0});
  const double share = (*read.centre - read.from) / (read.to - read.from);
  if (!(share > kLeastSide && share < 1.0 - kLeastSide))
    table.fail("centre", fmt::format("must be well between from = {} and to = {}", read.from, read.to));
}

void read_axis(const TomlTable& axes, std::string_view key, std::optional<AxisBinding>& axis,
               std::vector<TakenAxis>& taken) {
  if (!axes.has(key)) return;
  const TomlTable table = axes.table(key);
  AxisBinding read;
  if (table.has("stick")) read.stick = table.text("stick");
  read.pad = whole(table, "pad", kMostPads - 1);
  (void)table.number("axis", {0.0, kMostAxes - 1.0});  // must be there
  read.axis = whole(table, "axis", kMostAxes - 1);
  read.from = table.number_or("from", read.from, {-1.0, 1.0});
  read.to = table.number_or("to", read.to, {-1.0, 1.0});
  if (std::abs(read.to - read.from) < kLeastSpan)
    table.fail("to", fmt::format("must be at least {} away from from = {}", kLeastSpan, read.from));
  if (key.starts_with("lever")) read_centre(table, read);
  read.dead_zone = table.number_or("dead_zone", read.dead_zone, {0.0, 0.9});
  read.end_zone = table.number_or("end_zone", read.end_zone, {0.0, 0.9});
  if (read.dead_zone + read.end_zone > kMostZones)
    table.fail("end_zone", fmt::format("must be at most {} together with dead_zone = {}", kMostZones, read.dead_zone));
  const auto other = std::find_if(taken.begin(), taken.end(), [&](const auto& one) { return overlap(one.axis, read); });
  if (other != taken.end()) table.fail("axis", fmt::format("does {} already", other->does));
  table.refuse_unknown_keys();
  taken.push_back({key, read});
  axis = read;
}

void read_axes(const TomlTable& root, Bindings& bindings) {
  if (!root.has("pad_axes")) return;
  const TomlTable axes = root.table("pad_axes");
  std::vector<TakenAxis> taken;
  read_axis(axes, "lever_select", bindings.lever_select, taken);
  read_axis(axes, "lever_shift", bindings.lever_shift, taken);
  read_axis(axes, "throttle", bindings.throttle, taken);
  read_axis(axes, "brake", bindings.brake, taken);
  read_axis(axes, "clutch", bindings.clutch, taken);
  axes.refuse_unknown_keys();
}

void read_buttons(const TomlTable& root, Bindings& bindings) {
  if (!root.has("pad_buttons")) return;
  const TomlTable table = root.table("pad_buttons");
  if (table.has("stick")) bindings.button_stick = table.text("stick");
  bindings.pad_buttons = read_actions(table, button_of, fmt::format("a button's number, 0 to {}", kMostButtons - 1));
}

void read_lever(const TomlTable& root, Bindings& bindings) {
  if (!root.has("lever")) return;
  const TomlTable lever = root.table("lever");
  if (lever.has("mode"))
    bindings.lever_mode = lever.choice("mode", {"moves", "places"}) == "moves" ? LeverMode::moves : LeverMode::places;
  bindings.stick_speed = lever.number_or("full_speed_m_per_s", bindings.stick_speed, {0.01, 2.0});
  lever.refuse_unknown_keys();
}

void read_pace(const TomlTable& root, Bindings& bindings) {
  if (!root.has("pace")) return;
  const TomlTable pace = root.table("pace");
  bindings.mouse_mm_per_px = pace.number_or("mouse_mm_per_px", bindings.mouse_mm_per_px, {0.005, 5.0});
  bindings.key_speed = pace.number_or("lever_key_m_per_s", bindings.key_speed, {0.01, 2.0});
  bindings.pedal_time = pace.number_or("pedal_key_s", bindings.pedal_time, {0.01, 5.0});
  bindings.clutch_slip_time = pace.number_or("clutch_key_slip_s", bindings.clutch_slip_time, {0.01, 10.0});
  pace.refuse_unknown_keys();
}

std::string joined(const std::vector<int>& codes, const std::function<std::string(int)>& name) {
  std::string list;
  for (const int code : codes) list += (list.empty() ? "" : ", ") + name(code);
  return list;
}

// The action that stands for an axis in the help: its words are the same.
std::string_view says(std::string_view key) {
  for (const ActionInfo& action : all_actions())
    if (action.key == key) return action.says;
  return key == "lever_select" ? "lever sideways" : "lever forward and back";
}

std::string stick_words(const std::string& stick) {
  return stick.empty() ? "Pad" : stick;
}

}  // namespace

Bindings read_bindings(const std::filesystem::path& file) {
  const TomlTable root = TomlTable::parse(read_text_file(file), file.string());
  Bindings bindings;
  if (root.has("keys"))
    bindings.keys =
        read_actions(root.table("keys"), key_of, "a key such as A, 7, F1, Left, Space, Left Shift or Keypad 4");
  read_buttons(root, bindings);
  read_axes(root, bindings);
  read_lever(root, bindings);
  read_pace(root, bindings);
  root.refuse_unknown_keys();
  if (!bindings.keys.contains(Action::stop)) root.fail({}, "[keys] has no stop: one key must turn the motors off");
  return bindings;
}

std::vector<DrivingKey> driving_keys(const Bindings& bindings) {
  constexpr Action kInOrder[] = {Action::clutch,      Action::brake,      Action::throttle, Action::throttle_light,
                                 Action::clutch_hold, Action::hand_brake, Action::ignition, Action::starter,
                                 Action::push_down,   Action::lift};
  constexpr std::string_view kShort[] = {"clutch",     "brake",    "throttle", "a little throttle", "hold the clutch",
                                         "hand brake", "ignition", "starter",  "knob down",         "lift ring"};
  std::vector<DrivingKey> keys;
  for (std::size_t i = 0; i < std::size(kInOrder); ++i)
    if (const auto bound = bindings.keys.find(kInOrder[i]); bound != bindings.keys.end() && !bound->second.empty())
      keys.push_back({kShort[i], key_name(bound->second.front())});
  return keys;
}

std::string help_text(const Bindings& bindings) {
  std::string text;
  const auto line = [&text](const std::string& what, std::string_view does) {
    text += fmt::format("{}\t{}\n", what, does);
  };
  for (const ActionInfo& action : all_actions())
    if (const auto keys = bindings.keys.find(action.action); keys != bindings.keys.end())
      line(joined(keys->second, key_name), action.says);
  line("Mouse", "the lever, after a click beside the panel");
  for (const ActionInfo& action : all_actions())
    if (const auto buttons = bindings.pad_buttons.find(action.action); buttons != bindings.pad_buttons.end())
      line(stick_words(bindings.button_stick) + " button " +
               joined(buttons->second, [](int button) { return std::to_string(button); }),
           action.says);
  const std::pair<const std::optional<AxisBinding>&, std::string_view> axes[] = {
      {bindings.lever_select, "lever_select"},
      {bindings.lever_shift, "lever_shift"},
      {bindings.throttle, "throttle"},
      {bindings.brake, "brake"},
      {bindings.clutch, "clutch"}};
  for (const auto& [axis, key] : axes)
    if (axis) line(fmt::format("{} axis {}", stick_words(axis->stick), axis->axis), says(key));
  return text;
}

}  // namespace gearshift
