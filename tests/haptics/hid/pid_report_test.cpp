// Tests the encoding of PID reports, byte by byte. The expected bytes were derived by hand from each device's
// descriptor and documentation; the comments give the arithmetic. Documentation: adapt-ffb-joy's ffb.h and wiki for the
// SideWinder; ffb_defs.h and HidFFB.cpp for the OpenFFBoard. A direction says where a force comes from: 0 is the far
// side, and angles increase clockwise. A force on X is therefore encoded as a quarter turn, a force on Y as half a turn.
#include "haptics/hid/pid_report.h"

#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "tests/haptics/hid/descriptors.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

PidLayout needed_pid_in(const std::vector<std::uint8_t>& descriptor) {
  const auto pid = find_pid(parse_report_descriptor(descriptor));
  REQUIRE(pid);
  return *pid;
}

PidLayout pid_of(const char* device) {
  return needed_pid_in(device_descriptor(device));
}

std::string hex_of(const HidBytes& report) {
  return hex(report.view());
}

PidEffectSettings settings(int block, PidEffect effect, int axis, double duration = 0.3) {
  PidEffectSettings result;
  result.block = block;
  result.effect = effect;
  result.axis = axis;
  result.duration = duration;
  return result;
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr PidCondition kSpring{-0.25, 0.2, 0.5, 0.8};  // centre, half width of the dead band, coefficient, saturation

std::string control(const PidLayout& pid, PidControl wanted) {
  return hex_of(encode_control(pid, wanted));
}

}  // namespace

TEST_CASE("SideWinder FF2: Set Effect, 16 bytes") {
  const PidLayout pid = pid_of("microsoft-sidewinder-ff2");
  // Bytes: ID, block, type 1 of 12, 300 ms = 012Ch, trigger repeat, sample period, gain 255, no button, axis X (1) +
  // direction enabled (4), direction 255/4 = 63.75 -> 64 = 40h, second direction, delay.
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 0))) ==
        "01 01 01 2C 01 00 00 00 00 FF FF 04 40 40 00 00");
  // Axis Y (2) + direction enabled (4) = 6; direction 255/2 = 127.5 -> 128 = 80h.
  CHECK(hex_of(encode_set_effect(pid, settings(2, PidEffect::constant, 1))) ==
        "01 02 01 2C 01 00 00 00 00 FF FF 04 80 80 00 00");
  // The type of a spring is 8, of a damper 9. Both axes are enabled (1 + 2), without a direction.
  CHECK(hex_of(encode_set_effect(pid, settings(3, PidEffect::spring, -1))) ==
        "01 03 08 2C 01 00 00 00 00 FF FF 04 40 40 00 00");
  CHECK(hex_of(encode_set_effect(pid, settings(40, PidEffect::damper, -1))) ==
        "01 28 09 2C 01 00 00 00 00 FF FF 04 40 40 00 00");
  // kForever is encoded as all ones (USB_DURATION_INFINITE). Finite durations are limited to 1 to 32767 ms.
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 0, kForever))).substr(9, 5) == "FF FF");
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 0, 1000.0))).substr(9, 5) == "FF 7F");
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 0, 0.0))).substr(9, 5) == "01 00");
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 0, kNaN))).substr(9, 5) == "01 00");
  PidEffectSettings faint = settings(1, PidEffect::constant, 0);
  faint.gain = 0.2;  // 51 = 33h
  CHECK(encode_set_effect(pid, faint).bytes[9] == 0x33);
  faint.gain = -1.0;
  CHECK(encode_set_effect(pid, faint).bytes[9] == 0);
}

