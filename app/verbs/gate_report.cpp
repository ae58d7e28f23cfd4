#include "app/verbs/gate_report.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gearshift {
namespace {

using Json = nlohmann::ordered_json;

double mm(double metres) {
  return std::round(metres * 1e9) / 1e6;
}
double kmh(double metres_per_second) {
  return std::round(metres_per_second * 3.6 * 1e6) / 1e6;
}

const Slot& slot_of(const Gate& gate, int index) {
  return gate.slot[static_cast<std::size_t>(index)];
}

std::vector<std::string> open_directions(const JunctionInfo& junction) {
  std::vector<std::string> names;
  if (junction.left) names.emplace_back("left");
  if (junction.right) names.emplace_back("right");
  if (junction.forward) names.emplace_back("forward");
  if (junction.back) names.emplace_back("back");
  return names;
}

const char* direction(bool horizontal) {
  return horizontal ? "select" : "shift";
}

const char* role_name(WallRole role) {
  switch (role) {
    case WallRole::aisle:
      return "aisle";
    case WallRole::chamfer:
      return "chamfer";
    case WallRole::end_stop:
      return "end_stop";
    case WallRole::closed_side:
      return "closed_side";
  }
  return "?";
}

const char* kind_name(LockoutKind kind) {
  switch (kind) {
    case LockoutKind::push_down:
      return "push_down";
    case LockoutKind::lift:
      return "lift";
    case LockoutKind::speed:
      return "speed";
    case LockoutKind::after_gear:
      return "after_gear";
  }
  return "?";
}

std::string lockout_text(const Lockout& lockout) {
  switch (lockout.kind) {
    case LockoutKind::push_down:
      return "opens while the knob is pushed down";
    case LockoutKind::lift:
      return "opens while the ring is lifted";
    case LockoutKind::speed:
      return fmt::format("closes above {} km/h, opens below {} km/h", kmh(lockout.close_above),
                         kmh(lockout.open_below));
    case LockoutKind::after_gear:
      return fmt::format("closed after gear {} until the column is left", gear_name(lockout.after_gear));
  }
  return "?";
}

// The two walls of a pair: how far apart, and over what length they face each other. [m]
struct PairSize {
  double width = 0.0, length = 0.0;
  std::vector<std::size_t> walls;
};

PairSize pair_size(const GateDescription& list, int pair) {
  PairSize size;
  for (std::size_t i = 0; i < list.walls.size(); ++i) {
    if (list.walls[i].pair == pair) size.walls.push_back(i);
  }
  const WallInfo& a = list.walls[size.walls.at(0)];
  const WallInfo& b = list.walls[size.walls.at(1)];
  const bool horizontal = list.wall_pairs[static_cast<std::size_t>(pair)].horizontal;
  const auto along = [&](glm::dvec2 p) { return horizontal ? p.x : p.y; };
  size.width = horizontal ? std::abs(a.from.y - b.from.y) : std::abs(a.from.x - b.from.x);
  const double from = std::max(std::min(along(a.from), along(a.to)), std::min(along(b.from), along(b.to)));
  const double to = std::min(std::max(along(a.from), along(a.to)), std::max(along(b.from), along(b.to)));
  size.length = to - from;
  return size;
}

using Text = std::back_insert_iterator<std::string>;

void add_aisles(Text out, const GateDescription& list) {
  fmt::format_to(out, "\n{:<10}{:<10}{:>20}{:>20}\n", "aisle", "along", "x [mm]", "y [mm]");
  for (const AisleInfo& aisle : list.aisles) {
    const auto span = [](double from, double to) {
      return fmt::format("{:.1f} to {:.1f}", mm(from), mm(to));
    };
    fmt::format_to(out, "{:<10}{:<10}{:>20}{:>20}\n", aisle.name, direction(aisle.horizontal),
                   span(aisle.min.x, aisle.max.x), span(aisle.min.y, aisle.max.y));
  }
}

void add_junctions(Text out, const GateReport& report) {
  fmt::format_to(out, "\n{:<10}{:>8}  {:<28}{}\n", "junction", "x [mm]", "open to", "closed side");
  const auto& junctions = report.description.junctions;
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    const bool neutral = static_cast<int>(i) == report.gate.neutral_column;
    fmt::format_to(out, "{:<10}{:>8.1f}  {:<28}{}{}\n", junctions[i].name, mm(junctions[i].center.x),
                   fmt::format("{}", fmt::join(open_directions(junctions[i]), ", ")),
                   junctions[i].buffer ? "buffer" : "-", neutral ? ", the lever returns here" : "");
  }
}

