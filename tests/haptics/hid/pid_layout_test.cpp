// Tests that the PID reports and their fields are found. The expected offsets were counted by hand in the descriptors.
// Those of the SideWinder are also in adapt-ffb-joy's wiki (SidewinderFFPDetails.md) and ffb.h, the OpenFFBoard's in
// ffb_defs.h.
#include "haptics/hid/pid_layout.h"

#include <string>

#include <doctest/doctest.h>

#include "tests/haptics/hid/descriptors.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

std::optional<PidLayout> pid_in(const std::vector<std::uint8_t>& bytes) {
  return find_pid(parse_report_descriptor(bytes));
}

PidLayout pid_of(const std::string& device) {
  const auto pid = pid_in(device_descriptor(device));
  REQUIRE(pid);
  return *pid;
}

// Returns the field's "offset:bits", or "-" if the field is missing.
std::string place(const BitField& field) {
  return field.exists() ? std::to_string(field.offset) + ":" + std::to_string(field.bits) : "-";
}

std::string range(const BitField& field) {
  return std::to_string(field.min) + ".." + std::to_string(field.max);
}

std::string id_size(const PidReport& report) {
  return std::to_string(report.id) + ":" + std::to_string(report.size);
}

template <std::size_t N>
std::string numbers(const PidChoice<N>& choice) {
  std::string text;
  for (std::size_t i = 0; i < N; ++i) {
    text += !choice.supports(i)      ? "- "
            : choice.bit[i].exists() ? "b" + place(choice.bit[i]) + " "
                                     : std::to_string(choice.number[i]) + " ";
  }
  return text.substr(0, text.size() - 1);
}

constexpr const char* kAllEffects = "1 2 3 4 5 6 7 8 9 10 11";

// The descriptor of a minimal stick with Set Effect, Set Constant Force and Effect Operation. `set_effect` is appended
// to the Set Effect report, `more` to the whole descriptor.
std::vector<std::uint8_t> minimal_stick(const std::string& set_effect, const std::string& more = "") {
  return hex_bytes(
      "05 01 09 04 A1 01 05 0F 15 01 25 28 75 08 95 01 "
      "09 21 A1 02 85 01 09 22 91 02 " +
      set_effect +
      " C0 "
      "05 0F 15 01 25 28 75 08 95 01 09 73 A1 02 85 05 09 22 91 02 09 70 15 81 25 7F 91 02 C0 "
      "09 77 A1 02 85 0A 15 01 25 28 09 22 91 02 09 78 A1 02 09 79 09 7A 09 7B 25 03 91 00 C0 C0 " +
      more + " C0");
}

}  // namespace

