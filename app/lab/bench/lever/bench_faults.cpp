// Time from a fault to zero force, for a lever that is pressed into a wall with 15 N.
#include <string>

#include "app/lab/bench/lever/pressed_rig.h"
#include "app/lab/bench/lever/touring.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

constexpr double kPressed = 10.0;  // [N] minimum wall force before the fault; the hand pushes with 15 N

// `before`: force before the fault [N]. If this force was too small, the row counts as not measured.
BenchRow row(const std::string& fault, double before, int cycles, double goal, const std::string& what) {
  BenchRow to_zero{"faults", fault + ": time to zero force", static_cast<double>(cycles), "ms", goal, false, what};
  to_zero.related = {{"force before", before, "N"}};
  to_zero.measured = before >= kPressed;
  if (!to_zero.measured) to_zero.note = "not measured, because the motors gave too little force before the fault";
  return to_zero;
}

double force_of(const PressedRig& rig) {
  return glm::length(rig.lever.written);
}

std::string state_of(const PressedRig& rig) {
  const haptics::HapticSnapshot& now = rig.loop.snapshot();
  return std::string("guard: ") + haptics::to_string(now.guard) + ", fault: " + haptics::to_string(now.fault);
}

// A load whose force becomes NaN when `returns_nan` is set.
class NanLoad final : public haptics::LeverLoad {
 public:
  haptics::LeverOutput step(const haptics::LeverInput&, double) noexcept override {
    haptics::LeverOutput out;
    if (returns_nan) out.force = {kNan, kNan};
    return out;
  }
  const char* replay_parameters() const noexcept override { return "mad"; }

  bool returns_nan = false;
};

BenchRow bad_force(const haptics::Gate& gate) {
  PressedRig rig(gate);
  NanLoad load;
  haptics::HapticLoop loop(haptics::HapticConfig{}, gate, rig.lever, load, rig.inputs);
  loop.arm();
  for (int i = 0; i < 1500; ++i) loop.cycle(rig.now += kPeriodNs, 0);
  const double before = force_of(rig);
  load.returns_nan = true;
  int cycles = 0;
  do {
    loop.cycle(rig.now += kPeriodNs, 0);
  } while (++cycles < 1000 && rig.lever.written != glm::dvec2{0.0, 0.0});
  const haptics::HapticSnapshot& now = loop.snapshot();
  return row("force that is not a number", before, cycles, 1.0,
             std::string("guard: ") + haptics::to_string(now.guard) + ", fault: " + haptics::to_string(now.fault));
}

}  // namespace

std::vector<BenchRow> bench_faults(const BenchOptions& options) {
  const haptics::Gate gate = bench_gate(options.gate_folder, "paper");
  std::vector<BenchRow> rows;
  for (const Fault& fault : reading_faults()) {
    PressedRig rig(gate);
    const double before = force_of(rig);
    rig.lever.sabotage = fault.sabotage();
    const int cycles = rig.cycles_to_zero();
    rows.push_back(row(std::string("reading ") + fault.name, before, cycles, fault.within, state_of(rig)));
  }
  for (const auto& [command, name] :
       {std::pair{haptics::LoopCommand::stop, "stop"}, {haptics::LoopCommand::disarm, "disarm"}}) {
    PressedRig rig(gate);
    const double before = force_of(rig);
    rig.inputs.commands.push(command);
    const int cycles = rig.cycles_to_zero();
    rows.push_back(row(name, before, cycles, 1.0, state_of(rig)));
  }
  {
    PressedRig rig(gate);
    const double before = force_of(rig);
    rig.lever.sabotage = [](haptics::LeverReading& reading) { reading.stop = true; };
    const int cycles = rig.cycles_to_zero();
    rows.push_back(row("the device's panic button", before, cycles, 1.0, state_of(rig)));
  }
  {
    PressedRig rig(gate);  // below, every cycle is two periods late, so the guard fades the force out
    const double before = force_of(rig);
    int cycles = 0;
    for (; cycles < 1000 && glm::length(rig.lever.written) > 0.05; ++cycles) rig.run(1, 2);
    rows.push_back(row("consecutive overruns of two periods each, until the force is below 0.05 N", before, 3 * cycles,
                       1000.0, state_of(rig)));
  }
  rows.push_back(bad_force(gate));
  return rows;
}

}  // namespace gearshift::lab
