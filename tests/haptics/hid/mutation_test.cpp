// Device descriptors with a few wrong bytes must be refused in one sentence or read consistently. The fuzzer
// tests/fuzz/hid_descriptor_fuzz.cpp checks the same laws for longer and searches for new code paths.
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/haptics/hid/descriptors.h"
#include "tests/haptics/hid/hid_laws.h"

using namespace gearshift::test;

namespace {

std::vector<std::uint8_t> mutated(std::vector<std::uint8_t> bytes, std::mt19937& random) {
  const auto place = [&] { return bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size()); };
  for (unsigned i = 1 + random() % 4; i > 0 && !bytes.empty(); --i) {
    switch (random() % 5) {
      case 0:
        *place() = static_cast<std::uint8_t>(random());
        break;
      case 1:
        *place() ^= static_cast<std::uint8_t>(1U << random() % 8);
        break;
      case 2:
        bytes.insert(place(), static_cast<std::uint8_t>(random()));
        break;
      case 3:
        bytes.erase(place());
        break;
      default:
        bytes.resize(bytes.size() - random() % std::min<std::size_t>(bytes.size(), 8));
        bytes.push_back(0xc0);
        break;
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("descriptors with a few wrong bytes break no law") {
  std::mt19937 random(1);
  int levers = 0, pid_devices = 0;
  for (const auto& devices : {std::vector<std::string>(std::begin(kPidDevices), std::end(kPidDevices)),
                              std::vector<std::string>(std::begin(kOtherDevices), std::end(kOtherDevices))}) {
    for (const std::string& device : devices) {
      const std::vector<std::uint8_t> original = device_descriptor(device);
      for (int i = 0; i < 500; ++i) {
        const std::vector<std::uint8_t> bytes = mutated(original, random);
        HidLaws laws(bytes);
        const std::string broken = laws.broken_by(bytes);
        CHECK_MESSAGE(broken.empty(), device << " mutation " << i << ": " << broken << ": " << hex(bytes));
        levers += laws.levers;
        pid_devices += laws.pid_devices;
      }
    }
  }
  // Most laws apply only to accepted descriptors, so many descriptors must be accepted.
  CHECK(levers > 500);
  CHECK(pid_devices > 300);
  MESSAGE(levers << " levers, " << pid_devices << " PID devices of 3500");
}

TEST_CASE("random bytes break no law") {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 64);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    const std::string broken = HidLaws(bytes).broken_by(bytes);
    CHECK_MESSAGE(broken.empty(), broken << ": " << hex(bytes));
  }
}