TEST_CASE("SideWinder FF2") {
  const PidLayout pid = pid_of("microsoft-sidewinder-ff2");
  const PidSetEffect& effect = pid.set_effect;
  CHECK(id_size(effect) == "1:16");
  CHECK(place(effect.block) == "0:8");
  CHECK(range(effect.block) == "1..40");
  CHECK(place(effect.type.field) == "8:8");
  CHECK(numbers(effect.type) == kAllEffects);
  CHECK(place(effect.duration) == "16:16");
  CHECK(place(effect.trigger_repeat) == "32:16");
  CHECK(place(effect.sample_period) == "48:16");
  CHECK(place(effect.gain) == "64:8");
  CHECK(place(effect.trigger_button) == "72:8");
  CHECK(place(effect.axis_enable[0]) == "80:1");
  CHECK(place(effect.axis_enable[1]) == "81:1");
  CHECK(place(effect.direction_enable) == "82:1");
  CHECK(place(effect.direction[0]) == "88:8");
  CHECK(place(effect.direction[1]) == "96:8");
  CHECK(place(effect.start_delay) == "104:16");
  CHECK(effect.duration_unit == doctest::Approx(1e-3));
  CHECK(effect.full_turn == doctest::Approx(255.0));  // 255 counts stand for 36000 hundredths of a degree

  const PidSetCondition& condition = pid.set_condition;
  CHECK(id_size(condition) == "3:9");
  CHECK(place(condition.parameter_block) == "8:4");
  CHECK(place(condition.centre) == "16:8");
  CHECK(place(condition.positive_coefficient) == "24:8");
  CHECK(place(condition.negative_coefficient) == "32:8");
  CHECK(place(condition.positive_saturation) == "40:8");
  CHECK(place(condition.negative_saturation) == "48:8");
  CHECK(place(condition.dead_band) == "56:8");
  CHECK(range(condition.centre) == "-128..127");
  CHECK(range(condition.dead_band) == "0..255");

  CHECK(id_size(pid.set_constant) == "5:4");
  CHECK(range(pid.set_constant.magnitude) == "-255..255");
  CHECK(id_size(pid.operate) == "10:4");
  CHECK(numbers(pid.operate.operation) == "1 2 3");
  CHECK(id_size(pid.block_free) == "11:2");
  CHECK(id_size(pid.device_control) == "12:2");
  CHECK(numbers(pid.device_control.control) == "1 2 3 4 5 6");
  CHECK(id_size(pid.gain) == "13:2");
  CHECK(id_size(pid.create) == "1:4");
  CHECK(numbers(pid.create.type) == kAllEffects);
  CHECK(place(pid.create.byte_count) == "8:10");
  CHECK(id_size(pid.block_load) == "2:5");
  CHECK(numbers(pid.block_load.status) == "1 2 3");
  CHECK(place(pid.block_load.ram_available) == "16:16");
  CHECK(id_size(pid.pool) == "3:5");
  CHECK(place(pid.pool.simultaneous) == "16:8");
  CHECK(place(pid.pool.device_managed) == "24:1");
  CHECK(place(pid.pool.shared_parameters) == "25:1");
  CHECK(id_size(pid.state) == "2:3");
  CHECK(place(pid.state.paused) == "0:1");
  CHECK(place(pid.state.actuator_power) == "4:1");
  CHECK(place(pid.state.playing) == "8:1");
  CHECK(place(pid.state.block) == "9:7");
}

TEST_CASE(
    "OpenFFBoard: directions of 16 bits, a bit for each device control, no override switch, no block in the state") {
  const PidLayout pid = pid_of("openffboard-2axis");
  const PidSetEffect& effect = pid.set_effect;
  CHECK(id_size(effect) == "1:22");  // ID and size: FFB_SetEffect_t plus two 16-bit offsets
  CHECK(place(effect.start_delay) == "64:16");
  CHECK(place(effect.gain) == "80:8");
  CHECK(place(effect.axis_enable[1]) == "97:1");
  CHECK(place(effect.direction_enable) == "98:1");
  CHECK(place(effect.direction[0]) == "104:16");
  CHECK(place(effect.direction[1]) == "120:16");
  CHECK(effect.full_turn == doctest::Approx(36000.0));
  CHECK(numbers(effect.type) == kAllEffects);
  CHECK(id_size(pid.set_condition) == "3:15");
  CHECK(place(pid.set_condition.centre) == "16:16");
  CHECK(place(pid.set_condition.dead_band) == "96:16");
  CHECK(range(pid.set_condition.positive_saturation) == "0..32767");
  CHECK(id_size(pid.set_constant) == "5:4");
  CHECK(range(pid.set_constant.magnitude) == "-32767..32767");
  CHECK(id_size(pid.device_control) == "12:2");
  CHECK(numbers(pid.device_control.control) == "b0:1 b1:1 b2:1 b3:1 b4:1 b5:1");
  CHECK(id_size(pid.create) == "17:4");
  CHECK(id_size(pid.block_load) == "18:5");
  CHECK(id_size(pid.pool) == "19:5");
  CHECK(id_size(pid.state) == "2:2");
  CHECK(place(pid.state.actuator_power) == "3:1");
  CHECK(place(pid.state.playing) == "4:1");
  CHECK_FALSE(pid.state.override_switch.exists());
  CHECK_FALSE(pid.state.block.exists());
}

