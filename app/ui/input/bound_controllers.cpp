#include "app/ui/input/bound_controllers.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift::ui {
namespace {

using engine::Controller;

constexpr const char* kNoId = "0000:0000";  // of some makers' devices
// DragonRise's encoder: GLFW's table has it as a pad, SDL has dropped it because makers wire it in different ways.
constexpr const char* kGenericEncoder = "0079:0006";
constexpr int kMaxOldButtons = 80;  // of a joystick, before Linux 6.15

// A controller that the bindings name, and what it moves.
struct NamedController {
  ControllerName of;
  std::vector<std::string> controls;
  int last_button = -1;  // highest button that is bound
};

int last_button(const ControllerButtons& controller) {
  int last = -1;
  const auto count = [&last](const auto& bound) {
    for (const auto& [meaning, buttons] : bound)
      for (const int button : buttons) last = std::max(last, button);
  };
  count(controller.actions);
  count(controller.gears);
  return last;
}

std::vector<NamedController> named_controllers(const Bindings& bindings) {
  std::vector<NamedController> named;
  const auto entry = [&](const ControllerName& of) -> NamedController& {
    const auto known =
        std::find_if(named.begin(), named.end(), [&](const auto& one) { return one.of.stick == of.stick; });
    return known != named.end() ? *known : named.emplace_back(NamedController{of, {}, -1});
  };
  for (const AxisInfo& info : kAxes) {
    const std::optional<AxisBinding>& axis = bindings.*info.axis;
    if (!axis || axis->of.stick.empty()) continue;
    std::vector<std::string>& controls = entry(axis->of).controls;
    const std::string control = info.is_lever ? "lever" : std::string(info.help);
    if (std::find(controls.begin(), controls.end(), control) == controls.end()) controls.push_back(control);
  }
  for (const ControllerButtons& controller : bindings.controllers) {
    NamedController& one = entry(controller.of);
    if (!controller.gears.empty()) one.controls.emplace_back("gears");
    if (!controller.actions.empty()) one.controls.emplace_back("buttons");
    one.last_button = last_button(controller);
  }
  return named;
}

bool is_exactly(const Controller& one, std::string_view stick) {
  return !stick.empty() && (one.name == stick || one.id == stick || one.guid == stick);
}

std::vector<const Controller*> find(const std::vector<NamedController>& named, const ControllerName& name,
                                    const std::vector<Controller>& all) {
  std::vector<const Controller*> exact, partial, same_id;
  for (const Controller& one : all) {
    const auto another = [&](const auto& matches) {
      return std::any_of(named.begin(), named.end(), [&](const NamedController& other) {
        return other.of.stick != name.stick && matches(one, other.of.stick);
      });
    };
    if (is_exactly(one, name.stick)) exact.push_back(&one);
    if (matches_stick(one, name.stick) && !another(is_exactly)) partial.push_back(&one);
    if (one.id == name.id && name.id != kNoId && !another(matches_stick)) same_id.push_back(&one);
  }
  if (!exact.empty()) return exact;
  if (!partial.empty() || same_id.size() != 1) return partial;
  return same_id;
}

bool is_named(const Controller& controller, const std::vector<NamedController>& named,
              const std::vector<Controller>& all) {
  return std::any_of(named.begin(), named.end(), [&](const NamedController& one) {
    const std::vector<const Controller*> found = find(named, one.of, all);
    return std::find(found.begin(), found.end(), &controller) != found.end();
  });
}

// Describes what is wrong with a named controller; empty if everything is as expected.
std::string describe(const Bindings& bindings, const NamedController& named, const std::vector<Controller>& all) {
  const std::string stick = haptics::printable(named.of.stick);
  const Controller* found = find_controller(bindings, named.of, 0, all);
  if (found == nullptr)
    return fmt::format("{} is not plugged in, so these have no effect: {}. Plug it in, or set up another controller.",
                       stick, fmt::join(named.controls, ", "));
  const std::string name = haptics::printable(found->name);
  if (!found->can_be_read)
    return fmt::format("This user may not read {}. \"gearshift devices\" shows how to allow it.", name);
  if (!matches_stick(*found, named.of.stick))
    return fmt::format("{} is called {} today. If its pedals or buttons have changed places, set it up again.", stick,
                       name);
  const auto buttons = static_cast<int>(found->buttons.size());
  if (named.last_button >= buttons)
    return fmt::format("{} reports {} buttons, so its button {} has no effect. {}", name, buttons, named.last_button,
                       buttons == kMaxOldButtons
                           ? "Linux before 6.15 reports at most 80; a shifter on its own USB cable has fewer."
                           : "If it is in another mode, set it up again.");
  return {};
}

}  // namespace

