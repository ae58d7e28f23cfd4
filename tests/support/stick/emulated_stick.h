// A force-feedback stick as seen from its USB port, with a simulated lever and a hand behind it. The stick was written
// from the devices' documents, byte by byte, and does not use our HID parser, so that stick and parser check each
// other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "haptics/device/hand.h"
#include "haptics/device/simulated_lever.h"
#include "tests/support/stick/stick_habits.h"

namespace gearshift::test {

enum class StickFamily : std::uint8_t {
  sidewinder,
  openffboard,
  vjoy,
  openffboard_32bit,
  arduino,
  arduino_hat,
  adapt_ffb_joy,
  sunffb,
  affbwheel,
  brwheel,
  stm32,
  saitek
};
const char* to_string(StickFamily family) noexcept;  // "sidewinder", ...

struct EmulatedStickConfig {
  StickFamily family = StickFamily::sidewinder;
  StickHabits habits;
  // The lever and the hand. The stick uses its own encoder, stops and motors instead of the configured ones, and no
  // delay.
  haptics::SimulatedLeverConfig lever;
  double half_travel = 0.070;       // [m] full deflection: knob travel from rest to a stop
  double full_force = 20.0;         // [N] knob force of an effect with full magnitude; limits the sum of all effects
  double spring_stiffness = 400.0;  // [N/m] spring stiffness at the knob with the maximum coefficient
  double plant_period = 0.001;      // [s] time step of the simulated lever and the effects
  double input_interval = 0.001;    // [s] between two lever reports
  double delay = 0.0;               // [s] from the arrival of an output report to its force
  // Signs of the forces on each axis (select, shift): +1 as in PID 1.0, -1 inverted. In PID 1.0, a direction states
  // where a force comes from, so a positive constant force at 90 degrees pushes left, and at 180 degrees away from the
  // user. Springs pull to their centre, and dampers brake.
  glm::ivec2 constant_sign{1, 1};
  glm::ivec2 spring_sign{1, 1};
  glm::ivec2 damper_sign{1, 1};
  bool reports_only_changes = false;  // sends no report while nothing changes; GET_REPORT still answers
  // Refuses to set a finite duration: the effect stays unchanged, and the block load report contains an error for its
  // block.
  bool finite_refused = false;
  int blocks = 0;  // number of blocks in the pool; 0: as usual for the family
  // The motors have their own power supply: after an unplug they run until their effects end.
  bool own_power = false;
};

// Faults of the stick. Each fault is active while its value is set.
struct EmulatedFaults {
  bool jump = false;          // every 50th report is off by 60 % of the full deflection
  bool wrong_length = false;  // lever reports lack their last byte
  bool stuck = false;         // sends one lever report again and again
  // [1] Effects act so many times as strongly as they should, per axis (select, shift): -1 reversed, 0 silent.
  glm::dvec2 constants{1.0}, conditions{1.0};
  bool no_power = false;         // the motors have no power supply, as the state report says
  bool open_switch = false;      // the safety switch is open, as the state report says
  bool silent = false;           // sends no lever reports, not even with GET_REPORT
  bool refuses_effects = false;  // creating an effect fails with the block load status "error"
  bool pool_full = false;        // creating an effect fails with the block load status "full"
  bool stalls_outputs = false;   // output reports are no longer accepted
  double slow = 0.0;             // [s] extra duration of each control transfer, during which the caller waits
};

struct UsbSetup {
  std::uint8_t request_type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};

// A message on the USB wire, for the log.
struct StickMessage {
  enum class Kind : std::uint8_t { set_feature, get_feature, output };
  Kind kind = Kind::output;
  std::int64_t time_ns = 0;
  std::vector<std::uint8_t> bytes;
};
std::string message_line(const StickMessage& message);  // for example "out 05 01 10 27"

class EmulatedStick {
 public:
  // The hand must outlive the stick.
  EmulatedStick(const EmulatedStickConfig& config, haptics::HandDriver& hand);
  ~EmulatedStick();

  // USB interface.
  std::vector<std::uint8_t> device_descriptor() const;
  std::vector<std::uint8_t> configuration_descriptor() const;  // including the interface, HID and endpoint descriptors
  const std::vector<std::uint8_t>& report_descriptor() const;
  std::vector<std::uint8_t> string_descriptor(int index) const;
  std::optional<std::vector<std::uint8_t>> control(const UsbSetup& setup,
                                                   std::span<const std::uint8_t> data);  // empty: stall
  // Interrupt OUT transfer. Returns false if the transfer stalls. It stalls if the report is unknown or has the wrong
  // length, or if the device has no OUT endpoint (vJoy, which receives its outputs by SET_REPORT).
  bool output(std::span<const std::uint8_t> report);
  std::optional<std::vector<std::uint8_t>> input();  // interrupt IN transfer; returns each due report once; empty: NAK

  // Advances the simulated lever and the effects to now_ns, in whole periods. `now_ns`: time [ns] on any clock of the
  // caller. The first call only sets the start time.
  void advance(std::int64_t now_ns);
  // Turns the bus power off: effects and motors stop. Motors with their own power supply run until their effects end,
  // but at most until the next bus reset.
  void unplug();

  // True state.
  glm::dvec2 force() const;     // [N] force of the motors on the knob
  glm::dvec2 position() const;  // [m]
  glm::dvec2 velocity() const;  // [m/s]
  std::int64_t time_ns() const;
  void place(glm::dvec2 position);
  bool actuators_on() const;
  int playing() const;              // number of effects
  std::int64_t fetched_ns() const;  // when the last report of the lever was fetched, by input() or GET_REPORT

  std::uint64_t held_buttons = 0;  // bit mask, added to the hand's buttons (bit 0: pushed down, bit 1: lifted)
  EmulatedFaults faults;
  std::vector<StickMessage> log;  // all messages except GET_REPORT requests for input reports
  bool logs = true;

 private:
  using Answer = std::optional<std::vector<std::uint8_t>>;

  Answer standard_request(const UsbSetup& setup);
  Answer class_request(const UsbSetup& setup, std::span<const std::uint8_t> data);
  Answer descriptor(int type, int index) const;
  Answer get_report(int kind, std::uint8_t id);
  bool set_feature(std::span<const std::uint8_t> report);
  bool accept_output(std::span<const std::uint8_t> report);
  void log_message(StickMessage::Kind kind, std::span<const std::uint8_t> bytes);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::test