TEST_CASE("SideWinder FF2: constant force -255 to 255, conditions of a byte each") {
  const PidLayout pid = pid_of("microsoft-sidewinder-ff2");
  CHECK(hex_of(encode_constant(pid, 1, 1.0)) == "05 01 FF 00");
  CHECK(hex_of(encode_constant(pid, 1, -1.0)) == "05 01 01 FF");  // -255 = FF01h
  CHECK(hex_of(encode_constant(pid, 2, 0.2)) == "05 02 33 00");   // 51
  CHECK(hex_of(encode_constant(pid, 2, -0.4)) == "05 02 9A FF");  // -102 = FF9Ah
  CHECK(hex_of(encode_constant(pid, 2, 0.0)) == "05 02 00 00");
  CHECK(hex_of(encode_constant(pid, 2, 7.0)) == "05 02 FF 00");
  CHECK(hex_of(encode_constant(pid, 2, kNaN)) == "05 02 00 00");
  // Centre: -0.25 x 128 = -32 = E0h. Coefficient: 0.5 x 127 = 63.5 -> 64 = 40h. Saturation: 0.8 x 255 = 204 = CCh. Dead
  // band: 0.2 x 255 = 51 = 33h.
  CHECK(hex_of(encode_condition(pid, 3, 0, kSpring)) == "03 03 00 E0 40 40 CC CC 33");
  CHECK(hex_of(encode_condition(pid, 3, 1, kSpring)) == "03 03 01 E0 40 40 CC CC 33");
}

TEST_CASE("SideWinder FF2: operation, control, gain, free, create") {
  const PidLayout pid = pid_of("microsoft-sidewinder-ff2");
  CHECK(hex_of(encode_operation(pid, 1, PidOperation::start, 1)) == "0A 01 01 01");
  CHECK(hex_of(encode_operation(pid, 1, PidOperation::start_solo, 255)) == "0A 01 02 FF");
  CHECK(hex_of(encode_operation(pid, 2, PidOperation::stop, 0)) == "0A 02 03 00");
  CHECK(control(pid, PidControl::enable_actuators) == "0C 01");
  CHECK(control(pid, PidControl::disable_actuators) == "0C 02");
  CHECK(control(pid, PidControl::stop_all) == "0C 03");
  CHECK(control(pid, PidControl::reset) == "0C 04");
  CHECK(control(pid, PidControl::pause) == "0C 05");
  CHECK(control(pid, PidControl::resume) == "0C 06");
  CHECK(hex_of(encode_gain(pid, 1.0)) == "0D FF");
  CHECK(hex_of(encode_gain(pid, 0.2)) == "0D 33");
  CHECK(hex_of(encode_block_free(pid, 3)) == "0B 03");
  CHECK(hex_of(encode_create(pid, PidEffect::constant)) == "01 01 00 00");
  CHECK(hex_of(encode_create(pid, PidEffect::spring)) == "01 08 00 00");
}

TEST_CASE("SideWinder FF2: block load, pool and state") {
  const PidLayout pid = pid_of("microsoft-sidewinder-ff2");
  using enum BlockLoad::Status;
  const auto load = [&](const char* report) { return *decode_block_load(pid, hex_bytes(report)); };
  CHECK(load("02 03 01 D0 07").block == 3);
  CHECK(load("02 03 01 D0 07").status == success);
  CHECK(load("02 00 02 00 00").status == full);
  CHECK(load("02 00 03 00 00").status == error);
  CHECK(load("02 00 00 00 00").status == pending);
  CHECK(load("02 03 01 D0").status == success);  // adapt-ffb-joy answers one byte less
  CHECK_FALSE(decode_block_load(pid, hex_bytes("02 ")));
  CHECK_FALSE(decode_block_load(pid, hex_bytes("03 03 01 D0 07")));
  CHECK_FALSE(decode_block_load(pid, {}));
  // 1Eh = actuators 2 + safety switch 4 + override switch 8 + power 16. 07h = playing 1 + 2 x block 3.
  const auto state = decode_state(pid, hex_bytes("02 1E 07"));
  REQUIRE(state);
  CHECK(state->actuators_enabled);
  CHECK(state->safety_switch);
  CHECK(state->actuator_power);
  CHECK_FALSE(state->paused);
  CHECK(state->playing);
  CHECK(state->block == 3);
  CHECK(decode_state(pid, hex_bytes("02 01 00"))->paused);
  CHECK_FALSE(decode_state(pid, hex_bytes("02 01 00"))->actuator_power);
  CHECK_FALSE(decode_state(pid, hex_bytes("01 1E 07")));
}

