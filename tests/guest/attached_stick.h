// An emulated stick plugged into the kernel that this program runs on: by USB/IP, into its virtual host controller. Needs
// root and vhci-hcd: the guest has both (README.md).
#pragma once

#include <memory>
#include <mutex>

#include "tests/support/stick/emulated_stick.h"

namespace gearshift {

class AttachedStick {
 public:
  // Plugs it in. From then on its own threads move it by CLOCK_MONOTONIC and answer the kernel; the mutex guards it.
  // Stick and mutex must outlive it. Throws std::runtime_error where the kernel does not take it.
  AttachedStick(EmulatedStick& stick, std::mutex& mutex);
  ~AttachedStick();  // pulls it out; it has lost its power then

 private:
  struct Wire;
  std::unique_ptr<Wire> wire_;
};

}  // namespace gearshift
