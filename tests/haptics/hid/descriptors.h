// Report descriptors for tests: those of real devices (files in tests/data/hid), and conversions from and to hex text.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace gearshift::test {

inline constexpr const char* kPidDevices[] = {"microsoft-sidewinder-ff2",
                                              "openffboard-2axis",
                                              "vjoy-2axis-ffb-tlid1",
                                              "saitek-gamepad-ff0d",
                                              "openffboard-2axis-32bit-1.17",
                                              "arduino-ffb-library-yukminglaw-xy",
                                              "arduino-ffb-library-yukminglaw-xy-hat",
                                              "adapt-ffb-joy-tloimu",
                                              "sunffb-joystick",
                                              "affbwheel-vsulako",
                                              "brwheel-ranenbg",
                                              "stm32-ffbjoystick-billydragon",
                                              "saitek-cyborg-evo-force"};
inline constexpr const char* kOtherDevices[] = {"sony-dualshock4-v2-usb", "logitech-g29-ps4",
                                                "fanatec-clubsport-handbrake"};

// Converts hex text such as "05 01" to bytes.
inline std::vector<std::uint8_t> hex_bytes(const std::string& text) {
  std::istringstream input(text);
  std::vector<std::uint8_t> bytes;
  for (std::string word; input >> word;) bytes.push_back(static_cast<std::uint8_t>(std::stoul(word, nullptr, 16)));
  return bytes;
}

// Converts bytes to hex text for messages.
inline std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    char word[4];
    std::snprintf(word, sizeof word, "%02X ", byte);
    text += word;
  }
  if (!text.empty()) text.pop_back();
  return text;
}

inline std::vector<std::uint8_t> device_descriptor(const std::string& device) {
  std::ifstream file(GEARSHIFT_TEST_DATA "/hid/" + device + ".hex");
  if (!file) throw std::runtime_error("no descriptor of " + device);
  return hex_bytes({std::istreambuf_iterator<char>(file), {}});
}

// Returns the descriptor with the first occurrence of `old_bytes` replaced by `new_bytes`. Throws if there is none.
inline std::vector<std::uint8_t> with(std::vector<std::uint8_t> descriptor, const std::string& old_bytes,
                                      const std::string& new_bytes) {
  const std::vector<std::uint8_t> out = hex_bytes(old_bytes), in = hex_bytes(new_bytes);
  const auto at = std::search(descriptor.begin(), descriptor.end(), out.begin(), out.end());
  if (at == descriptor.end()) throw std::runtime_error("no such bytes: " + old_bytes);
  const auto gap = descriptor.erase(at, at + static_cast<std::ptrdiff_t>(out.size()));
  descriptor.insert(gap, in.begin(), in.end());
  return descriptor;
}

}  // namespace gearshift::test