TEST_CASE("OpenFFBoard: Set Effect, 22 bytes") {
  const PidLayout pid = pid_of("openffboard-2axis");
  // Bytes: ID, block, type, 300 ms, trigger repeat, sample period, delay, gain, button, axes, direction 36000/4 = 9000
  // = 2328h, second direction, two offsets. From this direction, HidFFB.cpp computes the force sin(90 degrees) = 1 on X
  // and -cos(90 degrees) = 0 on Y.
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 0))) ==
        "01 01 01 2C 01 00 00 00 00 00 00 FF FF 04 28 23 28 23 00 00 00 00");
  // Direction 18000 = 4650h: the force is sin(180 degrees) = 0 on X and -cos(180 degrees) = 1 on Y.
  CHECK(hex_of(encode_set_effect(pid, settings(2, PidEffect::constant, 1))) ==
        "01 02 01 2C 01 00 00 00 00 00 00 FF FF 04 50 46 50 46 00 00 00 00");
  CHECK(hex_of(encode_set_effect(pid, settings(3, PidEffect::spring, -1))) ==
        "01 03 08 2C 01 00 00 00 00 00 00 FF FF 04 28 23 28 23 00 00 00 00");
  // FFB_EFFECT_DURATION_INFINITE is FFFFh.
  CHECK(hex_of(encode_set_effect(pid, settings(4, PidEffect::damper, -1, kForever))) ==
        "01 04 09 FF FF 00 00 00 00 00 00 FF FF 04 28 23 28 23 00 00 00 00");
}

TEST_CASE("OpenFFBoard: 16-bit magnitudes and conditions, a bit for each control") {
  const PidLayout pid = pid_of("openffboard-2axis");
  CHECK(hex_of(encode_constant(pid, 1, 1.0)) == "05 01 FF 7F");
  CHECK(hex_of(encode_constant(pid, 1, -1.0)) == "05 01 01 80");  // -32767 = 8001h
  CHECK(hex_of(encode_constant(pid, 1, 0.2)) == "05 01 99 19");   // 0.2 x 32767 = 6553.4 -> 1999h
  // Centre: -0.25 x 32768 = -8192 = E000h. Coefficient: 0.5 x 32767 = 16383.5 -> 4000h. Saturation: 0.8 x 32767 =
  // 26213.6 -> 6666h. Dead band: 0.2 x 32767 -> 1999h.
  CHECK(hex_of(encode_condition(pid, 2, 1, kSpring)) == "03 02 01 00 E0 00 40 00 40 66 66 66 66 99 19");
  CHECK(hex_of(encode_condition(pid, 2, 0, {0.0, 0.0, -1.0, 1.0})) == "03 02 00 00 00 00 80 00 80 FF 7F FF 7F 00 00");
  CHECK(hex_of(encode_operation(pid, 40, PidOperation::start, 1)) == "0A 28 01 01");
  // Bits in HidFFB.cpp: 1 enable, 2 disable, 4 stop all, 8 reset, 16 pause, 32 continue.
  CHECK(control(pid, PidControl::enable_actuators) == "0C 01");
  CHECK(control(pid, PidControl::disable_actuators) == "0C 02");
  CHECK(control(pid, PidControl::stop_all) == "0C 04");
  CHECK(control(pid, PidControl::reset) == "0C 08");
  CHECK(control(pid, PidControl::pause) == "0C 10");
  CHECK(control(pid, PidControl::resume) == "0C 20");
  CHECK(hex_of(encode_gain(pid, 1.0)) == "0D FF");
  CHECK(hex_of(encode_block_free(pid, 1)) == "0B 01");
  CHECK(hex_of(encode_create(pid, PidEffect::damper)) == "11 09 00 00");
  const auto load = decode_block_load(pid, hex_bytes("12 02 01 27 00"));
  REQUIRE(load);
  CHECK(load->block == 2);
  CHECK(load->status == BlockLoad::Status::success);
  // 1Ah in ffb_defs.h: actuators 2 + power 8 + playing 16. The safety switch is reported as open.
  const auto state = decode_state(pid, hex_bytes("02 1A"));
  REQUIRE(state);
  CHECK(state->actuators_enabled);
  CHECK(state->actuator_power);
  CHECK(state->playing);
  CHECK_FALSE(state->safety_switch);
  CHECK(state->block == kNoBlock);
}

