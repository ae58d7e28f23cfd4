// The calls that run in the haptic cycle touch no heap.
#include <atomic>
#include <cstdlib>
#include <new>

#include <doctest/doctest.h>

#include "haptics/device/led_hand.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/device/simulated_lever.h"

namespace {
std::atomic<long> g_allocations{0};
}

void* operator new(std::size_t size) {
  ++g_allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

using namespace gearshift;

TEST_CASE("reading, writing and releasing allocate nothing") {
  SimulatedLeverConfig config;
  config.hand = kGripHand;
  config.coulomb_friction = 0.2;
  config.force_sensor.noise_gw = 10.0;
  config.delay = 2;
  ScriptedHandConfig script;
  script.effort_gain = 100.0;
  script.effort_limit = 10.0;
  HandStroke stroke;
  stroke.to = {0.07, 0.06};
  ScriptedHand scripted(script, {stroke, HandStroke{}}, 1e-3);
  LatestValue<HandTarget> channel;
  LedHand led(channel, 1e-3);
  SimulatedLever by_script(config, 1'000'000, scripted), by_person(config, 1'000'000, led);

  const long before = g_allocations;
  for (std::int64_t ms = 0; ms < 1000; ++ms) {
    by_script.read(ms * 1'000'000);
    by_script.write({-20.0, 3.0});
    by_person.read(ms * 1'000'000);
  }
  by_script.release();
  CHECK(g_allocations == before);
}
