#include "app/vehicle/car_spec.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "haptics/files/number_text.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::vehicle {
namespace {

constexpr double kPerRpm = std::numbers::pi / 30.0;  // [rad/s]
constexpr double kPerKrpm = 1000.0 * kPerRpm;        // [rad/s]
constexpr double kPerDegree = std::numbers::pi / 180.0;
constexpr double kMetresPerMillimetre = 1e-3;

// Allowed ranges of the values in a car file, in the file's units. They are wide enough for a moped and for a lorry.
constexpr haptics::Range kSpeedRpm{50.0, 20000.0};
constexpr haptics::Range kTorquePointRpm{0.0, 20000.0};
constexpr haptics::Range kTorqueNm{0.0, 5000.0};
constexpr haptics::Range kEngineInertia{0.01, 10.0};
constexpr haptics::Range kIdleThrottle{0.1, 100.0};
constexpr haptics::Range kLimiterBandRpm{1.0, 1000.0};
constexpr haptics::Range kStarterNm{1.0, 1000.0};
constexpr haptics::Range kShudderN{0.0, 10.0};

constexpr haptics::Range kCapacityNm{1.0, 10000.0};
constexpr haptics::Range kPedal{0.0, 1.0};
constexpr haptics::Range kDiscInertia{0.0005, 1.0};

constexpr haptics::Range kRatio{0.1, 20.0};
constexpr haptics::Range kDragNm{0.0, 20.0};
constexpr haptics::Range kEfficiency{0.5, 1.0};

constexpr haptics::Range kFriction{0.01, 0.5};
constexpr haptics::Range kRadiusMm{5.0, 200.0};
constexpr haptics::Range kConeDeg{3.0, 20.0};
constexpr haptics::Range kCones{1.0, 4.0};
constexpr haptics::Range kPointingDeg{30.0, 70.0};
constexpr haptics::Range kTeeth{6.0, 120.0};
constexpr haptics::Range kDogRpm{0.5, 100.0};
constexpr haptics::Range kLeverRatio{1.0, 30.0};

constexpr haptics::Range kMassKg{100.0, 60000.0};
constexpr haptics::Range kRotatingKg{0.0, 5000.0};
constexpr haptics::Range kWheelMm{100.0, 1000.0};
constexpr haptics::Range kResistanceN{0.0, 20000.0};
constexpr haptics::Range kResistanceSlope{0.0, 100.0};
constexpr haptics::Range kResistanceSquare{0.0, 20.0};
constexpr haptics::Range kBrakeN{0.0, 1e6};

void read_full_load(const haptics::TomlTable& table, EngineSpec& engine) {
  const std::vector<haptics::TomlTable> points = table.tables("full_load");
  if (points.size() < 2 || points.size() > kMaxTorquePoints)
    table.fail("full_load", fmt::format("must have between 2 and {} points, each {{ rpm = ..., nm = ... }}, but has {}",
                                        kMaxTorquePoints, points.size()));
  for (const haptics::TomlTable& point : points) {
    const double speed = point.number("rpm", kTorquePointRpm) * kPerRpm;
    if (engine.points > 0 && speed <= engine.full_load[engine.points - 1].speed)
      point.fail("rpm", "must be greater than the rpm of the previous point");
    engine.full_load[engine.points++] = {speed, point.number("nm", kTorqueNm)};
    point.reject_unknown_keys();
  }
}

// Reports an error unless the value of `less` is below the value of `more`.
void require_order(const haptics::TomlTable& table, const char* less, const char* more) {
  const haptics::Range any{-1e9, 1e9};
  if (table.number(less, any) >= table.number(more, any)) table.fail(less, fmt::format("must be less than {}", more));
}

void check_engine(const haptics::TomlTable& table, const EngineSpec& engine) {
  require_order(table, "stall_rpm", "idle_rpm");
  require_order(table, "idle_rpm", "shift_from_rpm");
  require_order(table, "shift_from_rpm", "shift_to_rpm");
  require_order(table, "shift_to_rpm", "red_line_rpm");
  require_order(table, "lug_below_rpm", "shift_to_rpm");
  require_order(table, "red_line_rpm", "limiter_rpm");
  if (engine.limiter - engine.limiter_band < engine.idle)
    table.fail("limiter_band_rpm", "must not exceed limiter_rpm minus idle_rpm");
  const double first = engine.full_load[0].speed, last = engine.full_load[engine.points - 1].speed;
  if (first > engine.idle || last < engine.limiter)
    table.fail("full_load",
               fmt::format("must cover all speeds from idle_rpm to limiter_rpm, but covers only {} to {} rpm",
                           haptics::number_text(first / kPerRpm, 3), haptics::number_text(last / kPerRpm, 3)));
}

EngineSpec read_engine(const haptics::TomlTable& table) {
  const auto speed = [&](const char* key) { return table.number(key, kSpeedRpm) * kPerRpm; };
  EngineSpec engine;
  read_full_load(table, engine);
  engine.friction = table.number("friction_nm", kTorqueNm);
  engine.friction_slope = table.number("friction_nm_per_krpm", kTorqueNm) / kPerKrpm;
  engine.friction_square = table.number("friction_nm_per_krpm2", kTorqueNm) / (kPerKrpm * kPerKrpm);
  engine.inertia = table.number("inertia_kgm2", kEngineInertia);
  engine.idle = speed("idle_rpm");
  engine.idle_gain = table.number("idle_throttle_per_krpm", kIdleThrottle) / kPerKrpm;
  engine.stall = speed("stall_rpm");
  engine.red_line = speed("red_line_rpm");
  engine.limiter = speed("limiter_rpm");
  engine.limiter_band = table.number("limiter_band_rpm", kLimiterBandRpm) * kPerRpm;
  engine.starter_torque = table.number("starter_nm", kStarterNm);
  engine.starter_speed = speed("starter_rpm");
  engine.shift_low = speed("shift_from_rpm");
  engine.shift_high = speed("shift_to_rpm");
  engine.lug_below = speed("lug_below_rpm");
  engine.shudder = table.number("shudder_n", kShudderN);
  check_engine(table, engine);
  table.reject_unknown_keys();
  return engine;
}

ClutchSpec read_clutch(const haptics::TomlTable& table) {
  ClutchSpec clutch;
  clutch.capacity = table.number("capacity_nm", kCapacityNm);
  clutch.bite = table.number("bite_pedal", kPedal);
  clutch.closed = table.number("closed_pedal", kPedal);
  clutch.disc_inertia = table.number("disc_inertia_kgm2", kDiscInertia);
  require_order(table, "closed_pedal", "bite_pedal");
  table.reject_unknown_keys();
  return clutch;
}

// Forward ratios must be numbered from 1 without gaps, and decrease.
void read_ratios(const haptics::TomlTable& table, GearboxSpec& gearbox) {
  for (int gear = 1; gear <= haptics::kMaxGear; ++gear) {
    const std::string key = fmt::format("ratio_{}", gear);
    if (gear > 1 && !table.has(key)) continue;
    const std::size_t at = static_cast<std::size_t>(gear - 1);
    gearbox.ratio[at] = table.number(key, kRatio);
    if (gear == 1) continue;
    if (gearbox.ratio[at - 1] == 0.0) table.fail(key, fmt::format("needs ratio_{}, which is missing", gear - 1));
    if (gearbox.ratio[at] >= gearbox.ratio[at - 1])
      table.fail(key, fmt::format("must be less than ratio_{}", gear - 1));
  }
}

GearboxSpec read_gearbox(const haptics::TomlTable& table) {
  GearboxSpec gearbox;
  read_ratios(table, gearbox);
  gearbox.reverse = table.number("ratio_r", kRatio);
  gearbox.final_drive = table.number("final_drive", kRatio);
  gearbox.drag = table.number("drag_nm", kDragNm);
  gearbox.drag_slope = table.number("drag_nm_per_krpm", kDragNm) / kPerKrpm;
  gearbox.efficiency = table.number("efficiency", kEfficiency);
  table.reject_unknown_keys();
  return gearbox;
}

double whole_number(const haptics::TomlTable& table, const char* key, haptics::Range range) {
  const double value = table.number(key, range);
  if (value != std::floor(value)) table.fail(key, "must be a whole number");
  return value;
}

SynchroSpec read_synchro(const haptics::TomlTable& table) {
  SynchroSpec synchro;
  synchro.friction = table.number("friction", kFriction);
  synchro.radius = table.number("radius_mm", kRadiusMm) * kMetresPerMillimetre;
  synchro.cone_angle = table.number("cone_half_angle_deg", kConeDeg) * kPerDegree;
  synchro.cones = whole_number(table, "cones", kCones);
  synchro.index_radius = table.number("index_radius_mm", kRadiusMm) * kMetresPerMillimetre;
  synchro.pointing_angle = table.number("pointing_half_angle_deg", kPointingDeg) * kPerDegree;
  synchro.index_friction = table.number("index_friction", kFriction);
  synchro.teeth = whole_number(table, "teeth", kTeeth);
  synchro.dog_speed = table.number("dog_rpm", kDogRpm) * kPerRpm;
  synchro.lever_ratio = table.number("lever_ratio", kLeverRatio);
  synchro.efficiency = table.number("efficiency", kEfficiency);
  table.reject_unknown_keys();
  return synchro;
}

BodySpec read_body(const haptics::TomlTable& table) {
  BodySpec body;
  body.mass = table.number("mass_kg", kMassKg);
  body.rotating = table.number("rotating_kg", kRotatingKg);
  body.wheel_radius = table.number("wheel_radius_mm", kWheelMm) * kMetresPerMillimetre;
  body.resistance = table.number("resistance_n", kResistanceN);
  body.resistance_slope = table.number("resistance_n_per_mps", kResistanceSlope);
  body.resistance_square = table.number("resistance_n_per_mps2", kResistanceSquare);
  body.brake_force = table.number("brake_n", kBrakeN);
  body.hand_brake_force = table.number("hand_brake_n", kBrakeN);
  table.reject_unknown_keys();
  return body;
}

}  // namespace

CarSpec read_car(const std::filesystem::path& file) {
  return parse_car(haptics::read_text_file(file), file.string());
}

CarSpec parse_car(std::string_view text, const std::string& file_name) {
  CarSpec car;
  car.name = std::filesystem::path(file_name).stem().string();
  car.text = text;
  car.file = file_name;
  const haptics::TomlTable root = haptics::TomlTable::parse(text, file_name);
  car.title = root.text("title");
  car.gate = root.text("gate");
  car.engine = read_engine(root.table("engine"));
  car.clutch = read_clutch(root.table("clutch"));
  car.gearbox = read_gearbox(root.table("gearbox"));
  car.synchro = read_synchro(root.table("synchro"));
  car.body = read_body(root.table("body"));
  root.reject_unknown_keys();
  return car;
}

}  // namespace gearshift::vehicle
