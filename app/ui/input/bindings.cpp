#include "app/ui/input/bindings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "app/ui/input/bound_controllers.h"
#include "app/ui/input/key_names.h"
#include "haptics/files/parameter_file.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::ui {
namespace {

constexpr int kMaxControllers = 16, kMaxAxes = 64;
constexpr int kMaxButtons = 528;    // the kernel's button codes 0x100 to 0x2ff, and the directions of four hats
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

// Reads lines of the form NAME = "CODE, CODE, ..." of one keyboard or controller, where a code has one meaning.
class CodeReader {
 public:
  // `of` converts the text of a code to its number. `kind` describes valid texts in error messages.
  CodeReader(const haptics::TomlTable& table, std::function<std::optional<int>(std::string_view)> of, std::string kind)
      : table_(table), of_(std::move(of)), kind_(std::move(kind)) {}

  std::vector<int> codes(const std::string& name) {
    std::vector<int> codes;
    if (!table_.has(name)) return codes;
    for (const std::string& word : words_of(table_.text(name))) {
      const std::optional<int> code = of_(word);
      if (!code) table_.fail(name, fmt::format("\"{}\" is not valid; use {}", word, kind_));
      const auto [other, is_new] = used_.emplace(*code, name);
      if (!is_new) table_.fail(name, fmt::format("\"{}\" is already bound to {}", word, other->second));
      codes.push_back(*code);
    }
    return codes;
  }

  std::map<Action, std::vector<int>> actions() {
    std::map<Action, std::vector<int>> bound;
    for (const ActionInfo& action : all_actions())
      if (std::vector<int> found = codes(std::string(action.key)); !found.empty()) bound[action.action] = found;
    return bound;
  }

