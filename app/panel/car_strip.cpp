#include "app/panel/car_strip.h"

#include <algorithm>
#include <cmath>

#include "app/panel/lesson_words.h"
#include "app/panel/palette.h"
#include "app/panel/text_lines.h"
#include "app/panel/value_text.h"
#include "haptics/gate/gate.h"

namespace gearshift {
namespace {

constexpr float kBar = 3.2f;        // [em]
constexpr double kBitesFrom = 5.0;  // [N m]

struct Zone {  // [1] of the pedal, where it takes hold; empty: none
  double from = 0.0, to = 0.0;
};

void pedal(const char* name, double pressed, ImU32 colour, bool first = false, Zone zone = {}) {
  const float em = ui_em(), text = width_of(name, UiFont::small), gap = 0.35f * em;
  const float height = ui_font(UiFont::small)->FontSize;
  if (!first) beside(text + gap + kBar * em);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy({text + gap + kBar * em, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(ui_font(UiFont::small), height, low, ink::kSoft, name);
  const ImVec2 from(low.x + text + gap, low.y + 0.2f * height), to(from.x + kBar * em, low.y + 0.85f * height);
  list.AddRectFilled(from, to, ink::kWell, 2.0f);
  const auto share = static_cast<float>(std::clamp(pressed, 0.0, 1.0));
  if (share > 0.0f) list.AddRectFilled(from, {from.x + share * (to.x - from.x), to.y}, colour, 2.0f);
  const auto at = [&](double part) { return from.x + static_cast<float>(part) * (to.x - from.x); };
  if (zone.to > zone.from) list.AddRectFilled({at(zone.from), from.y}, {at(zone.to), to.y}, ink::kBiteZone);
}

void word(const std::string& text, ImU32 colour) {
  beside(width_of(text, UiFont::small));
  put(text, colour, UiFont::small);
}

}  // namespace

double slope_percent(const VehicleState& car) {
  return as_printed(100.0 * std::tan(car.slope), 0);
}

void draw_car_strip(const VehicleState& car, int gear) {
  const bool bites = !car.clutch_locked && std::abs(car.clutch_torque) > kBitesFrom;
  pedal(bites ? "clutch, bites" : "clutch", car.clutch, bites ? ink::kWarn : ink::kAccent, true,
        {car.clutch_closed, car.clutch_bite});
  pedal("brake", car.brake, ink::kBad);
  pedal("throttle", car.throttle, ink::kGood);
  if (car.stalled) {
    word("stalled", ink::kBad);
  } else {
    word(rpm_words(car.engine_speed), car.over_revved ? ink::kBad : ink::kText);
  }
  word(value_text(kKmhPerMps * car.road_speed, "km/h", 0), ink::kText);
  word(std::string("gear ") + gear_name(gear), car.grinding ? ink::kBad : ink::kText);
  if (car.hand_brake > kHandBrakeOn) word("hand brake", ink::kBad);
  if (!car.ignition) word("ignition off", ink::kWarn);
  if (const double slope = slope_percent(car); slope != 0.0)
    word(fmt::format("{:.0f} % {}", std::abs(slope), slope > 0.0 ? "uphill" : "downhill"), ink::kText);
}

}  // namespace gearshift
