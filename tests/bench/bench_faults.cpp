// Time from a fault to no force: a lever pressed into a wall with 15 N, and what can go wrong with it.
#include <string>

#include "tests/bench/bench.h"
#include "tests/bench/touring.h"
#include "tests/support/pressed_rig.h"

namespace gearshift {
namespace {

constexpr double kPressed = 10.0;  // [N] of the wall against the hand's 15, before the fault

// before: [N]. A lever that was not held says nothing of how soon it is let go.
BenchRow row(const std::string& fault, double before, int cycles, double goal, const std::string& what) {
  BenchRow to_zero{"faults", fault + ": to zero force", static_cast<double>(cycles), "ms", goal, false, what};
  to_zero.beside = {{"force before", before, "N"}};
  to_zero.measured = before >= kPressed;
  if (!to_zero.measured) to_zero.note = "not measured: there was no force to lose";
  return to_zero;
}

double force_of(const PressedRig& rig) {
  return glm::length(rig.lever.written);
}

std::string state_of(const PressedRig& rig) {
  const HapticSnapshot& now = rig.loop.snapshot();
  return std::string(guard_state_name(now.guard)) + ", " + guard_fault_name(now.fault);
}

// A world behind the lever whose force is no number from some step on.
class MadWorld final : public LeverWorld {
 public:
  LeverOutput step(const LeverInput&, double) noexcept override {
    LeverOutput out;
    if (mad) out.force = {kNan, kNan};
    return out;
  }
  const char* name() const noexcept override { return "mad"; }

  bool mad = false;
};

BenchRow bad_force(const Gate& gate) {
  PressedRig rig(gate);
  MadWorld world;
  HapticLoop loop(HapticConfig{}, gate, rig.lever, world, rig.channels);
  loop.arm();
  for (int i = 0; i < 1500; ++i) loop.cycle(rig.now += kPeriodNs, 0);
  const double before = force_of(rig);
  world.mad = true;
  int cycles = 0;
  do {
    loop.cycle(rig.now += kPeriodNs, 0);
  } while (++cycles < 1000 && rig.lever.written != glm::dvec2{0.0, 0.0});
  const HapticSnapshot& now = loop.snapshot();
  return row("force that is not a number", before, cycles, 1.0,
             std::string(guard_state_name(now.guard)) + ", " + guard_fault_name(now.fault));
}

}  // namespace

std::vector<BenchRow> bench_faults(const BenchOptions& options) {
  const Gate gate = bench_gate(options.gate_folder, "paper");
  std::vector<BenchRow> rows;
  for (const Fault& fault : reading_faults()) {
    PressedRig rig(gate);
    const double before = force_of(rig);
    rig.lever.sabotage = fault.sabotage();
    const int cycles = rig.cycles_to_zero();
    rows.push_back(row(std::string("reading ") + fault.name, before, cycles, fault.within, state_of(rig)));
  }
  for (const auto& [command, name] : {std::pair{LoopCommand::stop, "stop"}, {LoopCommand::disarm, "disarm"}}) {
    PressedRig rig(gate);
    const double before = force_of(rig);
    rig.channels.commands.push(command);
    const int cycles = rig.cycles_to_zero();
    rows.push_back(row(name, before, cycles, 1.0, state_of(rig)));
  }
  {
    PressedRig rig(gate);
    const double before = force_of(rig);
    rig.lever.sabotage = [](LeverReading& reading) { reading.stop = true; };
    const int cycles = rig.cycles_to_zero();
    rows.push_back(row("the device's panic button", before, cycles, 1.0, state_of(rig)));
  }
  {
    PressedRig rig(gate);  // every cycle late by two periods; damping alone is left, and fades with the motion
    const double before = force_of(rig);
    int cycles = 0;
    for (; cycles < 1000 && glm::length(rig.lever.written) > 0.05; ++cycles) rig.run(1, 2);
    rows.push_back(row("overruns in a row, two periods each, below 0.05 N", before, 3 * cycles, 1000.0, state_of(rig)));
  }
  rows.push_back(bad_force(gate));
  return rows;
}

}  // namespace gearshift