TEST_CASE("vJoy: IDs from 11h, ranges of 10000, a turn of 32767") {
  const PidLayout pid = pid_of("vjoy-2axis-ffb-tlid1");
  // Directions: 32767/4 = 8191.75 -> 2000h, 32767/2 = 16383.5 -> 4000h.
  CHECK(hex_of(encode_set_effect(pid, settings(100, PidEffect::constant, 0))) ==
        "11 64 01 2C 01 00 00 00 00 00 00 FF FF 04 00 20 00 20 00 00 00 00");
  CHECK(hex_of(encode_set_effect(pid, settings(2, PidEffect::constant, 1))) ==
        "11 02 01 2C 01 00 00 00 00 00 00 FF FF 04 00 40 00 40 00 00 00 00");
  CHECK(hex_of(encode_constant(pid, 1, 1.0)) == "15 01 10 27");
  CHECK(hex_of(encode_constant(pid, 1, -1.0)) == "15 01 F0 D8");
  CHECK(hex_of(encode_constant(pid, 1, 0.0123)) == "15 01 7B 00");
  // Centre -2500 = F63Ch, coefficient 5000 = 1388h, saturation 8000 = 1F40h, dead band 2000 = 07D0h.
  CHECK(hex_of(encode_condition(pid, 3, 1, kSpring)) == "13 03 01 3C F6 88 13 88 13 40 1F 40 1F D0 07");
  CHECK(hex_of(encode_operation(pid, 3, PidOperation::stop, 0)) == "1A 03 03 00");
  CHECK(control(pid, PidControl::stop_all) == "1C 03");
  CHECK(hex_of(encode_gain(pid, 1.0)) == "1D FF");
  CHECK(hex_of(encode_block_free(pid, 100)) == "1B 64");
  CHECK(hex_of(encode_create(pid, PidEffect::friction)) == "11 0B 00 00");
  CHECK(decode_block_load(pid, hex_bytes("12 64 01 00 00"))->block == 100);
  // Bits of the state: playing 1, paused 2, actuators 4, safety switch 8, override switch 16, power 32. 25h has 1, 4
  // and 32.
  const auto state = decode_state(pid, hex_bytes("14 25"));
  REQUIRE(state);
  CHECK(state->playing);
  CHECK(state->actuators_enabled);
  CHECK(state->actuator_power);
  CHECK_FALSE(state->paused);
}

TEST_CASE("Saitek: values without a field are left out") {
  const PidLayout pid = pid_of("saitek-gamepad-ff0d");
  // Bytes: ID, block, button, 300 ms, trigger repeat, delay.
  CHECK(hex_of(encode_set_effect(pid, settings(5, PidEffect::constant, 0))) == "0B 05 FF 2C 01 00 00 00 00");
  CHECK(hex_of(encode_set_effect(pid, settings(5, PidEffect::constant, 1, kForever))) == "0B 05 FF FF FF 00 00 00 00");
  CHECK(hex_of(encode_constant(pid, 5, 1.0)) == "0D 05 7F");
  CHECK(hex_of(encode_constant(pid, 5, -1.0)) == "0D 05 81");  // -127
  CHECK(hex_of(encode_condition(pid, 5, 0, kSpring)).empty());
  // Operations and controls are numbered from 1. Operations: stop, start, start solo. Controls: reset, stop all,
  // enable, disable, pause, continue.
  CHECK(hex_of(encode_operation(pid, 5, PidOperation::start, 300)) == "51 05 02 FE");  // at most 254 (FEh) loops
  CHECK(hex_of(encode_operation(pid, 5, PidOperation::stop, 0)) == "51 05 01 00");
  CHECK(control(pid, PidControl::enable_actuators) == "52 03");
  CHECK(control(pid, PidControl::disable_actuators) == "52 04");
  CHECK(control(pid, PidControl::stop_all) == "52 02");
  CHECK(control(pid, PidControl::reset) == "52 01");
  CHECK(hex_of(encode_gain(pid, 1.0)) == "43 80");  // 0 to 128
  CHECK(hex_of(encode_gain(pid, 0.5)) == "43 40");
  CHECK(hex_of(encode_create(pid, PidEffect::constant)) == "15 01");
  CHECK(hex_of(encode_create(pid, PidEffect::sine)) == "15 04");
  CHECK(hex_of(encode_create(pid, PidEffect::spring)).empty());
  CHECK(hex_of(encode_block_free(pid, 254)) == "50 FE");
  const auto load = decode_block_load(pid, hex_bytes("16 02 05"));  // status comes first
  REQUIRE(load);
  CHECK(load->block == 5);
  CHECK(load->status == BlockLoad::Status::full);
  // After the report ID 02: bits of the first byte are actuators 1 (set) and paused 2 (not set); the second byte is
  // 85h = block 5 (low 7 bits) + playing 80h (top bit).
  const auto state = decode_state(pid, hex_bytes("02 01 85"));
  REQUIRE(state);
  CHECK(state->actuators_enabled);
  CHECK_FALSE(state->paused);
  CHECK(state->playing);
  CHECK(state->block == 5);
  CHECK(state->actuator_power);  // assumed on: this device does not report its motor power
}