TEST_CASE("vJoy: its own IDs, blocks to 100, a turn of 32767, a state in a collection without a usage") {
  const PidLayout pid = pid_of("vjoy-2axis-ffb-tlid1");
  CHECK(id_size(pid.set_effect) == "17:22");
  CHECK(range(pid.set_effect.block) == "1..100");
  CHECK(pid.set_effect.full_turn == doctest::Approx(32767.0));
  CHECK(id_size(pid.set_condition) == "19:15");
  CHECK(range(pid.set_condition.positive_coefficient) == "-10000..10000");
  CHECK(id_size(pid.set_constant) == "21:4");
  CHECK(range(pid.set_constant.magnitude) == "-10000..10000");
  CHECK(id_size(pid.operate) == "26:4");
  CHECK(id_size(pid.block_free) == "27:2");
  CHECK(id_size(pid.device_control) == "28:2");
  CHECK(numbers(pid.device_control.control) == "1 2 3 4 5 6");
  CHECK(id_size(pid.gain) == "29:2");
  CHECK(id_size(pid.create) == "17:4");
  CHECK(id_size(pid.block_load) == "18:5");
  CHECK(id_size(pid.pool) == "19:5");
  CHECK(id_size(pid.state) == "20:2");
  CHECK(place(pid.state.playing) == "0:1");
  CHECK(place(pid.state.actuators_enabled) == "2:1");
  CHECK(place(pid.state.actuator_power) == "5:1");
  CHECK_FALSE(pid.state.block.exists());  // only a feature report with the same ID has a block field
}

TEST_CASE("Saitek: no type, direction, axes nor conditions; choices in an order of its own") {
  const PidLayout pid = pid_of("saitek-gamepad-ff0d");
  CHECK(id_size(pid.set_effect) == "11:9");
  CHECK(numbers(pid.set_effect.type) == "- - - - - - - - - - -");
  CHECK(place(pid.set_effect.trigger_button) == "8:8");
  CHECK(place(pid.set_effect.duration) == "16:16");
  CHECK(range(pid.set_effect.duration) == "0..65534");
  CHECK(pid.set_effect.duration_unit == doctest::Approx(1e-3));  // the field's unit is SI seconds with exponent -3
  CHECK(place(pid.set_effect.start_delay) == "48:16");
  CHECK_FALSE(pid.set_effect.gain.exists());
  CHECK_FALSE(pid.set_effect.direction[0].exists());
  CHECK_FALSE(pid.set_effect.axis_enable[0].exists());
  CHECK(pid.set_effect.full_turn == 0.0);
  CHECK_FALSE(pid.set_condition.exists());
  CHECK(id_size(pid.set_constant) == "13:3");
  CHECK(range(pid.set_constant.magnitude) == "-127..127");
  CHECK(id_size(pid.operate) == "81:4");
  CHECK(numbers(pid.operate.operation) == "2 3 1");
  CHECK(id_size(pid.device_control) == "82:2");
  CHECK(numbers(pid.device_control.control) == "3 4 2 1 5 6");
  CHECK(id_size(pid.gain) == "67:2");
  CHECK(range(pid.gain.gain) == "0..128");
  CHECK(id_size(pid.create) == "21:2");
  CHECK(numbers(pid.create.type) == "1 - 2 4 3 5 6 - - - -");
  CHECK(pid.has_effect(PidEffect::constant));
  CHECK_FALSE(pid.has_effect(PidEffect::spring));
  CHECK(id_size(pid.block_load) == "22:3");
  CHECK(place(pid.block_load.block) == "8:8");
  CHECK_FALSE(pid.block_load.ram_available.exists());
  CHECK(id_size(pid.pool) == "11:4");
  CHECK(place(pid.pool.ram_size) == "0:15");
  CHECK(place(pid.pool.device_managed) == "15:1");
  CHECK(id_size(pid.block_free) == "80:2");
  CHECK(id_size(pid.state) == "2:3");
  CHECK(place(pid.state.paused) == "1:1");
  CHECK(place(pid.state.playing) == "15:1");
}

