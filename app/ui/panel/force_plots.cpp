#include "app/ui/panel/force_plots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/ui/panel/format_value.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/plot_area.h"
#include "haptics/gate/aisle.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift::ui {
namespace {

double along(PlotAxis axis, glm::dvec2 vector) {
  return axis == PlotAxis::select ? vector.x : vector.y;
}

// Plot range [mm]: at least 5 mm beyond the outermost wall, because a hand can push through the wall; rounded up to
// whole centimetres.
PlotRange reach_of(const haptics::Gate& gate, PlotAxis axis) {
  const double centimetres = 10.0 * std::ceil(1e2 * along(axis, haptics::half_extent(gate)) + 0.5);
  return {-centimetres, centimetres};
}

float header_height() {
  return engine::ui_font_size(engine::UiFont::small) + ImGui::GetStyle().ItemSpacing.y;
}

void header(const char* text) {
  const engine::WithFont small(engine::UiFont::small);
  ImGui::PushStyleColor(ImGuiCol_Text, ink::kSoft);
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void entry(Controls& controls, ImU32 colour, const char* name, double value, const char* unit) {
  ImGui::SameLine(0.0f, 0.8f * engine::ui_em());
  controls.legend(colour, fmt::format("{} {}", name, format_value(value, unit, 1)));
}

PlotRange force_range(double max_force) {
  const double half = std::isfinite(max_force) ? nice_above(1.05 * max_force, 10.0) : 10.0;
  return {-half, half};
}

}  // namespace

void ForcePlots::push(const haptics::HapticSnapshot& snapshot) {
  const double time = 1e-9 * static_cast<double>(snapshot.time_ns);
  for (const PlotAxis which : {PlotAxis::select, PlotAxis::shift}) {
    Axis& a = axes_[static_cast<std::size_t>(which)];
    a.hand.push(time, along(which, snapshot.f_h));
    a.actuator.push(time, along(which, snapshot.f_a));
    a.joystick.push(time, along(which, snapshot.f_j));
    a.lever.push(time, along(which, snapshot.lever));
    a.proxy.push(time, along(which, snapshot.proxy));
  }
}

void ForcePlots::draw_axis_choice(Controls& controls) {
  struct Choice {
    const char* name;
    const char* label;
    PlotAxis axis;
  };
  constexpr Choice kChoices[] = {{"axis_shift", "shift", PlotAxis::shift}, {"axis_select", "select", PlotAxis::select}};
  const engine::WithFont small(engine::UiFont::small);
  for (const Choice& choice : kChoices) {
    ImGui::SameLine(0.0f, 0.25f * engine::ui_em());
    const bool on = axis_ == choice.axis;
    if (controls.button(choice.name, choice.label, {0.0f, 0.0f}, on ? ink::kAccentDeep : ink::kRaised))
      axis_ = choice.axis;
  }
}

void ForcePlots::draw(Controls& controls, float height, const haptics::Gate& gate, const haptics::HapticSnapshot& now,
                      const Trail& trail) {
  const float room = height - 3.0f * (header_height() + ImGui::GetStyle().ItemSpacing.y);
  draw_forces(controls, 0.36f * room, now);
  draw_position(controls, 0.25f * room, gate, now);
  draw_force_at_position(controls, 0.39f * room, gate, now, trail);
}

void ForcePlots::draw_forces(Controls& controls, float height, const haptics::HapticSnapshot& now) {
  header("Force");
  const bool estimated = (now.flags & haptics::kFlagPushEstimated) != 0;
  entry(controls, ink::kHand, estimated ? "f_h estimated" : "f_h", along(axis_, now.f_h), "N");
  entry(controls, ink::kActuator, "f_a", along(axis_, now.f_a), "N");
  entry(controls, ink::kJoystick, "f_j", along(axis_, now.f_j), "N");
  Axis& a = axis();
  double max_force = 0.0;
  for (const Strip* strip : {&a.hand, &a.actuator, &a.joystick}) {
    const StripColumn extent = strip->extent();
    max_force = std::max({max_force, -extent.min, extent.max});
  }
  PlotArea plot({ImGui::GetContentRegionAvail().x, height}, {-kSpan, 0.0}, force_range(max_force), nullptr);
  const auto curve = [&](Strip& strip, ImU32 colour) {
    strip.set_columns(std::max(1, plot.columns()));
    plot.strip(strip, 1.0, colour);
  };
  curve(a.joystick, ink::kJoystick);
  curve(a.actuator, ink::kActuator);
  curve(a.hand, ink::kHand);
}

void ForcePlots::draw_position(Controls& controls, float height, const haptics::Gate& gate,
                               const haptics::HapticSnapshot& now) {
  header("Position");
  entry(controls, ink::kLever, "lever", 1e3 * along(axis_, now.lever), "mm");
  entry(controls, ink::kProxy, "drawn", 1e3 * along(axis_, now.proxy), "mm");
  Axis& a = axis();
  PlotArea plot({ImGui::GetContentRegionAvail().x, height}, {-kSpan, 0.0}, reach_of(gate, axis_), "s");
  const auto curve = [&](Strip& strip, ImU32 colour) {
    strip.set_columns(std::max(1, plot.columns()));
    plot.strip(strip, 1e3, colour);
  };
  curve(a.lever, ink::kLever);
  curve(a.proxy, ink::kProxy);
}

void ForcePlots::draw_force_at_position(Controls& controls, float height, const haptics::Gate& gate,
                                        const haptics::HapticSnapshot& now, const Trail& trail) {
  header("Force at position");
  entry(controls, ink::kActuator, "commanded", along(axis_, now.commanded), "N");
  double max_force = std::abs(along(axis_, now.commanded));
  for (const TrailPoint& point : trail.points())
    max_force = std::max(max_force, std::abs(along(axis_, point.commanded)));
  PlotArea plot({ImGui::GetContentRegionAvail().x, height}, reach_of(gate, axis_), force_range(max_force), "mm");
  const auto place = [&](glm::dvec2 lever, glm::dvec2 force) {
    return plot.at(1e3 * along(axis_, lever), along(axis_, force));
  };
  const TrailPoint* before = nullptr;
  for (const TrailPoint& point : trail.points()) {
    const auto fresh = static_cast<float>(1.0 - trail.age(point));
    if (before != nullptr)
      plot.list().AddLine(place(before->lever, before->commanded), place(point.lever, point.commanded),
                          engine::with_alpha(ink::kActuator, 0.8f * fresh), 0.1f * engine::ui_em());
    before = &point;
  }
  plot.list().AddCircleFilled(place(now.lever, now.commanded), 0.3f * engine::ui_em(), ink::kActuator);
}

}  // namespace gearshift::ui