TEST_CASE("a block index outside the field's range is not encoded, because it would address another block") {
  for (const char* device : kPidDevices) {
    CAPTURE(device);
    const PidLayout pid = pid_of(device);
    for (const int block : {kNoBlock, -1, 256, 300, 100000}) {
      CAPTURE(block);
      CHECK(hex_of(encode_set_effect(pid, settings(block, PidEffect::constant, 0))).empty());
      // Where the driver manages the pool, these two have a place in memory instead of a block.
      CHECK((pid.is_pool_ours() || hex_of(encode_constant(pid, block, 1.0)).empty()));
      CHECK((pid.is_pool_ours() || hex_of(encode_condition(pid, block, 0, kSpring)).empty()));
      CHECK(hex_of(encode_operation(pid, block, PidOperation::start, 1)).empty());
      CHECK(hex_of(encode_block_free(pid, block)).empty());
    }
  }
  CHECK(hex_of(encode_constant(pid_of("microsoft-sidewinder-ff2"), 41, 1.0)).empty());
  CHECK(hex_of(encode_condition(pid_of("microsoft-sidewinder-ff2"), 1, 2, kSpring)).empty());  // only two axes
  CHECK(hex_of(encode_condition(pid_of("microsoft-sidewinder-ff2"), 1, -1, kSpring)).empty());
}

// Bytes as in zanppa/hid-pidff 37709a8, which was tried on this stick; offsets of ours. A spring is enabled by axis bits
// (C0h), because with the direction bit (20h) only its first condition acts.
TEST_CASE("Cyborg Evo Force: the driver places parameters in the stick's memory") {
  const PidLayout pid = pid_of("saitek-cyborg-evo-force");
  CHECK(pid.is_pool_ours());
  PidEffectSettings constant = settings(1, PidEffect::constant, 1);
  constant.place = {16, -1};
  CHECK(hex_of(encode_set_effect(pid, constant)) == "0B 01 01 20 2C 01 80 00 00 10 00 FF FF 00 00");
  CHECK(hex_of(encode_constant(pid, 16, 1.0)) == "0D 10 00 7F");
  PidEffectSettings spring = settings(3, PidEffect::spring, -1);
  spring.style = AxisStyle::bits;
  spring.place = {32, 48};
  CHECK(hex_of(encode_set_effect(pid, spring)) == "0B 03 07 C0 2C 01 40 00 00 20 00 30 00 00 00");
  CHECK(hex_of(encode_condition(pid, 48, 1, kSpring)).starts_with("0F 30 00 "));
  CHECK(hex_of(encode_constant(pid, 300, 1.0)).empty());  // the memory has 300 bytes
  CHECK(control(pid, PidControl::reset) == "52 01");
  CHECK(control(pid, PidControl::enable_actuators) == "52 03");
}