 private:
  const haptics::TomlTable& table_;
  std::function<std::optional<int>(std::string_view)> of_;
  std::string kind_;
  std::map<int, std::string> used_;
};

int read_integer(const haptics::TomlTable& table, std::string_view key, int max) {
  const double number = table.number_or(key, 0.0, {0.0, static_cast<double>(max)});
  if (number != std::floor(number)) table.fail(key, "must be a whole number");
  return static_cast<int>(number);
}

struct BoundAxis {
  std::string_view action;
  AxisBinding axis;
};

void read_centre(const haptics::TomlTable& table, AxisBinding& read) {
  if (!table.has("centre")) return;
  read.centre = table.number("centre", {-1.0, 1.0});
  const double fraction = (*read.centre - read.from) / (read.to - read.from);
  if (!(fraction > kMinSide && fraction < 1.0 - kMinSide))
    table.fail("centre", fmt::format("must lie well between \"from\" ({}) and \"to\" ({})", read.from, read.to));
}

ControllerName read_name(const haptics::TomlTable& table) {
  ControllerName name;
  if (table.has("stick")) name.stick = table.text("stick");
  if (table.has("id")) name.id = table.text("id");
  return name;
}

int read_axis_number(const haptics::TomlTable& table, const ControllerName& of) {
  const std::vector<std::string> names(std::begin(kPadAxes), std::end(kPadAxes));
  if (of.stick.empty()) {
    if (table.has("axis") && !table.is_text("axis"))
      table.fail("axis",
                 "an axis number needs \"stick\", the controller's name; for any game pad use a name such as \"lt\"");
    return *pad_axis_of(table.choice("axis", names));
  }
  (void)table.number("axis", {0.0, kMaxAxes - 1.0});  // rejects a missing key, which read_integer() accepts
  return read_integer(table, "axis", kMaxAxes - 1);
}

void read_axis(const haptics::TomlTable& axes, const AxisInfo& info, std::optional<AxisBinding>& axis,
               std::vector<BoundAxis>& used) {
  const std::string_view key = info.key;
  if (!axes.has(key)) return;
  const haptics::TomlTable table = axes.table(key);
  AxisBinding read;
  read.of = read_name(table);
  read.which = read_integer(table, "pad", kMaxControllers - 1);
  read.axis = read_axis_number(table, read.of);
  read.from = table.number_or("from", read.from, {-1.0, 1.0});
  read.to = table.number_or("to", read.to, {-1.0, 1.0});
  if (std::abs(read.to - read.from) < kMinSpan)
    table.fail("to", fmt::format("must differ from \"from\" ({}) by at least {}", read.from, kMinSpan));
  if (info.is_lever) read_centre(table, read);
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
  for (const AxisInfo& info : kAxes) read_axis(axes, info, bindings.*info.axis, used);
  axes.reject_unknown_keys();
}

void read_buttons(const haptics::TomlTable& root, Bindings& bindings) {
  if (root.has("pad_buttons")) {
    const haptics::TomlTable table = root.table("pad_buttons");
    bindings.pad_buttons =
        CodeReader(table, pad_button_of, fmt::format("one of {}", fmt::join(kPadButtons, ", "))).actions();
    table.reject_unknown_keys();
  }
  for (const haptics::TomlTable& table : root.tables("controller")) {
    ControllerButtons controller;
    controller.of = {table.text("stick"), read_name(table).id};
    controller.which = read_integer(table, "pad", kMaxControllers - 1);
    const bool is_twice = std::any_of(bindings.controllers.begin(), bindings.controllers.end(), [&](const auto& other) {
      return other.of.stick == controller.of.stick && other.which == controller.which;
    });
    if (is_twice) table.fail("stick", "has another [[controller]] already");
    CodeReader reader(table, button_of, fmt::format("a button number from 0 to {}", kMaxButtons - 1));
    controller.actions = reader.actions();
    for (int gear = haptics::kReverseGear; gear <= haptics::kMaxGear; ++gear)
      if (std::vector<int> held = reader.codes(gear_key(gear)); !held.empty()) controller.gears[gear] = held;
    table.reject_unknown_keys();
    bindings.controllers.push_back(std::move(controller));
  }
}

// parts: the structs that the section sets.
void read_section(const haptics::TomlTable& root, const char* section, auto&... parts) {
  if (!root.has(section)) return;
  const haptics::TomlTable table = root.table(section);
  (haptics::read_parameters(table, parts), ...);
  table.reject_unknown_keys();
}

std::string joined(const std::vector<int>& codes, const std::function<std::string(int)>& name) {
  std::string list;
  for (const int code : codes) list += (list.empty() ? "" : ", ") + name(code);
  return list;
}

// USB id of the first game pad; empty if there is none.
std::string_view id_of_pads(const Bindings& bindings, const std::vector<engine::Controller>& all) {
  const std::vector<const engine::Controller*> pads = free_gamepads(bindings, all);
  return pads.empty() ? std::string_view() : std::string_view(pads.front()->id);
}

std::string pad_label(int button, std::string_view pad_id) {
  return "Pad " + pad_button_label(button, pad_id);
}

std::string button_label(const ControllerName& of, int button) {
  return fmt::format("{} button {}", of.stick, button);
}

// The first code that is bound to the action, as `name` prints it; empty if there is none.
std::string first_label(const std::map<Action, std::vector<int>>& bound, Action action, const auto& name) {
  const auto codes = bound.find(action);
  return codes == bound.end() || codes->second.empty() ? std::string() : name(codes->second.front());
}

// The axis that moves the pedal of this action; null if it is not bound.
const AxisBinding* pedal_axis_of(const Bindings& bindings, Action action) {
  for (const AxisInfo& info : kAxes)
    if (!info.is_lever && info.actions.front() == action && bindings.*info.axis) return &*(bindings.*info.axis);
  return nullptr;
}

// See driving_keys(); empty if the action is left out.
std::string label_at_hand(const Bindings& bindings, Action action, DeviceAtHand at_hand, std::string_view pad_id) {
  const AxisBinding* const axis = pedal_axis_of(bindings, action);
  if (at_hand == DeviceAtHand::controller && axis != nullptr && !axis->of.stick.empty()) return {};
  if (at_hand == DeviceAtHand::pad && axis != nullptr && axis->of.stick.empty())
    return pad_axis_label(axis->axis, pad_id);
  if (at_hand == DeviceAtHand::pad) {
    std::string button =
        first_label(bindings.pad_buttons, action, [&](int code) { return pad_button_label(code, pad_id); });
    if (!button.empty()) return button;
  }
  return first_label(bindings.keys, action, key_label);
}

std::string axis_label(const AxisBinding& axis, std::string_view pad_id) {
  return axis.of.stick.empty() ? "Pad " + pad_axis_label(axis.axis, pad_id)
                               : fmt::format("{} axis {}", axis.of.stick, axis.axis);
}

}  // namespace

Bindings read_bindings(const std::filesystem::path& file) {
  return parse_bindings(haptics::read_text_file(file), file.string());
}

