// A force-feedback stick as it looks from its USB plug, with a simulated lever and a hand behind it.
//
// Written from the devices' own documents, byte by byte, and not from our parser: so the one is a check of the other.
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

namespace gearshift {

enum class StickFamily : std::uint8_t { sidewinder, openffboard, vjoy };
const char* stick_family_name(StickFamily family) noexcept;  // "sidewinder", ...

struct EmulatedStickConfig {
  StickFamily family = StickFamily::sidewinder;
  SimulatedLeverConfig lever;  // the mechanism; its encoder, its stops and its motors are the stick's, its delay is 0
  double half_travel = 0.070;  // [m] of the knob from rest to a stop: full deflection
  double full_force = 20.0;    // [N] at the knob at full magnitude; all effects together push no more
  double spring_stiffness = 400.0;  // [N/m] at the knob at the greatest coefficient
  double plant_period = 0.001;      // [s] of the plant and the effects
  double input_interval = 0.001;    // [s] between reports
  double delay = 0.0;               // [s] from an output's arrival to its force
  // 1: as PID 1.0 says, where a direction is whence a force comes: a positive constant force at 90 degrees pushes left,
  // at 180 degrees away from the user; springs pull to their centre, dampers brake. -1: that family of effects works the other way on
  // that axis (select, shift).
  glm::ivec2 constant_sign{1, 1};
  glm::ivec2 spring_sign{1, 1};
  glm::ivec2 damper_sign{1, 1};
  bool reports_changes_alone = false;  // no report while nothing changes; GET_REPORT answers
  // A finite duration is not taken: the effect stays as it was, and block load says error for its block.
  bool finite_refused = false;
  int blocks = 0;  // of its pool; 0: as the family has it
  // Its motors are fed from the wall: unplugged, they go on until their effects end.
  bool own_power = false;
};

// What it does wrong from now on.
struct StickFaults {
  bool jump = false;             // every 50th report says another place, 60 % of the full deflection away
  bool wrong_length = false;     // reports lack their last byte
  bool stuck = false;            // the same report for ever
  bool silent = false;           // no report at all, GET_REPORT neither
  bool refuses_effects = false;  // block load: error
  bool pool_full = false;        // block load: full
  bool stalls_outputs = false;   // outputs are taken no more
  double slow = 0.0;             // [s] each control transfer takes so much longer: whoever carries it waits
};

struct UsbSetup {
  std::uint8_t request_type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};

// What came over the wire, for byte logs.
struct StickMessage {
  enum class Kind : std::uint8_t { set_feature, get_feature, output };
  Kind kind = Kind::output;
  std::int64_t time_ns = 0;
  std::vector<std::uint8_t> bytes;
};
std::string message_line(const StickMessage& message);  // "out 05 01 10 27"

class EmulatedStick {
 public:
  // The driver (hand) must outlive it.
  EmulatedStick(const EmulatedStickConfig& config, HandDriver& hand);
  ~EmulatedStick();

  // Its plug.
  std::vector<std::uint8_t> device_descriptor() const;
  std::vector<std::uint8_t> configuration_descriptor() const;  // with interface, HID and endpoint descriptors
  const std::vector<std::uint8_t>& report_descriptor() const;
  std::vector<std::uint8_t> string_descriptor(int index) const;
  std::optional<std::vector<std::uint8_t>> control(const UsbSetup& setup,
                                                   std::span<const std::uint8_t> data);  // nothing: stall
  // Interrupt OUT, as on the wire. false: stall. A report that it does not know, or of another length, stalls; so does
  // everything where there is no such endpoint (vJoy: its outputs come by SET_REPORT).
  bool output(std::span<const std::uint8_t> report);
  std::optional<std::vector<std::uint8_t>> input();  // interrupt IN: the report that is due, once; nothing: NAK

  // Plant and effects up to then, in whole periods. Time of the caller's clock [ns], the first call sets its origin.
  void advance(std::int64_t now_ns);
  // Power gone: effects and motors are off. With power of its own that is so when it is spoken to again, a bus reset.
  void unplug();

  // The truth.
  glm::dvec2 force() const;     // [N] of the motors on the knob, now
  glm::dvec2 position() const;  // [m]
  glm::dvec2 velocity() const;  // [m/s]
  std::int64_t time_ns() const;
  void place(glm::dvec2 position);
  bool actuators_on() const;
  int playing() const;           // effects
  std::int64_t told_ns() const;  // when the last report of the lever was fetched, by input() or GET_REPORT

  std::uint64_t held_buttons = 0;  // besides the hand's: pushed down is button 1 (bit 0), lifted is button 2
  StickFaults faults;
  std::vector<StickMessage> log;  // what was told; GET_REPORT of inputs is left out
  bool logs = true;

 private:
  using Answer = std::optional<std::vector<std::uint8_t>>;

  Answer standard_request(const UsbSetup& setup);
  Answer class_request(const UsbSetup& setup, std::span<const std::uint8_t> data);
  Answer descriptor(int type, int index) const;
  Answer get_report(int kind, std::uint8_t id);
  bool set_feature(std::span<const std::uint8_t> report);
  bool take(std::span<const std::uint8_t> report);
  void note(StickMessage::Kind kind, std::span<const std::uint8_t> bytes);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