TEST_CASE("MOZA: six controls in one field that is flagged as a variable are still one number") {
  // The SideWinder's device control field, but flagged as a variable: item 91 02 instead of 91 00.
  const PidLayout pid =
      needed_pid_in(with(device_descriptor("microsoft-sidewinder-ff2"), "09 9C 15 01 25 06 75 08 95 01 91 00",
                         "09 9C 15 01 25 06 75 08 95 01 91 02"));
  CHECK(control(pid, PidControl::stop_all) == "0C 03");
  CHECK(control(pid, PidControl::resume) == "0C 06");
}

TEST_CASE("adapt-ffb-joy: conditions with only centre and one coefficient, no start delay, a turn of 180") {
  std::vector<std::uint8_t> bytes = device_descriptor("microsoft-sidewinder-ff2");
  // On adapt-ffb-joy, the condition report ends after the positive coefficient (Descriptors.c), and Set Effect ends
  // after the direction.
  bytes = with(
      bytes,
      "09 61 09 62 95 02 91 02 15 00 26 FF 00 35 00 46 10 27 09 63 09 64 75 08 95 02 91 02 09 65 46 10 27 95 01 91 02",
      "09 61 95 01 91 02");
  bytes = with(bytes, "09 A7 66 03 10 55 FD 15 00 26 FF 7F 35 00 46 FF 7F 75 10 95 01 91 02", "");
  bytes = with(bytes, "55 FE 15 00 26 FF 00 35 00 47", "55 FE 15 00 26 B4 00 35 00 47");
  const PidLayout pid = needed_pid_in(bytes);
  CHECK(hex_of(encode_condition(pid, 3, 1, kSpring)) == "03 03 01 E0 40");
  // Directions: 180/4 = 45 = 2Dh, 180/2 = 90 = 5Ah.
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 0))) ==
        "01 01 01 2C 01 00 00 00 00 FF FF 04 2D 2D");
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 1))) ==
        "01 01 01 2C 01 00 00 00 00 FF FF 04 5A 5A");
}

TEST_CASE("without a parameter block there is only one condition, for the first axis") {
  const PidLayout pid =
      needed_pid_in(with(device_descriptor("microsoft-sidewinder-ff2"), "09 23 15 00", "09 24 15 00"));
  CHECK(hex_of(encode_condition(pid, 3, 0, kSpring)) == "03 03 00 E0 40 40 CC CC 33");
  CHECK(hex_of(encode_condition(pid, 3, 1, kSpring)).empty());
}

TEST_CASE("an unsigned magnitude with a signed physical range has its zero in the middle") {
  const PidLayout pid =
      needed_pid_in(with(device_descriptor("microsoft-sidewinder-ff2"), "09 70 16 01 FF 26 FF 00 36 F0 D8 46 10 27",
                         "09 70 15 00 26 FE 00 36 F0 D8 46 10 27"));
  // 0 to 254 counts stand for -10000 to 10000, so force 0 is count 127, and force 0.5 is 190.5 -> 191 = BFh.
  CHECK(hex_of(encode_constant(pid, 1, 0.0)) == "05 01 7F 00");
  CHECK(hex_of(encode_constant(pid, 1, 1.0)) == "05 01 FE 00");
  CHECK(hex_of(encode_constant(pid, 1, -1.0)) == "05 01 00 00");
  CHECK(hex_of(encode_constant(pid, 1, 0.5)) == "05 01 BF 00");
}

TEST_CASE("a signed direction: half a turn is its minimum") {
  const PidLayout pid =
      needed_pid_in(with(device_descriptor("openffboard-2axis"), "15 00 27 A0 8C 00 00 35 00 47 A0 8C 00 00",
                         "16 B0 B9 26 50 46 36 B0 B9 46 50 46"));  // -18000 to 18000
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 0))).substr(42, 5) == "28 23");
  CHECK(hex_of(encode_set_effect(pid, settings(1, PidEffect::constant, 1))).substr(42, 5) == "50 46");
}
