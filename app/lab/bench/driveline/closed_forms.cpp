#include "app/lab/bench/driveline/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "app/lab/bench/driveline/drives.h"

namespace gearshift::lab {
namespace {

constexpr double kBalanceStep = 0.001;                          // [s]
constexpr double kEngine = 0.15, kCar = 0.569;                  // [kg m^2] moment of inertia at the clutch
constexpr double kReduced = kEngine * kCar / (kEngine + kCar);  // [kg m^2]
constexpr double kCapacity = 200.0;                             // [N m]
constexpr double kFast = 300.0, kSlow = 30.0;                   // [rad/s] initial speeds of engine and shaft

double relative_error(double value, double expected) {
  return std::abs(value / expected - 1.0);
}

BenchRow law_row(const std::string& what, double error, const std::string& note) {
  return answers_design(Design::driveline, {"driveline", what, 100.0 * error, "%", 0.01, false, note});
}

BenchRow balance_row(const std::string& what, double error, const std::string& note) {
  return answers_design(Design::driveline, {"driveline", what, error, "relative", 1e-12, false, note});
}

vehicle::DrivelineInput clutch_released() {
  vehicle::DrivelineInput in = pedals(1, 0.0, 0.0);
  in.ignition = false;
  return in;
}

vehicle::Driveline slipping_pair() {
  vehicle::Driveline line(bare_car(kEngine, kCar, kCapacity));
  line.place(kFast, kSlow, kSlow / kPerRoad, false);
  return line;
}

// Checks lock-up time t = Jr dw / T and slip energy E = Jr dw^2 / 2 for constant clutch torque T, initial slip dw and
// reduced inertia Jr.
void add_constant_torque(std::vector<BenchRow>& rows) {
  vehicle::Driveline line = slipping_pair();
  const double slipped = kFast - kSlow;
  const double time = time_until(line, clutch_released(), kBalanceStep,
                                 [](const vehicle::Driveline& l) { return l.state().clutch_locked; });
  const std::string note = "two inertias, constant torque, steps of 1 ms";
  rows.push_back(
      law_row("lock-up time compared with Jr dw / T", relative_error(time, kReduced * slipped / kCapacity), note));
  rows.push_back(law_row("slip energy compared with Jr dw^2 / 2",
                         relative_error(line.energy().clutch, 0.5 * kReduced * slipped * slipped), note));
}

// Checks that the angular momentum J1 w1 + J2 w2 is constant while the clutch slips, locks and stays locked.
void add_momentum(std::vector<BenchRow>& rows) {
  vehicle::Driveline line = slipping_pair();
  const auto momentum = [&] { return kEngine * line.state().engine_speed + kCar * kPerRoad * line.state().road_speed; };
  const double begin = momentum();
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    line.step(clutch_released(), kBalanceStep);
    worst = std::max(worst, relative_error(momentum(), begin));
  }
  rows.push_back(balance_row("momentum balance", worst, "two inertias, from slipping to locked, 1 s"));
}

double dissipated(const vehicle::EnergyLedger& e) {
  return e.friction + e.clutch + e.cone + e.shaft_drag + e.rolling + e.brakes + e.teeth + e.mesh;
}

// Checks the energy balance: initial kinetic energy plus the engine's work must equal dissipated energy plus the work
// against the slope plus final kinetic energy. The imbalance is reported as a fraction of the energy involved.
void add_energy(std::vector<BenchRow>& rows) {
  double worst = 0.0;
  for (const Drive& drive : all_drives()) {
    vehicle::Driveline line(drive.car);
    line.place(drive.engine, drive.shaft, drive.road, true);
    const double begin = line.kinetic_energy();
    for (int i = 0; i * kBalanceStep < drive.duration; ++i) line.step(drive.input(i * kBalanceStep), kBalanceStep);
    const vehicle::EnergyLedger& e = line.energy();
    const double imbalance = begin + e.engine - dissipated(e) - e.slope - line.kinetic_energy();
    worst = std::max(worst, std::abs(imbalance) / (begin + std::abs(e.engine) + dissipated(e)));
  }
  rows.push_back(balance_row("energy balance, worst drive", worst,
                             "launches, clutch dumps, money shift, hill and synchroniser cones"));
}

}  // namespace

void add_closed_forms(std::vector<BenchRow>& rows) {
  add_constant_torque(rows);
  add_momentum(rows);
  add_energy(rows);
}

}  // namespace gearshift::lab
