// The firmware of a stick: accepts reports, answers requests, and computes the forces of its effects. Independent of
// USB and of the lever.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>

#include "tests/support/stick/device_effects.h"
#include "tests/support/stick/stick_family.h"

namespace gearshift::test {

class StickFirmware {
 public:
  enum class BlockStatus : std::uint8_t { success = 1, full = 2, error = 3 };

  // `blocks`: number of blocks in the pool; 0: as usual for the family.
  StickFirmware(const StickFamilyTable& family, const StickHabits& habits, int blocks, bool finite_refused);

  void power_off() noexcept;

  // Reports start with their ID. The functions below return false or an empty value if a report is unknown or has the
  // wrong length.
  bool accepts_output(std::span<const std::uint8_t> report) const noexcept;
  void output(std::span<const std::uint8_t> report, std::int64_t now_ns);
  bool set_feature(std::span<const std::uint8_t> report);

  StickReport state() const;                // the state as an input report; empty: the family has none
  std::optional<StickReport> take_state();  // the next queued state report; empty: none

  void set_clock(std::int64_t now_ns) noexcept;            // sets the time, but no time passes for the effects
  void advance(std::int64_t now_ns);                       // ends effects whose time is over
  void set_supply(bool has_power, bool is_switch_closed);  // both are needed for forces
  EffectForces forces(const DeviceMotion& motion, std::int64_t now_ns) const noexcept;

  bool actuators() const noexcept { return actuators_; }
  // Reading the block load report, and on some sticks the pool report, has effects on the firmware.
  std::optional<StickReport> take_feature(std::uint8_t id);
  int playing() const noexcept { return effects_.playing(); }

  std::optional<BlockStatus> refusal;  // if set, the answer to every create request

 private:
  void create_centring_spring() noexcept;
  std::optional<StickReport> feature(std::uint8_t id) const;
  StickReport block_load_report() const;
  StickReport pool_report() const;
  DeviceEffect* effect_at(int index) noexcept;
  void fetch_parameters(DeviceEffect& effect) const;
  void set_effect(std::span<const std::uint8_t> report);
  void set_constant(std::span<const std::uint8_t> report);
  void set_condition(std::span<const std::uint8_t> report);
  AxisCondition read_condition(std::span<const std::uint8_t> report) const noexcept;
  void operate(std::span<const std::uint8_t> report, std::int64_t now_ns);
  void control(std::uint8_t value);
  void control_by_number(int number);
  void control_by_switch(int number);
  void stop_all_effects() noexcept;
  glm::dvec2 centring_force(const DeviceMotion& motion) const noexcept;
  void reset() noexcept;
  void create(int type) noexcept;
  void queue_state(int block, bool at_setting = false);
  EffectKind kind_of(int type) const noexcept;

  // A parameter block in the memory of a stick whose driver manages the pool, by its place.
  struct Parameters {
    double magnitude = 0.0;
    AxisCondition condition;
  };

  const StickFamilyTable& family_;
  const StickHabits& habits_;
  std::map<int, Parameters> memory_;
  int blocks_;
  bool finite_refused_;
  DeviceEffects effects_;
  bool actuators_ = false, paused_ = false;
  bool has_power_ = true, is_switch_closed_ = true;
  bool centres_ = false;  // the auto-centre spring is on
  bool mute_ = false;     // StickHabits::mute_until_stop_all
  bool was_created_ = false;
  int loads_read_ = 0;  // reads of the block load report since the last create
  double gain_ = 1.0;
  std::int64_t now_ns_ = 0;
  int load_block_ = 0;
  BlockStatus load_status_ = BlockStatus::error;
  int state_block_ = 0;
  std::deque<StickReport> states_;
};

}  // namespace gearshift::test
