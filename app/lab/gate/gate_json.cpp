#include <cmath>

#include <nlohmann/json.hpp>

#include "app/lab/gate/gate_report.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/lockout.h"

namespace gearshift::lab {
namespace {

using Json = nlohmann::ordered_json;

double kmh(double metres_per_second) {
  return std::round(metres_per_second * haptics::kKmhPerMps * 1e6) / 1e6;
}

Json point_json(glm::dvec2 point) {
  return Json::array({millimetres(point.x), millimetres(point.y)});
}

Json aisles_json(const haptics::GateDescription& list) {
  Json all = Json::array();
  for (const haptics::AisleInfo& aisle : list.aisles) {
    all.push_back({{"name", aisle.name},
                   {"along", axis_name(aisle.horizontal)},
                   {"min_mm", point_json(aisle.min)},
                   {"max_mm", point_json(aisle.max)}});
  }
  return all;
}

Json junctions_json(const GateReport& report) {
  Json all = Json::array();
  for (const haptics::JunctionInfo& junction : report.description.junctions) {
    const bool neutral =
        !haptics::is_mechanism(report.gate) && static_cast<int>(all.size()) == report.gate.neutral_column;
    all.push_back({{"name", junction.name},
                   {"center_mm", point_json(junction.center)},
                   {"open", open_directions(junction)},
                   {"buffer", junction.buffer},
                   {"neutral", neutral}});
  }
  return all;
}

Json walls_json(const haptics::GateDescription& list) {
  Json all = Json::array();
  for (const haptics::WallInfo& wall : list.walls) {
    all.push_back({{"from_mm", point_json(wall.from)},
                   {"to_mm", point_json(wall.to)},
                   {"role", haptics::to_string(wall.role)},
                   {"pair", wall.pair >= 0 ? Json(wall.pair) : Json(nullptr)}});
  }
  return all;
}

Json pairs_json(const haptics::GateDescription& list) {
  Json all = Json::array();
  for (std::size_t i = 0; i < list.wall_pairs.size(); ++i) {
    const PairSize size = pair_size(list, i);
    all.push_back({{"name", list.wall_pairs[i].name},
                   {"along", axis_name(list.wall_pairs[i].horizontal)},
                   {"walls", size.walls},
                   {"width_mm", millimetres(size.width)},
                   {"length_mm", millimetres(size.length)}});
  }
  return all;
}

Json gears_json(const GateReport& report) {
  Json all = Json::array();
  for (const haptics::Slot& slot : haptics::slots(report.gate)) {
    all.push_back({{"name", haptics::gear_label(report.gate, slot.gear)},
                   {"junction", junction_name(report, slot)},
                   {"side", to_string(slot.side)},
                   {"rest_mm", point_json(haptics::rest_position(report.gate, slot.gear))},
                   {"engage_depth_mm", millimetres(slot.engage_depth)},
                   {"release_depth_mm", millimetres(slot.release_depth)},
                   {"end_depth_mm", millimetres(slot.end)},
                   {"pull_out_force_n", report.layout.feel.lock_force}});
  }
  return all;
}

Json places_json(const haptics::Gate& gate) {
  Json all = Json::array();
  for (const haptics::Slot& place : haptics::slots(gate)) {
    all.push_back({{"name", haptics::gear_label(gate, place.gear)},
                   {"at_mm", point_json(place.at)},
                   {"radius_mm", millimetres(place.end)},
                   {"engage_depth_mm", millimetres(place.engage_depth)},
                   {"release_depth_mm", millimetres(place.release_depth)},
                   {"neutral", place.gear == haptics::kNeutralGear}});
  }
  return all;
}

Json lockouts_json(const haptics::Gate& gate) {
  Json all = Json::array();
  for (const haptics::Lockout& lockout : haptics::lockouts(gate)) {
    Json one = {{"gear", haptics::gear_label(gate, haptics::locked_gear(gate, lockout))},
                {"kind", haptics::to_string(lockout.kind)}};
    one["barrier_x_mm"] = lockout.lateral ? Json(millimetres(lockout.barrier)) : Json(nullptr);
    if (lockout.kind == haptics::LockoutKind::after_gear) one["after"] = haptics::gear_name(lockout.after_gear);
    if (haptics::is_mechanism(gate)) one["leaving"] = lockout.is_leaving;
    if (lockout.kind == haptics::LockoutKind::only_after) one["when"] = haptics::describe(lockout);
    if (lockout.kind == haptics::LockoutKind::speed) {
      one["close_above_kmh"] = kmh(lockout.close_above);
      one["open_below_kmh"] = kmh(lockout.open_below);
    }
    all.push_back(one);
  }
  return all;
}

Json buffers_json(const haptics::Gate& gate) {
  Json all = Json::array();
  for (const haptics::Buffer& buffer : haptics::buffers(gate)) {
    all.push_back({{"wall_x_mm", millimetres(buffer.wall)},
                   {"inner_x_mm", millimetres(buffer.inner)},
                   {"force_n", buffer.force}});
  }
  return all;
}

}  // namespace

std::string gate_json(const GateReport& report) {
  Json json;
  json["name"] = report.layout.name;
  json["file"] = report.layout.file;
  json["aisles"] = aisles_json(report.description);
  json["junctions"] = junctions_json(report);
  json["walls"] = walls_json(report.description);
  json["wall_pairs"] = pairs_json(report.description);
  if (haptics::is_mechanism(report.gate))
    json["places"] = places_json(report.gate);
  else
    json["gears"] = gears_json(report);
  json["buffers"] = buffers_json(report.gate);
  json["lockouts"] = lockouts_json(report.gate);
  // Replaces invalid UTF-8, which file names may contain.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gearshift::lab
