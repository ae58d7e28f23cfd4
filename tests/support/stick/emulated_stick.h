// A force-feedback stick as seen from its USB port, with a simulated lever and a hand behind it. It was written from
// the devices' documents, byte by byte, and does not use our parser, so that each checks the other.
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

namespace gearshift::test {

enum class StickFamily : std::uint8_t { sidewinder, openffboard, vjoy };
const char* stick_family_name(StickFamily family) noexcept;  // "sidewinder", ...

struct EmulatedStickConfig {
  StickFamily family = StickFamily::sidewinder;
  haptics::SimulatedLeverConfig
      lever;                   // the mechanism; encoder, stops and motors are replaced by the stick's, its delay by 0
  double half_travel = 0.070;  // [m] knob travel from rest to a stop: full deflection
  double full_force = 20.0;    // [N] at the knob, at full magnitude; limits the sum of all effects
  double spring_stiffness = 400.0;  // [N/m] at the knob, at the maximum coefficient
  double plant_period = 0.001;      // [s] of the plant and the effects
  double input_interval = 0.001;    // [s] between reports
  double delay = 0.0;               // [s] from an output's arrival to its force
  // +1: as in PID 1.0, where a direction is where the force comes from: a positive constant force at 90 degrees pushes
  // left, at 180 degrees away from the user; springs pull to their centre, dampers brake. -1: inverted on that axis
  // (select, shift).
  glm::ivec2 constant_sign{1, 1};
  glm::ivec2 spring_sign{1, 1};
  glm::ivec2 damper_sign{1, 1};
  bool reports_only_changes = false;  // no report while nothing changes; GET_REPORT still answers
  // A finite duration is refused: the effect stays unchanged, and block load reports an error for its block.
  bool finite_refused = false;
  int blocks = 0;  // size of the pool; 0: as usual for the family
  // The motors have their own power supply: after an unplug they run until their effects end.
  bool own_power = false;
};

// Faults, in effect from now on.
struct EmulatedFaults {
  bool jump = false;             // every 50th report is off by 60 % of the full deflection
  bool wrong_length = false;     // reports lack their last byte
  bool stuck = false;            // repeats the same report forever
  bool silent = false;           // no reports, not even with GET_REPORT
  bool refuses_effects = false;  // block load: error
  bool pool_full = false;        // block load: full
  bool stalls_outputs = false;   // outputs are no longer accepted
  double slow = 0.0;             // [s] extra duration of each control transfer, in which its caller waits
};

struct UsbSetup {
  std::uint8_t request_type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};

// A message on the wire, for logs.
struct StickMessage {
  enum class Kind : std::uint8_t { set_feature, get_feature, output };
  Kind kind = Kind::output;
  std::int64_t time_ns = 0;
  std::vector<std::uint8_t> bytes;
};
std::string message_line(const StickMessage& message);  // "out 05 01 10 27"

class EmulatedStick {
 public:
  // The hand must outlive it.
  EmulatedStick(const EmulatedStickConfig& config, haptics::HandDriver& hand);
  ~EmulatedStick();

  // USB interface.
  std::vector<std::uint8_t> device_descriptor() const;
  std::vector<std::uint8_t> configuration_descriptor() const;  // with interface, HID and endpoint descriptors
  const std::vector<std::uint8_t>& report_descriptor() const;
  std::vector<std::uint8_t> string_descriptor(int index) const;
  std::optional<std::vector<std::uint8_t>> control(const UsbSetup& setup,
                                                   std::span<const std::uint8_t> data);  // empty: stall
  // Interrupt OUT, as on the wire. False: stall. A report that is unknown or has the wrong length stalls, and so does
  // everything on a device without that endpoint (vJoy gets its outputs by SET_REPORT).
  bool output(std::span<const std::uint8_t> report);
  std::optional<std::vector<std::uint8_t>> input();  // interrupt IN: the due report, once; empty: NAK

  // Advances plant and effects to that time, in whole periods. The caller's clock [ns]; the first call sets its origin.
  void advance(std::int64_t now_ns);
  // Bus power off: effects and motors stop. With its own power supply that happens at the next bus reset.
  void unplug();

  // True state.
  glm::dvec2 force() const;     // [N] of the motors on the knob
  glm::dvec2 position() const;  // [m]
  glm::dvec2 velocity() const;  // [m/s]
  std::int64_t time_ns() const;
  void place(glm::dvec2 position);
  bool actuators_on() const;
  int playing() const;              // number of effects
  std::int64_t fetched_ns() const;  // when the last report of the lever was fetched, by input() or GET_REPORT

  std::uint64_t held_buttons = 0;  // in addition to the hand's: pushed down is button 1 (bit 0), lifted is button 2
  EmulatedFaults faults;
  std::vector<StickMessage> log;  // all messages except GET_REPORT of inputs
  bool logs = true;

 private:
  using Answer = std::optional<std::vector<std::uint8_t>>;

  Answer standard_request(const UsbSetup& setup);
  Answer class_request(const UsbSetup& setup, std::span<const std::uint8_t> data);
  Answer descriptor(int type, int index) const;
  Answer get_report(int kind, std::uint8_t id);
  bool set_feature(std::span<const std::uint8_t> report);
  bool take(std::span<const std::uint8_t> report);
  void log_message(StickMessage::Kind kind, std::span<const std::uint8_t> bytes);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::test