void add_gears(Text out, const GateReport& report) {
  fmt::format_to(out, "\n{:<6}{:<10}{:<10}{:>10}{:>12}{:>12}{:>12}{:>14}\n", "gear", "junction", "side",
                 "rest [mm]", "counts from", "released at", "end [mm]", "pull-out [N]");
  for (int i = 0; i < report.gate.slot_count; ++i) {
    const Slot& slot = slot_of(report.gate, i);
    fmt::format_to(out, "{:<6}{:<10}{:<10}{:>10.1f}{:>12.1f}{:>12.1f}{:>12.1f}{:>14.1f}\n",
                   gear_name(slot.gear),
                   report.description.junctions[static_cast<std::size_t>(slot.column)].name,
                   slot.side == Side::forward ? "forward" : "back", mm(slot.rest), mm(slot.engage_depth),
                   mm(slot.release_depth), mm(slot.end), report.layout.feel.lock_force);
  }
}

void add_pairs(Text out, const GateDescription& list) {
  fmt::format_to(out, "\n{:<6}{:<12}{:<10}{:>12}{:>13}\n", "pair", "between", "along", "width [mm]",
                 "length [mm]");
  for (std::size_t i = 0; i < list.wall_pairs.size(); ++i) {
    const PairSize size = pair_size(list, static_cast<int>(i));
    fmt::format_to(out, "{:<6}{:<12}{:<10}{:>12.1f}{:>13.1f}\n", i + 1, list.wall_pairs[i].name,
                   direction(list.wall_pairs[i].horizontal), mm(size.width), mm(size.length));
  }
}

void add_lockouts(Text out, const Gate& gate) {
  if (gate.lockout_count == 0) return;
  fmt::format_to(out, "\n{:<10}{:<34}{}\n", "lockout", "where", "when");
  for (int i = 0; i < gate.lockout_count; ++i) {
    const Lockout& lockout = gate.lockout[static_cast<std::size_t>(i)];
    const std::string where = lockout.lateral
                                  ? fmt::format("across the aisle at x = {:.1f} mm", mm(lockout.barrier))
                                  : "in the mouth of the slot";
    fmt::format_to(out, "{:<10}{:<34}{}\n", gear_name(slot_of(gate, lockout.slot).gear), where,
                   lockout_text(lockout));
  }
}

Json point_json(glm::dvec2 point) {
  return Json::array({mm(point.x), mm(point.y)});
}

Json aisles_json(const GateDescription& list) {
  Json all = Json::array();
  for (const AisleInfo& aisle : list.aisles) {
    all.push_back({{"name", aisle.name},
                   {"along", direction(aisle.horizontal)},
                   {"min_mm", point_json(aisle.min)},
                   {"max_mm", point_json(aisle.max)}});
  }
  return all;
}

Json junctions_json(const GateReport& report) {
  Json all = Json::array();
  for (const JunctionInfo& junction : report.description.junctions) {
    const bool neutral = static_cast<int>(all.size()) == report.gate.neutral_column;
    all.push_back({{"name", junction.name},
                   {"center_mm", point_json(junction.center)},
                   {"open", open_directions(junction)},
                   {"buffer", junction.buffer},
                   {"neutral", neutral}});
  }
  return all;
}

