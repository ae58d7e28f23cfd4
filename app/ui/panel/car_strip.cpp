#include "app/ui/panel/car_strip.h"

#include <algorithm>
#include <cmath>

#include "app/ui/panel/format_value.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/gate.h"

namespace gearshift::ui {
namespace {

constexpr float kBar = 3.2f;         // [em]
constexpr double kBiteTorque = 5.0;  // [N m] clutch torque above which a slipping clutch counts as biting

struct Zone {  // bite zone in fractions of the pedal travel [1]; not drawn if empty (`from` >= `to`)
  double from = 0.0, to = 0.0;
  double mark = 0.0;  // [1] 0 to 1, strength of its outline
};

void pedal(const char* name, double pressed, ImU32 colour, bool first = false, Zone zone = {}) {
  const float em = engine::ui_em(), text = width_of(name, engine::UiFont::small), gap = 0.35f * em;
  const float height = engine::ui_font_size(engine::UiFont::small);
  if (!first) same_line_if_fits(text + gap + kBar * em);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy({text + gap + kBar * em, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(engine::ui_font(engine::UiFont::small), height, low, ink::kSoft, name);
  const ImVec2 from(low.x + text + gap, low.y + 0.2f * height), to(from.x + kBar * em, low.y + 0.85f * height);
  list.AddRectFilled(from, to, ink::kWell, 2.0f);
  const auto fraction = static_cast<float>(std::clamp(pressed, 0.0, 1.0));
  if (fraction > 0.0f) list.AddRectFilled(from, {from.x + fraction * (to.x - from.x), to.y}, colour, 2.0f);
  const auto at = [&](double part) { return from.x + static_cast<float>(part) * (to.x - from.x); };
  if (zone.to <= zone.from) return;
  list.AddRectFilled({at(zone.from), from.y}, {at(zone.to), to.y}, ink::kBiteZone);
  if (zone.mark > 0.0)
    list.AddRect({at(zone.from), from.y - 2.0f}, {at(zone.to), to.y + 2.0f},
                 engine::with_alpha(ink::kBiteMark, static_cast<float>(zone.mark)), 0.0f, 0, 2.0f);
}

void draw_word(const std::string& text, ImU32 colour) {
  same_line_if_fits(width_of(text, engine::UiFont::small));
  put(text, colour, engine::UiFont::small);
}

}  // namespace

std::string format_speed(const vehicle::VehicleState& car) {
  return format_value(vehicle::in_unit(car.speed_unit, car.road_speed), to_string(car.speed_unit), 0);
}

double slope_percent(const vehicle::VehicleState& car) {
  return round_as_printed(100.0 * std::tan(car.slope), 0);
}

void draw_car_strip(const vehicle::VehicleState& car, int gear, double pedal_help) {
  const bool bites = !car.clutch_locked && std::abs(car.clutch_torque) > kBiteTorque;
  pedal(bites ? "clutch biting" : "clutch", car.pedals.clutch, bites ? ink::kWarn : ink::kAccent, true,
        {car.clutch_closed, car.clutch_bite, pedal_help});
  pedal("brake", car.pedals.brake, ink::kBad);
  pedal("throttle", car.pedals.throttle, ink::kGood);
  if (car.stalled) {
    draw_word("stalled", ink::kBad);
  } else {
    draw_word(format_rpm(std::abs(car.engine_speed)), car.over_revved ? ink::kBad : ink::kText);
  }
  draw_word(format_speed(car), ink::kText);
  draw_word(std::string("gear ") + haptics::gear_name(gear), car.grinding ? ink::kBad : ink::kText);
  if (car.pedals.hand_brake > kHandBrakeOn) draw_word("handbrake", ink::kBad);
  if (car.clutch_smells) draw_word(car.clutch_fades ? "clutch slips: too hot" : "clutch smells: too hot", ink::kBad);
  if (!car.ignition) draw_word("ignition off", ink::kWarn);
  if (const double slope = slope_percent(car); slope != 0.0)
    draw_word(fmt::format("{:.0f} % {}", std::abs(slope), slope > 0.0 ? "uphill" : "downhill"), ink::kText);
}

}  // namespace gearshift::ui
