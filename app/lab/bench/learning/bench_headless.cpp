// Measures the speed of headless simulation on one core: the lever, the lever with a car, and a complete lesson.
#include <chrono>
#include <ctime>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "app/lab/bench/learning/shipped_drive.h"
#include "app/lab/bench/lever/touring.h"
#include "app/lab/bench/rows/bench.h"
#include "app/vehicle/car_load.h"

namespace gearshift::lab {
namespace {

namespace fs = std::filesystem;

constexpr double kRate = 1000.0;      // [Hz]
constexpr double kPaperForce = 31.7;  // [N] motor force limit of the paper's lever
constexpr const char* kLesson = "down_through_the_gears";

struct Speed {
  std::vector<double> real, processor;  // simulated time per elapsed time, and per CPU time
};

// Runs the simulation `drive`, which returns the simulated time [s], and adds its speed to `speed`.
void add_run(Speed& speed, const std::function<double()>& drive) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  const double simulated = drive();
  const double cpu_time = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  speed.real.push_back(simulated / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  if (cpu_time > 0.0) speed.processor.push_back(simulated / cpu_time);
}

double tour(const haptics::Gate& gate, haptics::LeverLoad* load) {
  haptics::ScriptedHand hand = touring_driver(gate, 1.0 / kRate);
  haptics::SimulatedRun run(touring_config(gate), hand, load);
  haptics::DriverControls feet;
  feet.pedals.clutch = 1.0;
  feet.ignition = true;
  run.inputs().controls.write(feet);
  while (run.time() < hand.duration()) run.step();
  return run.time();
}

BenchRow row(const char* name, Speed& speed, double goal, const std::string& what) {
  const Timed real = timed(speed.real);
  BenchRow row{"headless",
               name,
               real.median,
               "x real time",
               goal,
               true,
               what + "; median of " + std::to_string(speed.real.size()),
               true,
               {{"p10", quantile(speed.real, 0.1), ""},
                {"p90", quantile(speed.real, 0.9), ""},
                {"median, based on CPU time", quantile(speed.processor, 0.5), ""}}};
  return answers_design(Design::headless, with_spread(real.spread, std::move(row)));
}

}  // namespace

// Runs the three simulations alternately, so that a busy machine slows all of them equally.
std::vector<BenchRow> bench_headless(const BenchOptions& options) {
  const lessons::LessonDriveConfig lesson = shipped_drive(fs::path(options.gate_folder).parent_path(), kLesson);
  const haptics::Gate paper = bench_gate(options.gate_folder, "paper"),
                      gate = bench_gate(options.gate_folder, lesson.car.gate);
  const int runs = options.quick ? 5 : 41;
  Speed unguided, with_car, full_lesson;
  for (int i = 0; i < runs; ++i) {
    if (options.progress) options.progress("headless", static_cast<double>(i) / runs);
    add_run(unguided, [&] { return tour(paper, nullptr); });
    add_run(with_car, [&] {
      vehicle::CarLoad car(lesson.car, gate, kPaperForce);
      return tour(gate, &car);
    });
    add_run(full_lesson, [&] { return lessons::drive_lesson(lesson).duration; });
  }
  return {row("simulation at 1 kHz", unguided, 3500.0, "tour with lever, hand, gate and guard"),
          row("simulation at 1 kHz with the driveline", with_car, 2200.0,
              "tour of the hatchback's gate with the clutch down"),
          row("a whole lesson", full_lesson, 1300.0, fmt::format("{}, with simulated driver and coach", kLesson))};
}

}  // namespace gearshift::lab
