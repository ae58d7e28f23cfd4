// USB descriptors of the emulated sticks: USB 2.0 chapter 9, HID 1.11 section 6.2.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/stick/stick_family.h"

namespace gearshift::test {

std::vector<std::uint8_t> make_device_descriptor(const StickFamilyTable& family);
// Includes the interface, HID and endpoint descriptors. input_interval [s] is rounded up to whole milliseconds.
std::vector<std::uint8_t> make_configuration_descriptor(const StickFamilyTable& family, std::size_t report_descriptor,
                                                        double input_interval);
std::vector<std::uint8_t> make_string_descriptor(const StickFamilyTable& family, int index);  // empty: no such string

}  // namespace gearshift::test
