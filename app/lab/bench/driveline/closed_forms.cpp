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

// An idling engine with clutch and shaft, inertia J, against a constant drag D. The idle control answers the speed error
// e with the torque F (kp e + ki times the integral of e), so e'' + (F kp / J) e' + (F ki / J) e = 0 with e(0) = 0 and
// e'(0) = D / J:  e = D / (J wd) exp(-a t) sin(wd t),  a = F kp / 2 J,  wd^2 = F ki / J - a^2.
void add_idle_control(std::vector<BenchRow>& rows) {
  constexpr double kFull = 100.0, kDrag = 12.0, kProportional = 0.02, kIntegral = 0.15;
  vehicle::CarSpec car = bare_car(kEngine, kCar, kCapacity, kFull);
  car.engine.idle = 84.0;
  car.engine.idle_gain = kProportional;
  car.engine.idle_integral_gain = kIntegral;
  car.gearbox.drag = kDrag;
  const double inertia = kEngine + car.clutch.disc_inertia;
  const double decay = 0.5 * kFull * kProportional / inertia;
  const double frequency = std::sqrt(kFull * kIntegral / inertia - decay * decay);
  vehicle::Driveline line(car);
  line.place(car.engine.idle, car.engine.idle, 0.0, true);
  double worst = 0.0;
  for (int i = 1; i <= 1500; ++i) {
    line.step(pedals(0, 0.0, 0.0), 0.001);
    const double time = 0.001 * i;
    const double error = kDrag / (inertia * frequency) * std::exp(-decay * time) * std::sin(frequency * time);
    worst = std::max(worst, std::abs(car.engine.idle - line.state().engine_speed - error));
  }
  const double deepest = std::atan(frequency / decay) / frequency;  // [s] time of the largest error
  const double dip = kDrag / (inertia * frequency) * std::exp(-decay * deepest) * std::sin(frequency * deepest);
  rows.push_back(law_row("idle control against a drag, compared with a damped sine", worst / dip,
                         "largest error, as a fraction of the dip; steps of 1 ms"));
}

// The brake holds a car whose clutch slips with a constant power P: the clutch, of heat capacity C and cooling k, warms as
// P / k (1 - exp(-k t / C)) above the air, and cools as exp(-k t / C) afterwards.
void add_clutch_heat(std::vector<BenchRow>& rows) {
  vehicle::CarSpec car = bare_car(1e9, kCar, 100.0);  // the engine is so heavy that its speed stays constant
  car.clutch.heat_capacity = 2000.0;
  car.clutch.cooling = 20.0;
  vehicle::Driveline line(car);
  line.place(20.0, 0.0, 0.0, false);
  vehicle::DrivelineInput held = pedals(1, 0.0, 0.0);
  held.pedals.brake = 1.0;
  drive(line, held, 60.0);
  const double power = 100.0 * 20.0, air = vehicle::kAirTemperature, decay = std::exp(-20.0 * 60.0 / 2000.0);
  const double warmed = power / 20.0 * (1.0 - decay);
  rows.push_back(law_row("clutch temperature compared with P / k (1 - exp(-k t / C))",
                         relative_error(line.state().clutch_temperature - air, warmed),
                         "constant slip power for a minute, steps of 1 ms"));
  vehicle::DrivelineInput open = held;
  open.pedals.clutch = 1.0;
  drive(line, open, 60.0);
  rows.push_back(law_row("cooling of the clutch compared with exp(-k t / C)",
                         relative_error(line.state().clutch_temperature - air, warmed * decay),
                         "the minute after it, steps of 1 ms"));
}

}  // namespace

void add_closed_forms(std::vector<BenchRow>& rows) {
  add_constant_torque(rows);
  add_momentum(rows);
  add_energy(rows);
  add_idle_control(rows);
  add_clutch_heat(rows);
}

}  // namespace gearshift::lab
