// Plugs an emulated stick into the running kernel, through USB/IP and the virtual host controller. Needs root rights
// and the kernel module vhci-hcd; the QEMU guest has both (README.md).
#pragma once

#include <memory>
#include <mutex>

#include "tests/support/stick/emulated_stick.h"

namespace gearshift::test {

class AttachedStick {
 public:
  // Plugs the stick in. From then on, threads of this object advance the stick's time with CLOCK_MONOTONIC and answer
  // the kernel. They lock `mutex` whenever they use the stick. Stick and mutex must outlive this object. Throws
  // std::runtime_error if the kernel does not accept the stick.
  AttachedStick(EmulatedStick& stick, std::mutex& mutex);
  ~AttachedStick();  // unplugs the stick and cuts its power

 private:
  struct Wire;
  std::unique_ptr<Wire> wire_;
};

}  // namespace gearshift::test
