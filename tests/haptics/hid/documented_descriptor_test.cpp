// The example descriptor in haptics/hardware/BUILDING.md must describe a usable stick; the test reads it from that
// page.
#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>

#include "haptics/hid/lever_report.h"
#include "haptics/hid/pid_layout.h"
#include "haptics/hid/pid_report.h"
#include "tests/haptics/hid/descriptors.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

// Returns the hex bytes of the page's code block, without the comments in the block.
std::string documented_hex() {
  std::ifstream file(GEARSHIFT_TEST_DATA "/../../haptics/hardware/BUILDING.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string fence = "```hex least_stick.hex\n";
  const auto begin = page.find(fence);
  REQUIRE(begin != std::string::npos);
  const auto from = begin + fence.size();
  std::string bytes;
  bool is_comment = false;
  for (const char c : page.substr(from, page.find("```", from) - from)) {
    is_comment = c == '#' || (is_comment && c != '\n');
    if (!is_comment) bytes += c;
  }
  return bytes;
}

}  // namespace

TEST_CASE("the builder's guide: its 257 bytes describe a lever of 16 bits with 8 buttons and forces") {
  const std::vector<std::uint8_t> bytes = hex_bytes(documented_hex());
  CHECK(bytes.size() == 257);
  const ReportDescriptor descriptor = parse_report_descriptor(bytes);

  const auto lever = find_lever_report(descriptor);
  REQUIRE(lever);
  CHECK(lever->id == 1);
  CHECK(lever->size == 6);
  REQUIRE(lever->axes.size() == 2);
  CHECK(lever->axes[1].usage == kUsageY);
  CHECK(lever->axes[1].field.offset == 16);
  CHECK(lever->axes[1].field.min == -32767);
  CHECK(lever->axes[1].field.max == 32767);
  CHECK(lever->buttons.size() == 8);

  const auto pid = find_pid(descriptor);
  REQUIRE(pid);
  CHECK(pid->has_effect(PidEffect::constant));
  CHECK_FALSE(pid->has_effect(PidEffect::spring));
  CHECK(pid->set_effect.id == 2);
  CHECK(pid->set_effect.duration_unit == doctest::Approx(1e-3));
  CHECK(pid->set_effect.full_turn == doctest::Approx(36000.0));
  for (const std::size_t control : {0u, 1u, 2u, 3u}) CHECK(pid->device_control.control.supports(control));
  CHECK_FALSE(pid->create.exists());

  // Derived by hand: report ID 3, block 2, and half of 32767, rounded to 16384 = 0x4000.
  const HidBytes half = encode_constant(*pid, 2, 0.5);
  CHECK(hex(half.view()) == "03 02 00 40");
}
