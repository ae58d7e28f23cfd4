#include "app/lab/drive/drive_output.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/base/csv.h"
#include "app/lessons/report/report_json.h"

namespace gearshift::lab {
namespace {

using Json = nlohmann::ordered_json;
using Sample = vehicle::DriveSample;

constexpr double kPerRpm = 1.0 / haptics::kTurnPerMinute;

struct Column {
  const char* name;
  double (*value)(const Sample&);
};

// The numbers and flags of a sample; `gear` and, in CSV, `event` stand beside them.
constexpr Column kSampleColumns[] = {
    {"time_s", [](const Sample& s) { return s.time(); }},
    {"engine_rpm", [](const Sample& s) { return kPerRpm * s.car.engine_speed; }},
    {"road_speed_km_per_h", [](const Sample& s) { return haptics::kKmhPerMps * s.car.road_speed; }},
    {"distance_m", [](const Sample& s) { return s.car.distance; }},
    {"clutch_torque_nm", [](const Sample& s) { return s.car.clutch_torque; }},
    {"clutch_temperature_c", [](const Sample& s) { return s.car.clutch_temperature; }},
    {"running", [](const Sample& s) { return s.car.running ? 1.0 : 0.0; }},
    {"stalled", [](const Sample& s) { return s.car.stalled ? 1.0 : 0.0; }},
    {"acceleration_m_per_s2", [](const Sample& s) { return s.car.acceleration; }},
    {"engine_load", [](const Sample& s) { return s.car.engine_load; }},
    {"shaft_rpm", [](const Sample& s) { return kPerRpm * s.car.shaft_speed; }},
    {"clutch_capacity_nm", [](const Sample& s) { return s.car.clutch_capacity; }},
    {"clutch_locked", [](const Sample& s) { return s.car.clutch_locked ? 1.0 : 0.0; }},
    {"slip_power_w", [](const Sample& s) { return s.car.slip_power; }},
    {"slip_energy_j", [](const Sample& s) { return s.car.slip_energy; }},
    {"drive_torque_nm", [](const Sample& s) { return s.car.drive_torque; }},
    {"dog_difference_rpm", [](const Sample& s) { return kPerRpm * s.car.dog_difference; }},
    {"ring_blocks", [](const Sample& s) { return s.car.sync == vehicle::SyncPhase::synchronising ? 1.0 : 0.0; }},
    {"grinding", [](const Sample& s) { return s.car.grinding ? 1.0 : 0.0; }},
    {"throttle", [](const Sample& s) { return s.controls.pedals.throttle; }},
    {"brake", [](const Sample& s) { return s.controls.pedals.brake; }},
    {"clutch", [](const Sample& s) { return s.controls.pedals.clutch; }},
    {"hand_brake", [](const Sample& s) { return s.controls.pedals.hand_brake; }},
    {"slope_percent", [](const Sample& s) { return 100.0 * std::tan(s.controls.slope); }},
    {"lever_x_mm", [](const Sample& s) { return 1e3 * s.lever.lever.x; }},
    {"lever_y_mm", [](const Sample& s) { return 1e3 * s.lever.lever.y; }},
    {"push_x_n", [](const Sample& s) { return s.lever.f_h.x; }},
    {"push_y_n", [](const Sample& s) { return s.lever.f_h.y; }},
};

// Something that happened, as a sentence.
struct Happening {
  double time = 0.0;  // [s]
  std::string text;
};

std::string shift_text(const lessons::ShiftRecord& shift) {
  return fmt::format("shift {} to {} in {:.2f} s{}", haptics::gear_name(shift.from), haptics::gear_name(shift.to),
                     shift.end - shift.begin, shift.missed ? ", missed" : "");
}

std::vector<Happening> happenings(const ScriptedDrive& drive) {
  std::vector<Happening> all;
  for (const haptics::HapticEvent& event : drive.events)
    all.push_back({1e-9 * static_cast<double>(event.time_ns), haptics::describe(event)});
  for (const lessons::ShiftRecord& shift : drive.shifts) all.push_back({shift.end, shift_text(shift)});
  for (const lessons::DrivingError& error : drive.errors)
    all.push_back({error.time, fmt::format("{}: {}", to_string(error.kind), lessons::error_sentence(error))});
  std::stable_sort(all.begin(), all.end(), [](const Happening& a, const Happening& b) { return a.time < b.time; });
  return all;
}

}  // namespace

std::string drive_csv(const ScriptedDrive& drive) {
  base::CsvTable table;
  for (const Column& column : kSampleColumns) table.text(column.name);
  table.texts({"gear", "event"});
  table.end();
  const std::vector<Happening> all = happenings(drive);
  std::size_t next = 0;
  for (const Sample& sample : drive.samples) {
    for (const Column& column : kSampleColumns) table.number(column.value(sample));
    table.text(haptics::gear_name(sample.car.gear));
    std::string events;
    const bool is_last = &sample == &drive.samples.back();
    for (; next < all.size() && (is_last || all[next].time <= sample.time()); ++next)
      events += (events.empty() ? "" : "; ") + all[next].text;
    table.text(events).end();
  }
  return std::move(table).take();
}

std::string drive_json(const ScriptedDrive& drive, const DriveNames& names) {
  Json json{{"car", names.car}, {"gate", names.gate}, {"script", names.script}};
  json["samples"] = json["events"] = json["shifts"] = json["errors"] = Json::array();
  for (const Sample& sample : drive.samples) {
    Json row = Json::object();
    for (const Column& column : kSampleColumns) row[column.name] = column.value(sample) + 0.0;
    row["gear"] = haptics::gear_name(sample.car.gear);
    json["samples"].push_back(std::move(row));
  }
  for (const haptics::HapticEvent& event : drive.events)
    json["events"].push_back(
        {{"time_s", 1e-9 * static_cast<double>(event.time_ns)}, {"event", haptics::describe(event)}});
  for (const lessons::ShiftRecord& shift : drive.shifts) json["shifts"].push_back(lessons::shift_json(shift));
  for (const lessons::DrivingError& error : drive.errors) json["errors"].push_back(lessons::error_json(error));
  return json.dump(1) + "\n";
}

std::string drive_text(const ScriptedDrive& drive, const DriveNames& names) {
  std::string text = fmt::format("{}, gate {}, script {}\n", names.car, names.gate, names.script);
  for (const Happening& one : happenings(drive)) text += fmt::format("{:8.2f} s  {}\n", one.time, one.text);
  const Sample& end = drive.samples.back();
  return text +
         fmt::format("{:8.2f} s  end: {:.1f} km/h, {:.0f} rpm, gear {}, engine {}, {:.1f} m, {:.2f} kJ in the clutch\n",
                     end.time(), haptics::kKmhPerMps * end.car.road_speed, kPerRpm * end.car.engine_speed,
                     haptics::gear_name(end.car.gear),
                     end.car.running   ? "on"
                     : end.car.stalled ? "stalled"
                                       : "off",
                     end.car.distance, 1e-3 * end.car.slip_energy);
}

}  // namespace gearshift::lab
