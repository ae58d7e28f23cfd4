// Another simulator's car as a load on the lever: synchroniser, grinding dogs, torque lock and the speed lockouts follow
// its telemetry. Without telemetry, and in gates that are no H gates, there is no force.
//
// Telemetry says neither how fast the gearbox's input shaft turns nor which ratios the car has. The shaft turns with the
// engine while the clutch is closed, with the wheels while a gear is in, and otherwise runs down. Ratios are those of a
// car file until the other car has driven in a gear with the clutch closed: then they are measured.
#pragma once

#include <array>

#include "app/shifter/telemetry.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/synchroniser.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_load.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::shifter {

class TelemetryLoad final : public haptics::LeverLoad {
 public:
  // `force_limit`: largest force of the device [N], > 0. `telemetry` must outlive this object and have no other reader.
  // Its values are no part of a recording, so a recording with this load cannot be replayed.
  TelemetryLoad(const vehicle::CarSpec& car, const haptics::Gate& gate, double force_limit,
                haptics::LatestValue<Telemetry>& telemetry);

  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override;
  const char* replay_parameters() const noexcept override { return "telemetry"; }

  double shaft_speed() const noexcept { return shaft_speed_; }                    // [rad/s]
  double per_road(int slot) const noexcept { return per_road_[index_of(slot)]; }  // [rad/m]

 private:
  static std::size_t index_of(int slot) noexcept { return static_cast<std::size_t>(slot); }
  void follow_shaft(const Telemetry& now, double period) noexcept;
  void measure_ratio(const Telemetry& now, double period) noexcept;
  vehicle::SleeveInput sleeve_input(const haptics::LeverInput& in, const Telemetry& now) const noexcept;
  double ratio(int slot) const noexcept;

  vehicle::CarSpec car_;
  haptics::Gate gate_;
  haptics::LatestValue<Telemetry>& telemetry_;
  double force_scale_;  // [1]
  vehicle::Synchroniser synchroniser_;
  std::array<double, haptics::kMaxSlots> per_road_{};  // [rad/m] shaft speed divided by road speed
  vehicle::SleeveOutput sleeve_;                       // of the previous step
  int meshed_slot_ = haptics::kNoSlot;
  int cone_slot_ = haptics::kNoSlot;
  double shaft_speed_ = 0.0;  // [rad/s]
  bool was_live_ = false;
};

}  // namespace gearshift::shifter