Json walls_json(const GateDescription& list) {
  Json all = Json::array();
  for (const WallInfo& wall : list.walls) {
    all.push_back({{"from_mm", point_json(wall.from)},
                   {"to_mm", point_json(wall.to)},
                   {"role", role_name(wall.role)},
                   {"pair", wall.pair >= 0 ? Json(wall.pair) : Json(nullptr)}});
  }
  return all;
}

Json pairs_json(const GateDescription& list) {
  Json all = Json::array();
  for (std::size_t i = 0; i < list.wall_pairs.size(); ++i) {
    const PairSize size = pair_size(list, static_cast<int>(i));
    all.push_back({{"name", list.wall_pairs[i].name},
                   {"along", direction(list.wall_pairs[i].horizontal)},
                   {"walls", size.walls},
                   {"width_mm", mm(size.width)},
                   {"length_mm", mm(size.length)}});
  }
  return all;
}

Json gears_json(const GateReport& report) {
  Json all = Json::array();
  for (int i = 0; i < report.gate.slot_count; ++i) {
    const Slot& slot = slot_of(report.gate, i);
    all.push_back({{"name", gear_name(slot.gear)},
                   {"junction", report.description.junctions[static_cast<std::size_t>(slot.column)].name},
                   {"side", slot.side == Side::forward ? "forward" : "back"},
                   {"rest_mm", point_json(rest_position(report.gate, slot.gear))},
                   {"engage_depth_mm", mm(slot.engage_depth)},
                   {"release_depth_mm", mm(slot.release_depth)},
                   {"end_depth_mm", mm(slot.end)},
                   {"pull_out_force_n", report.layout.feel.lock_force}});
  }
  return all;
}

Json lockouts_json(const Gate& gate) {
  Json all = Json::array();
  for (int i = 0; i < gate.lockout_count; ++i) {
    const Lockout& lockout = gate.lockout[static_cast<std::size_t>(i)];
    Json one = {{"gear", gear_name(slot_of(gate, lockout.slot).gear)}, {"kind", kind_name(lockout.kind)}};
    one["barrier_x_mm"] = lockout.lateral ? Json(mm(lockout.barrier)) : Json(nullptr);
    if (lockout.kind == LockoutKind::after_gear) one["after"] = gear_name(lockout.after_gear);
    if (lockout.kind == LockoutKind::speed) {
      one["close_above_kmh"] = kmh(lockout.close_above);
      one["open_below_kmh"] = kmh(lockout.open_below);
    }
    all.push_back(one);
  }
  return all;
}

Json buffers_json(const Gate& gate) {
  Json all = Json::array();
  for (int i = 0; i < gate.buffer_count; ++i) {
    const Buffer& buffer = gate.buffer[static_cast<std::size_t>(i)];
    all.push_back(
        {{"wall_x_mm", mm(buffer.wall)}, {"inner_x_mm", mm(buffer.inner)}, {"force_n", buffer.force}});
  }
  return all;
}

}  // namespace

std::string gate_table(const GateReport& report) {
  const GateDescription& list = report.description;
  std::string text;
  const Text out(text);
  fmt::format_to(out, "{} ({})\n", report.layout.name, report.layout.file);
  fmt::format_to(out, "{} aisles, {} junctions, {} wall pairs, {} gears, {} lockouts\n", list.aisles.size(),
                 list.junctions.size(), list.wall_pairs.size(), report.gate.slot_count,
                 report.gate.lockout_count);
  add_aisles(out, list);
  add_junctions(out, report);
  add_gears(out, report);
  add_pairs(out, list);
  add_lockouts(out, report.gate);
  return text;
}

std::string gate_json(const GateReport& report) {
  Json json;
  json["name"] = report.layout.name;
  json["file"] = report.layout.file;
  json["aisles"] = aisles_json(report.description);
  json["junctions"] = junctions_json(report);
  json["walls"] = walls_json(report.description);
  json["wall_pairs"] = pairs_json(report.description);
  json["gears"] = gears_json(report);
  json["buffers"] = buffers_json(report.gate);
  json["lockouts"] = lockouts_json(report.gate);
  // A file's name need not be UTF-8: show what cannot be shown as a replacement character.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gearshift
