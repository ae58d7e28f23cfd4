// Measures the wake-up lateness of a 1 kHz loop without a stick, with an absent stick, and with a stick whose transfers
// take 50 ms. The driver's calls in a cycle never block (realtime_proof_test.cpp), so the three results should differ
// only by noise of the machine. The results are printed, not checked.
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "haptics/hardware/stick_connection.h"
#include "haptics/rt/realtime_thread.h"
#include "tests/haptics/usb/usb_rig.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

struct Lateness {
  std::int64_t median, p99;  // [ns]
  std::uint64_t skipped, cycles;
};

// Runs cycles for one second. Each cycle reads the state and sends a new command, as a lever's cycle does.
Lateness loop_with(PidDriver& driver) {
  RealtimeThread thread;
  int count = 0;
  thread.start({}, [&](const CycleCall&) {
    driver.state();
    driver.command({.enabled = true, .constant = {0.001 * (++count % 100), 0.0}});
  });
  std::this_thread::sleep_for(std::chrono::seconds(1));
  thread.stop();
  const CycleStatistics& statistics = thread.statistics();
  return {statistics.wake_lateness.quantile(0.5), statistics.wake_lateness.quantile(0.99), statistics.skipped,
          statistics.cycles};
}

void print(const std::string& what, const Lateness& late) {
  MESSAGE(what << ": woken " << 1e-3 * static_cast<double>(late.median) << " us late, p99 "
               << 1e-3 * static_cast<double>(late.p99) << " us, " << late.skipped << " of " << late.cycles
               << " cycles missed");
}

}  // namespace

TEST_CASE("lateness of the loop with no stick, an absent stick and a slow one") {
  IdleHand hand;
  EmulatedStick stick({}, hand);
  StickGadget gadget(stick);
  MockUsb usb;
  PidDriver driver(stick.report_descriptor());
  print("no stick", loop_with(driver));
  HidIdentity identity;
  identity.vendor = 0x045e;
  identity.product = 0x001b;
  StickConnection connection(
      driver, [&] { return open_usb_hid(identity); }, 1'000'000);
  print("an absent one", loop_with(driver));
  CHECK_FALSE(connection.connected());
  usb.plug(gadget);
  CHECK(becomes_true([&] { return connection.connected(); }));
  {
    const std::lock_guard<std::mutex> lock(usb.mutex());
    stick.faults.slow = 0.05;
  }
  print("a slow one", loop_with(driver));
}