bool is_game_pad(const Controller& controller) noexcept {
  return controller.gamepad && controller.id != kGenericEncoder;
}

std::vector<const Controller*> free_gamepads(const Bindings& bindings, const std::vector<Controller>& all) {
  const std::vector<NamedController> named = named_controllers(bindings);
  std::vector<const Controller*> pads;
  for (const Controller& one : all)
    if (is_game_pad(one) && !is_named(one, named, all)) pads.push_back(&one);
  return pads;
}

std::optional<double> raw_value(const Bindings& bindings, const AxisBinding& axis, const std::vector<Controller>& all) {
  const auto index = static_cast<std::size_t>(axis.axis), which = static_cast<std::size_t>(axis.which);
  if (axis.of.stick.empty()) {
    const std::vector<const Controller*> pads = free_gamepads(bindings, all);
    return which < pads.size() && index < pads[which]->gamepad->axes.size()
               ? std::optional<double>(pads[which]->gamepad->axes[index])
               : std::nullopt;
  }
  const Controller* one = find_controller(bindings, axis.of, axis.which, all);
  return one != nullptr && index < one->axes.size() && std::isfinite(one->axes[index])
             ? std::optional<double>(one->axes[index])
             : std::nullopt;
}

std::vector<const Controller*> find_controllers(const Bindings& bindings, const ControllerName& name,
                                                const std::vector<Controller>& all) {
  return find(named_controllers(bindings), name, all);
}

const Controller* find_controller(const Bindings& bindings, const ControllerName& name, int which,
                                  const std::vector<Controller>& all) {
  const std::vector<const Controller*> found = find_controllers(bindings, name, all);
  const auto index = static_cast<std::size_t>(which);
  return index < found.size() ? found[index] : nullptr;
}

std::vector<const Controller*> unbound_controllers(const Bindings& bindings, const std::vector<Controller>& all) {
  const std::vector<NamedController> named = named_controllers(bindings);
  std::vector<const Controller*> unbound;
  for (const Controller& one : all)
    if (!is_game_pad(one) && !is_named(one, named, all)) unbound.push_back(&one);
  return unbound;
}

std::vector<std::string> describe_bound(const Bindings& bindings, const std::vector<Controller>& all) {
  std::vector<std::string> sentences;
  for (const NamedController& named : named_controllers(bindings))
    if (std::string sentence = describe(bindings, named, all); !sentence.empty())
      sentences.push_back(std::move(sentence));
  return sentences;
}

std::vector<std::string> describe_unbound(const Bindings& bindings, const std::vector<Controller>& all,
                                          const std::set<std::string>& declined) {
  std::vector<std::string> sentences;
  for (const Controller* one : unbound_controllers(bindings, all)) {
    const std::string name = haptics::printable(one->name);
    if (declined.contains(name)) continue;
    sentences.push_back(
        one->can_be_read
            ? fmt::format(
                  "{} was found. It has no effect until you set it up, here or by: gearshift devices --controls", name)
            : fmt::format("This user may not read {}. \"gearshift devices\" shows how to allow it.", name));
  }
  return sentences;
}

}  // namespace gearshift::ui
