#include "app/lab/campaign/campaign_car.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace gearshift::lab {
namespace {

constexpr std::uint64_t kCarSeed = 0x2545f4914f6cdd1d, kStartSeed = 0x9fb21c651e98df25, kFeetSeed = 0x589965cc75374cc3;
constexpr double kMaxRoadSpeed = 40.0;  // [m/s]

// Writes the car file line by line and draws each value when it writes the line.
class CarText {
 public:
  explicit CarText(Chance& chance) : chance_(chance) {}
  void line(std::string_view text) { text_ += fmt::format("{}\n", text); }
  double put(const char* key, double value) {
    line(fmt::format("{} = {}", key, value));
    return value;
  }
  void between(const char* key, double low, double high) { put(key, chance_.between(low, high)); }
  void decades(const char* key, double low, double high) { put(key, chance_.decades(low, high)); }
  void count(const char* key, int low, int high) { put(key, low + chance_.below(high - low + 1)); }
  const std::string& text() const { return text_; }

 private:
  Chance& chance_;
  std::string text_;
};

// Draws speeds that satisfy a car file's condition: stall < idle < red line < limiter.
void write_engine(CarText& car, Chance& chance) {
  const double limiter = chance.decades(1500.0, 15000.0), idle = limiter * chance.between(0.1, 0.25);
  const double max_torque = chance.decades(1.0, 5000.0);
  car.line("[engine]\nfull_load = [");
  for (const double speed_fraction : {0.05, 0.3, 0.6, 1.1})
    car.line(
        fmt::format("  {{ rpm = {}, nm = {} }},", speed_fraction * limiter, max_torque * chance.between(0.2, 1.0)));
  car.line("]");
  car.between("friction_nm", 0.0, 0.3 * max_torque);
  car.between("friction_nm_per_krpm", 0.0, 1.0);
  car.between("friction_nm_per_krpm2", 0.0, 1.0);
  car.between("compression_nm", 0.0, 0.3 * max_torque);
  car.decades("inertia_kgm2", 0.01, 10.0);
  car.put("idle_rpm", idle);
  car.decades("idle_throttle_per_krpm", 0.1, 100.0);
  car.between("idle_throttle_per_krpm_s", 0.0, 20.0);
  car.between("idle_lift_rpm", 0.0, 1000.0);
  car.between("stall_rpm", 50.0, 0.9 * idle);
  car.put("red_line_rpm", 0.95 * limiter);
  car.put("limiter_rpm", limiter);
  car.decades("limiter_band_rpm", 1.0, std::min(1000.0, 0.5 * limiter));
  car.decades("starter_nm", 1.0, 1000.0);
  car.between("starter_rpm", 50.0, 0.9 * idle);
  car.put("shift_from_rpm", 0.4 * limiter);
  car.put("shift_to_rpm", 0.5 * limiter);
  car.put("lug_below_rpm", 0.2 * limiter);
  car.between("shudder_n", 0.0, 10.0);
}

void write_clutch(CarText& car, Chance& chance) {
  car.line("[clutch]");
  car.decades("capacity_nm", 1.0, 10000.0);
  const double closed = car.put("closed_pedal", chance.between(0.0, 0.8));
  car.between("bite_pedal", closed + 0.01, 1.0);
  car.decades("disc_inertia_kgm2", 0.0005, 1.0);
  car.decades("heat_capacity_j_per_k", 10.0, 1e6);
  car.between("cooling_w_per_k", 0.0, 1000.0);
}

void write_gearbox(CarText& car, Chance& chance) {
  car.line("[gearbox]");
  double ratio = chance.decades(1.0, 20.0);
  for (int gear = 1; gear <= haptics::kMaxGear; ++gear) {
    car.put(fmt::format("ratio_{}", gear).c_str(), ratio);
    ratio *= chance.between(0.78, 0.99);  // small steps: the ratio of the ninth gear is still in its allowed range
  }
  car.decades("ratio_r", 0.5, 20.0);
  car.decades("final_drive", 0.5, 20.0);
  car.between("drag_nm", 0.0, 20.0);
  car.between("drag_nm_per_krpm", 0.0, 20.0);
  car.between("efficiency", 0.5, 1.0);
}

void write_synchro(CarText& car) {
  car.line("[synchro]");
  car.decades("friction", 0.01, 0.5);
  car.decades("radius_mm", 5.0, 200.0);
  car.between("cone_half_angle_deg", 3.0, 20.0);
  car.count("cones", 1, 4);
  car.decades("index_radius_mm", 5.0, 200.0);
  car.between("pointing_half_angle_deg", 30.0, 70.0);
  car.decades("index_friction", 0.01, 0.5);
  car.count("teeth", 6, 120);
  car.decades("dog_rpm", 0.5, 100.0);
  car.decades("lever_ratio", 1.0, 30.0);
  car.between("efficiency", 0.5, 1.0);
}

void write_body(CarText& car) {
  car.line("[body]");
  car.decades("mass_kg", 100.0, 60000.0);
  car.between("rotating_kg", 0.0, 5000.0);
  car.decades("wheel_radius_mm", 100.0, 1000.0);
  car.decades("resistance_n", 1.0, 20000.0);
  car.between("resistance_n_per_mps", 0.0, 100.0);
  car.between("resistance_n_per_mps2", 0.0, 20.0);
  car.decades("brake_n", 1.0, 1e6);
  car.decades("hand_brake_n", 1.0, 1e6);
}

}  // namespace

vehicle::CarSpec random_car(std::uint64_t seed) {
  Chance chance(seed ^ kCarSeed);
  CarText car(chance);
  car.line("title = \"Random car\"\ngate = \"paper\"");
  write_engine(car, chance);
  write_clutch(car, chance);
  write_gearbox(car, chance);
  write_synchro(car);
  write_body(car);
  return vehicle::parse_car(car.text(), fmt::format("random_{}.toml", seed));
}

vehicle::CarStart random_start(std::uint64_t seed) {
  Chance chance(seed ^ kStartSeed);
  vehicle::CarStart start;
  if (chance.happens(0.5)) start.road_speed = chance.between(-0.1 * kMaxRoadSpeed, kMaxRoadSpeed);
  start.running = chance.happens(0.9);
  return start;
}

CampaignPedals::CampaignPedals(std::uint64_t seed) : chance_(seed ^ kFeetSeed) {
  controls_.ignition = true;
}

const haptics::DriverControls& CampaignPedals::at(double time) {
  if (time < next_) return controls_;
  next_ = time + chance_.decades(0.05, 3.0);
  const auto pedal = [&](double probability) { return chance_.happens(probability) ? chance_.between(0.0, 1.0) : 0.0; };
  controls_.pedals.throttle = pedal(0.7);
  controls_.pedals.brake = pedal(0.2);
  controls_.pedals.hand_brake = pedal(0.1);
  controls_.pedals.clutch = chance_.happens(0.5) ? 1.0 : pedal(0.5);
  controls_.ignition = chance_.happens(0.95);
  controls_.starter = chance_.happens(0.3);
  controls_.slope = chance_.happens(0.3) ? chance_.between(-0.4, 0.4) : 0.0;
  return controls_;
}

}  // namespace gearshift::lab
