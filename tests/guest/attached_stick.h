// Plugs an emulated stick into the kernel that this program runs on, through USB/IP and the virtual host controller.
// Needs root and vhci-hcd; the guest has both (README.md).
#pragma once

#include <memory>
#include <mutex>

#include "tests/support/stick/emulated_stick.h"

namespace gearshift::test {

class AttachedStick {
 public:
  // Plugs it in. From then on, its own threads advance it by CLOCK_MONOTONIC and answer the kernel; the mutex guards
  // it. Stick and mutex must outlive this object. Throws std::runtime_error if the kernel does not accept it.
  AttachedStick(EmulatedStick& stick, std::mutex& mutex);
  ~AttachedStick();  // unplugs the stick, which loses its power

 private:
  struct Wire;
  std::unique_ptr<Wire> wire_;
};

}  // namespace gearshift::test
