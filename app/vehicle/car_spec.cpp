#include "app/vehicle/car_spec.h"

#include <vector>

#include <fmt/format.h>

#include "haptics/files/number_text.h"
#include "haptics/files/parameter_file.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::vehicle {
namespace {

constexpr haptics::Range kTorquePointRpm{0.0, 20000.0};
constexpr haptics::Range kTorqueNm{0.0, 5000.0};
constexpr haptics::Range kRatio{0.1, 20.0};

void read_full_load(const haptics::TomlTable& table, EngineSpec& engine) {
  const std::vector<haptics::TomlTable> points = table.tables("full_load");
  if (points.size() < 2 || points.size() > kMaxTorquePoints)
    table.fail("full_load", fmt::format("must have between 2 and {} points, each {{ rpm = ..., nm = ... }}, but has {}",
                                        kMaxTorquePoints, points.size()));
  for (const haptics::TomlTable& point : points) {
    const double speed = point.number("rpm", kTorquePointRpm) * haptics::kTurnPerMinute;
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
                           haptics::number_text(first / haptics::kTurnPerMinute, 3),
                           haptics::number_text(last / haptics::kTurnPerMinute, 3)));
}

EngineSpec read_engine(const haptics::TomlTable& table) {
  EngineSpec engine;
  read_full_load(table, engine);
  haptics::read_parameters(table, engine, haptics::Missing::error);
  check_engine(table, engine);
  table.reject_unknown_keys();
  return engine;
}

ClutchSpec read_clutch(const haptics::TomlTable& table) {
  ClutchSpec clutch;
  haptics::read_parameters(table, clutch, haptics::Missing::error);
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
  haptics::read_parameters(table, gearbox, haptics::Missing::error);
  table.reject_unknown_keys();
  return gearbox;
}

template <class Spec>
Spec read_section(const haptics::TomlTable& table) {
  Spec spec;
  haptics::read_parameters(table, spec, haptics::Missing::error);
  table.reject_unknown_keys();
  return spec;
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
  haptics::read_parameters(root, car);
  car.engine = read_engine(root.table("engine"));
  car.clutch = read_clutch(root.table("clutch"));
  car.gearbox = read_gearbox(root.table("gearbox"));
  car.synchro = read_section<SynchroSpec>(root.table("synchro"));
  car.body = read_section<BodySpec>(root.table("body"));
  root.reject_unknown_keys();
  return car;
}

}  // namespace gearshift::vehicle
