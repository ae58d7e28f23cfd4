// A loop of 1 kHz beside no stick, one that is not there, and one whose answers take 50 ms: how late it wakes. The driver's
// side of a cycle asks nobody and waits for nobody (realtime_proof_test.cpp), so the three should differ by the machine's
// own noise alone; they are told, not judged.
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "haptics/hardware/lever_keeper.h"
#include "haptics/rt/realtime_thread.h"
#include "tests/haptics/usb/usb_rig.h"

using namespace gearshift;

namespace {

struct Lateness {
  std::int64_t median, p99;  // [ns]
  std::uint64_t skipped, cycles;
};

// Of a second in which a cycle does what a lever's does: look, and wish something new.
Lateness loop_with(PidDriver& driver) {
  RealtimeThread thread;
  int count = 0;
  thread.start({}, [&](const CycleCall&) {
    driver.see();
    driver.wish({.enabled = true, .constant = {0.001 * (++count % 100), 0.0}});
  });
  std::this_thread::sleep_for(std::chrono::seconds(1));
  thread.stop();
  const CycleStatistics& seen = thread.statistics();
  return {seen.wake_lateness.quantile(0.5), seen.wake_lateness.quantile(0.99), seen.skipped, seen.cycles};
}

void tell(const std::string& what, const Lateness& late) {
  MESSAGE(what << ": woken " << 1e-3 * static_cast<double>(late.median) << " us late, p99 "
               << 1e-3 * static_cast<double>(late.p99) << " us, " << late.skipped << " of " << late.cycles
               << " cycles missed");
}

}  // namespace

TEST_CASE("the loop beside no stick, an absent one and a slow one") {
  RestingHand hand;
  EmulatedStick stick({}, hand);
  StickGadget gadget(stick);
  MockUsb usb;
  PidDriver driver(stick.report_descriptor());
  tell("no stick", loop_with(driver));
  HidIdentity identity;
  identity.vendor = 0x045e;
  identity.product = 0x001b;
  LeverKeeper keeper(
      driver, [&] { return open_usb_hid(identity); }, 1'000'000);
  tell("an absent one", loop_with(driver));
  CHECK_FALSE(keeper.connected());
  usb.plug(gadget);
  CHECK(becomes_true([&] { return keeper.connected(); }));
  {
    const std::lock_guard<std::mutex> lock(usb.mutex());
    stick.faults.slow = 0.05;
  }
  tell("a slow one", loop_with(driver));
}
