// Compares integration methods for the driveline at steps of 1 and 4 ms: cost per step, and error against a reference.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "app/lab/bench/driveline/closed_forms.h"
#include "app/lab/bench/driveline/methods.h"
#include "app/lab/bench/rows/bench.h"
#include "app/lab/bench/rows/ticks.h"

namespace gearshift::lab {
namespace {

constexpr DriveMethod kMethods[] = {DriveMethod::events, DriveMethod::impulses, DriveMethod::tanh};

// Cost per step of each method [ns], including the overhead for pedals and samples, which is the same for all methods.
// The methods run alternately, so that a busy machine slows all of them equally.
std::vector<Timed> costs(const Drive& drive, double step, int rounds) {
  std::vector<std::vector<double>> durations(std::size(kMethods));
  for (int i = 0; i < rounds; ++i) {
    for (std::size_t m = 0; m < std::size(kMethods); ++m) {
      const std::uint64_t before = ticks();
      const DriveOutcome out = drive_by(kMethods[m], drive, step);
      durations[m].push_back(static_cast<double>(ticks() - before) / ticks_per_ns() /
                             static_cast<double>(out.samples.size() - 1));
    }
  }
  std::vector<Timed> all;
  for (std::vector<double>& t : durations) all.push_back(timed(t));
  return all;
}

// True if `impulses` and `tanh` can simulate the drive. They do not model gear losses, keys and temperature.
bool supports_plain_methods(const Drive& drive) {
  return drive.car.gearbox.efficiency == 1.0 && drive.running && drive.temperature == vehicle::kAirTemperature;
}

// Gives the cost per simulated second, so that methods with different step lengths can be compared.
Trade trade_of(const BenchRow& row, const Drive& drive, DriveMethod method, double step, const Timed& ns) {
  const double us = 1e-3 / step;  // converts [ns] per step to [us] per simulated second
  std::optional<Quartiles> spread;
  if (ns.spread) spread = Quartiles{us * ns.spread->low, us * ns.spread->high};
  const std::string name = to_string(method) + (", " + std::to_string(std::lround(1e3 * step)) + " ms");
  return {drive.name,
          name,
          {"cost", us * ns.median, "us per simulated second", spread},
          {"error in slip energy", row.value, "%"},
          method == DriveMethod::events && step < 0.002};
}

BenchRow row_of(const Drive& drive, DriveMethod method, double step, const DriveOutcome& reference, const Timed& ns) {
  const DriveOutcome outcome = drive_by(method, drive, step);
  const std::size_t stride = static_cast<std::size_t>(std::lround(step / 0.001));
  double worst = 0.0;
  for (std::size_t i = 0; i < outcome.samples.size(); ++i)
    worst = std::max(worst, std::abs(outcome.samples[i].engine - reference.samples[i * stride].engine));
  const bool slips = reference.slip_energy > 0.0;
  BenchRow row{"driveline",
               drive.name + ", " + std::to_string(std::lround(1e3 * step)) + " ms: " + to_string(method),
               slips ? 100.0 * std::abs(outcome.slip_energy / reference.slip_energy - 1.0)
                     : 100.0 * worst / drive.car.engine.idle,
               slips ? "% of the slip energy" : "% of the idle speed",
               {},
               false,
               outcome.running == reference.running ? ""
               : outcome.running                    ? "does not stall but should"
                                                    : "stalls but should not",
               true,
               {{"largest error in engine speed", worst, "rad/s"},
                {"error in engine speed at the end",
                 std::abs(outcome.samples.back().engine - reference.samples.back().engine), "rad/s"},
                {"cost", ns.median, "ns per step", ns.spread}}};
  if (supports_plain_methods(drive)) row.trade = trade_of(row, drive, method, step, ns);
  if (method != DriveMethod::events || step > 0.002) return row;
  row.goal = 0.01;
  return answers_design(Design::driveline, std::move(row));
}

// Times the steps of complete drives. The inputs are computed in advance, so that only the steps are timed.
BenchRow headless_step(const std::vector<Drive>& drives, int rounds) {
  std::vector<double> step_times;
  for (int i = 0; i < rounds; ++i) {
    for (const Drive& drive : drives) {
      std::vector<vehicle::DrivelineInput> inputs;
      const auto steps = std::lround(1e3 * drive.duration);
      for (int n = 0; n < steps; ++n) inputs.push_back(drive.input(0.001 * n));
      vehicle::Driveline line(drive.car);
      line.place(drive.engine, drive.shaft, drive.road, true);
      const std::uint64_t before = ticks();
      for (const vehicle::DrivelineInput& in : inputs) line.step(in, 0.001);
      step_times.push_back(static_cast<double>(ticks() - before) / ticks_per_ns() / static_cast<double>(inputs.size()));
    }
  }
  const Timed ns = timed(step_times);
  return with_spread(ns.spread,
                     {"driveline",
                      "one step of 1 ms without display",
                      ns.median,
                      "ns",
                      {},
                      false,
                      "median over all drives, " + std::to_string(rounds) + " times each",
                      true,
                      {{"p90", quantile(step_times, 0.9), "ns"}, {"speed", 1e6 / ns.median, "x real time"}}});
}

}  // namespace

std::vector<BenchRow> bench_driveline(const BenchOptions& options) {
  const int rounds = options.quick ? 3 : 41;
  std::vector<BenchRow> rows{headless_step(all_drives(), rounds)};
  add_closed_forms(rows);
  const std::filesystem::path cars = std::filesystem::path(options.gate_folder).parent_path() / "cars";
  const Drive shipped = launch_of(vehicle::read_car(cars / "hatchback.toml"));
  std::vector<Drive> drives{launch(),       shipped,        pull_away(shipped.car, 1, 1.5),
                            dump_at_idle(), dump_at_4000(), money_shift()};
  for (const Drive& drive : engine_drives()) drives.push_back(drive);
  for (const Drive& drive : drives) {
    const DriveOutcome reference = reference_of(drive);
    for (const double step : {0.001, 0.004}) {
      if (options.progress) options.progress("driveline", static_cast<double>(rows.size()) / 38.0);
      const std::vector<Timed> ns = costs(drive, step, rounds);
      const std::size_t methods = supports_plain_methods(drive) ? std::size(kMethods) : 1;
      for (std::size_t m = 0; m < methods; ++m) rows.push_back(row_of(drive, kMethods[m], step, reference, ns[m]));
    }
  }
  return rows;
}

}  // namespace gearshift::lab