TEST_CASE("a device that uses the PID page only for rumble is not a PID device, nor are pads and wheels without it") {
  for (const char* device : kOtherDevices) {
    CAPTURE(device);
    CHECK_FALSE(pid_in(device_descriptor(device)));
  }
  // The rumble report of Xbox One pads over Bluetooth has magnitudes but no effect block, so it is not a PID report.
  CHECK_FALSE(pid_in(hex_bytes(
      "05 01 09 05 A1 01 05 0F 09 21 85 03 A1 02 09 97 15 00 25 01 75 04 95 01 91 02 15 00 25 00 75 04 95 01 91 03 "
      "09 70 15 00 25 64 75 08 95 04 91 02 09 50 66 01 10 55 0E 15 00 26 FF 00 75 08 95 01 91 02 "
      "09 A7 15 00 26 FF 00 75 08 95 01 91 02 65 00 55 00 09 7C 15 00 26 FF 00 75 08 95 01 91 02 C0 C0")));
}

TEST_CASE("optional reports may be missing; required ones may not") {
  const auto pid = pid_in(minimal_stick(""));
  REQUIRE(pid);
  CHECK(id_size(pid->set_effect) == "1:2");
  CHECK_FALSE(pid->set_effect.duration.exists());
  CHECK_FALSE(pid->set_condition.exists());
  CHECK_FALSE(pid->device_control.exists());
  CHECK_FALSE(pid->gain.exists());
  CHECK_FALSE(pid->create.exists());
  CHECK_FALSE(pid->block_load.exists());
  CHECK_FALSE(pid->pool.exists());
  CHECK_FALSE(pid->state.exists());
  CHECK_FALSE(pid->has_effect(PidEffect::spring));
  for (const char* usage : {"09 21", "09 73", "09 77", "09 70", "09 79"}) {
    CAPTURE(usage);
    CHECK_FALSE(pid_in(with(minimal_stick(""), usage, "09 01")));
  }
}

TEST_CASE("device control: an array, bits, or an array that is flagged as a variable, in either of its collections") {
  const std::string six = "09 97 09 98 09 99 09 9A 09 9B 09 9C ";
  const auto control = [](const std::string& more) {
    return numbers(pid_in(minimal_stick("", more))->device_control.control);
  };
  CHECK(control("09 96 A1 02 85 0C " + six + "15 01 25 06 75 08 95 01 91 00 C0") == "1 2 3 4 5 6");
  CHECK(control("09 95 A1 02 85 0C " + six + "15 01 25 06 75 08 95 01 91 00 C0") == "1 2 3 4 5 6");
  CHECK(control("09 95 A1 02 85 0C 09 96 A1 02 " + six + "15 01 25 06 75 08 95 01 91 02 C0 C0") ==
        "1 2 3 4 5 6");  // MOZA
  CHECK(control("09 95 A1 02 85 0C 09 96 A1 02 " + six + "15 00 25 01 75 01 95 06 91 02 75 02 95 01 91 03 C0 C0") ==
        "b0:1 b1:1 b2:1 b3:1 b4:1 b5:1");  // Fanatec
  CHECK(control("09 96 A1 02 85 0C " + six + "15 00 25 01 75 08 95 06 91 02 C0") ==
        "b0:8 b8:8 b16:8 b24:8 b32:8 b40:8");                                                        // one byte each
  CHECK(control("09 96 A1 02 85 0C " + six + "15 00 25 05 75 08 95 01 91 00 C0") == "0 1 2 3 4 5");  // counted from 0
  CHECK(control("09 96 A1 02 85 0C " + six + "15 01 25 04 75 08 95 01 91 00 C0") == "1 2 3 4 - -");  // out of range
  CHECK(control("09 96 A1 02 85 0C 09 98 09 97 25 02 91 00 C0") == "2 1 - - - -");
  // A field of 255 bits cannot hold a number, not even 0 (found by fuzzing).
  CHECK(control("09 96 A1 02 85 0C " + six + "15 00 25 05 75 FF 95 01 91 00 C0") == "- - - - - -");
  // A control field outside the Device Control collection is not used.
  CHECK(control("09 21 A1 02 85 0C " + six + "15 01 25 06 75 08 95 01 91 00 C0") == "- - - - - -");
}