Bindings parse_bindings(std::string_view text, const std::string& file_name) {
  const haptics::TomlTable root = haptics::TomlTable::parse(text, file_name);
  Bindings bindings;
  if (root.has("keys")) {
    const haptics::TomlTable keys = root.table("keys");
    bindings.keys = CodeReader(keys, key_of, "a key such as A, 7, F1, Left, Space, Left Shift or Keypad 4").actions();
    keys.reject_unknown_keys();
  }
  read_buttons(root, bindings);
  read_axes(root, bindings);
  read_section(root, "lever", bindings.lever);
  read_section(root, "pace", bindings.pace, bindings.pedal_timing);
  root.reject_unknown_keys();
  if (!bindings.keys.contains(Action::stop))
    root.fail({}, "[keys] has no key for stop; set one, so that you can always turn forces off");
  return bindings;
}

std::vector<DrivingKey> driving_keys(const Bindings& bindings, DeviceAtHand at_hand,
                                     const std::vector<engine::Controller>& all) {
  constexpr Action kInOrder[] = {
      Action::clutch,         Action::brake,       Action::throttle_more, Action::throttle_less, Action::throttle,
      Action::throttle_light, Action::clutch_hold, Action::hand_brake,    Action::ignition,      Action::starter,
      Action::shift_up,       Action::shift_down,  Action::push_down,     Action::lift};
  constexpr std::string_view kShort[] = {"clutch",   "brake",           "throttle",  "less",     "full throttle",
                                         "a little", "hold the clutch", "handbrake", "ignition", "starter",
                                         "gear up",  "gear down",       "knob down", "lift ring"};
  static_assert(std::size(kShort) == std::size(kInOrder));
  std::vector<DrivingKey> keys;
  for (std::size_t i = 0; i < std::size(kInOrder); ++i) {
    std::string label = label_at_hand(bindings, kInOrder[i], at_hand, id_of_pads(bindings, all));
    if (!label.empty()) keys.push_back({kShort[i], std::move(label)});
  }
  return keys;
}

std::vector<std::string> bound_inputs(const Bindings& bindings, Action action,
                                      const std::vector<engine::Controller>& all) {
  std::vector<std::string> inputs;
  const auto add = [&](const std::map<Action, std::vector<int>>& bound, const auto& name) {
    if (const auto codes = bound.find(action); codes != bound.end())
      std::transform(codes->second.begin(), codes->second.end(), std::back_inserter(inputs), name);
  };
  add(bindings.keys, key_label);
  add(bindings.pad_buttons, [id = id_of_pads(bindings, all)](int button) { return pad_label(button, id); });
  for (const ControllerButtons& one : bindings.controllers)
    add(one.actions, [&one](int button) { return button_label(one.of, button); });
  return inputs;
}

std::vector<std::string> bound_inputs(const Bindings& bindings, const AxisInfo& control,
                                      const std::vector<engine::Controller>& all) {
  std::vector<std::string> inputs;
  if (const auto& axis = bindings.*control.axis) inputs.push_back(axis_label(*axis, id_of_pads(bindings, all)));
  for (const std::optional<Action>& action : control.actions)
    if (action) std::ranges::move(bound_inputs(bindings, *action, all), std::back_inserter(inputs));
  return inputs;
}

std::string help_text(const Bindings& bindings, const std::vector<engine::Controller>& all) {
  std::string text;
  const auto line = [&text](const std::string& control, std::string_view action) {
    text += fmt::format("{}\t{}\n", control, action);
  };
  const auto lines = [&](const std::map<Action, std::vector<int>>& bound, const auto& name) {
    for (const ActionInfo& action : all_actions())
      if (const auto codes = bound.find(action.action); codes != bound.end())
        line(joined(codes->second, name), action.help);
  };
  const std::string_view pad_id = id_of_pads(bindings, all);
  lines(bindings.keys, key_label);
  line("Mouse", "move the lever (click the cabin first)");
  lines(bindings.pad_buttons, [&](int button) { return pad_label(button, pad_id); });
  for (const ControllerButtons& controller : bindings.controllers) {
    const auto name = [&](int button) { return button_label(controller.of, button); };
    lines(controller.actions, name);
    for (const auto& [gear, buttons] : controller.gears)
      line(joined(buttons, name),
           gear == haptics::kNeutralGear ? "neutral" : std::string("gear ") + haptics::gear_name(gear));
  }
  for (const AxisInfo& info : kAxes) {
    const bool shifts = info.axis == &Bindings::lever_shift && bindings.lever.mode == LeverMode::steps;
    if (const auto& axis = bindings.*info.axis)
      line(axis_label(*axis, pad_id), shifts ? "back: one gear up, forward: one gear down" : info.help);
  }
  return text;
}

}  // namespace gearshift::ui