TEST_CASE("axes and directions: by axis or ordinal, one polar direction, 36000 hundredths or the device's counts") {
  const auto effect = [](const std::string& items) { return pid_in(minimal_stick(items))->set_effect; };
  const std::string bits = "15 00 25 01 75 01 95 02 91 02 C0 75 06 95 01 91 03";
  CHECK(place(effect("09 55 A1 02 05 01 09 31 09 30 " + bits).axis_enable[0]) == "9:1");  // Y first
  CHECK(place(effect("09 55 A1 02 0B 01 00 0A 00 0B 02 00 0A 00 " + bits).axis_enable[1]) == "9:1");
  CHECK(place(effect("05 01 09 30 09 31 15 00 25 01 75 01 95 02 91 02 75 06 95 01 91 03").axis_enable[0]) == "-");
  const PidSetEffect polar = effect("09 57 15 00 26 B3 00 75 08 95 01 91 02");
  CHECK(place(polar.direction[0]) == "8:8");
  CHECK_FALSE(polar.direction[1].exists());
  CHECK(polar.full_turn == doctest::Approx(179.0));
  // The range of 0 to 35999 counts is 0 to 35999 hundredths of a degree, so a full turn is one count more: 36000.
  const PidSetEffect nearly =
      effect("09 57 A1 02 0B 01 00 0A 00 55 FE 15 00 27 9F 8C 00 00 35 00 47 9F 8C 00 00 75 10 95 01 91 02 55 00 C0");
  CHECK(nearly.full_turn == doctest::Approx(36000.0));
  // On adapt-ffb-joy, 0 to 180 counts are 0 to 36000 hundredths of a degree.
  CHECK(effect("09 57 A1 02 0B 01 00 0A 00 55 FE 15 00 26 B4 00 35 00 47 A0 8C 00 00 75 08 95 01 91 02 C0").full_turn ==
        doctest::Approx(180.0));
}

TEST_CASE("the unit of durations: the field's unit, or milliseconds if it has none") {
  const auto unit = [](const std::string& items) {
    return pid_in(minimal_stick("09 50 " + items))->set_effect.duration_unit;
  };
  CHECK(unit("75 10 95 01 91 02") == doctest::Approx(1e-3));
  CHECK(unit("15 00 26 FF 7F 35 00 46 FF 7F 66 03 10 55 FD 75 10 91 02") == doctest::Approx(1e-3));
  CHECK(unit("15 00 26 FF 7F 35 00 45 00 66 01 10 55 0C 75 10 91 02") == doctest::Approx(1e-4));
  // 0 to 255 counts are 0 to 2550 hundredths of a second, so one count is 0.1 s.
  CHECK(unit("15 00 26 FF 00 35 00 46 F6 09 66 01 10 55 0E 75 08 91 02") == doctest::Approx(0.1));
  CHECK(unit("15 00 26 FF 7F 65 14 55 FE 75 10 91 02") == doctest::Approx(1e-3));  // degrees: ignored, so 1 ms
}

TEST_CASE("reports that are too long are not used") {
  CHECK(pid_in(minimal_stick("75 08 95 FE 91 01"))->set_effect.size == 256);
  CHECK_FALSE(pid_in(minimal_stick("75 08 96 FF 00 91 01")));
  // An optional report that is too long is ignored with all its fields (found by mutation). Here it is the SideWinder's
  // block load report with 236 fields of 16 bits.
  const auto pid =
      pid_in(with(device_descriptor("microsoft-sidewinder-ff2"), "75 10 95 01 B1 00", "75 10 95 EC B1 00"));
  REQUIRE(pid);
  CHECK_FALSE(pid->block_load.exists());
  CHECK_FALSE(pid->block_load.block.exists());
  CHECK_FALSE(pid->block_load.status.supports(0));
}

TEST_CASE("effects have names") {
  CHECK(std::string(to_string(PidEffect::constant)) == "constant force");
  CHECK(std::string(to_string(PidEffect::friction)) == "friction");
}
