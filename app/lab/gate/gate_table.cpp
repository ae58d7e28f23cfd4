#include <iterator>

#include <fmt/format.h>

#include "app/lab/gate/gate_report.h"
#include "haptics/gate/lockout.h"

namespace gearshift::lab {
namespace {

using Text = std::back_insert_iterator<std::string>;

void add_aisles(Text out, const haptics::GateDescription& list) {
  fmt::format_to(out, "\n{:<10}{:<10}{:>20}{:>20}\n", "aisle", "along", "x [mm]", "y [mm]");
  for (const haptics::AisleInfo& aisle : list.aisles) {
    const auto span = [](double from, double to) {
      return fmt::format("{:.1f} to {:.1f}", millimetres(from), millimetres(to));
    };
    fmt::format_to(out, "{:<10}{:<10}{:>20}{:>20}\n", aisle.name, axis_name(aisle.horizontal),
                   span(aisle.min.x, aisle.max.x), span(aisle.min.y, aisle.max.y));
  }
}

void add_junctions(Text out, const GateReport& report) {
  fmt::format_to(out, "\n{:<10}{:>8}  {:<28}{}\n", "junction", "x [mm]", "open to", "closed side");
  const auto& junctions = report.description.junctions;
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    const bool neutral = static_cast<int>(i) == report.gate.neutral_column;
    fmt::format_to(out, "{:<10}{:>8.1f}  {:<28}{}{}\n", junctions[i].name, millimetres(junctions[i].center.x),
                   fmt::format("{}", fmt::join(open_directions(junctions[i]), ", ")),
                   junctions[i].buffer ? "buffer" : "-", neutral ? ", neutral: the lever returns here" : "");
  }
}

void add_gears(Text out, const GateReport& report) {
  fmt::format_to(out, "\n{:<6}{:<10}{:<10}{:>10}{:>12}{:>12}{:>12}{:>14}\n", "gear", "junction", "side", "rest [mm]",
                 "engages at", "releases at", "end [mm]", "pull-out [N]");
  for (const haptics::Slot& slot : haptics::slots(report.gate)) {
    fmt::format_to(out, "{:<6}{:<10}{:<10}{:>10.1f}{:>12.1f}{:>12.1f}{:>12.1f}{:>14.1f}\n",
                   haptics::gear_name(slot.gear), junction_name(report, slot), to_string(slot.side),
                   millimetres(slot.rest), millimetres(slot.engage_depth), millimetres(slot.release_depth),
                   millimetres(slot.end), haptics::is_sequential(report.gate) ? 0.0 : report.layout.feel.lock_force);
  }
  if (!haptics::is_sequential(report.gate)) return;
  fmt::format_to(out, "one stroke is one gear: {} N", haptics::gear_name(haptics::kReverseGear));
  for (int gear = 1; gear <= report.gate.sequential_gears; ++gear) fmt::format_to(out, " {}", gear);
  fmt::format_to(out, "\n");
}

void add_pairs(Text out, const haptics::GateDescription& list) {
  fmt::format_to(out, "\n{:<6}{:<12}{:<10}{:>12}{:>13}\n", "pair", "between", "along", "width [mm]", "length [mm]");
  for (std::size_t i = 0; i < list.wall_pairs.size(); ++i) {
    const PairSize size = pair_size(list, i);
    fmt::format_to(out, "{:<6}{:<12}{:<10}{:>12.1f}{:>13.1f}\n", i + 1, list.wall_pairs[i].name,
                   axis_name(list.wall_pairs[i].horizontal), millimetres(size.width), millimetres(size.length));
  }
}

void add_lockouts(Text out, const haptics::Gate& gate) {
  if (gate.lockout_count == 0) return;
  fmt::format_to(out, "\n{:<10}{:<34}{}\n", "lockout", "where", "when");
  for (const haptics::Lockout& lockout : haptics::lockouts(gate)) {
    const std::string where = lockout.lateral
                                  ? fmt::format("across the aisle at x = {:.1f} mm", millimetres(lockout.barrier))
                                  : "in the mouth of the slot";
    fmt::format_to(out, "{:<10}{:<34}{}\n", haptics::gear_name(haptics::locked_gear(gate, lockout)), where,
                   haptics::describe(lockout));
  }
}

}  // namespace

std::string gate_table(const GateReport& report) {
  const haptics::GateDescription& list = report.description;
  std::string text;
  const Text out(text);
  fmt::format_to(out, "{} ({})\n", report.layout.name, report.layout.file);
  fmt::format_to(out, "{} aisles, {} junctions, {} wall pairs, {} gears, {} lockouts\n", list.aisles.size(),
                 list.junctions.size(), list.wall_pairs.size(),
                 haptics::is_sequential(report.gate) ? report.gate.sequential_gears + 1 : report.gate.slot_count,
                 report.gate.lockout_count);
  add_aisles(out, list);
  add_junctions(out, report);
  add_gears(out, report);
  add_pairs(out, list);
  add_lockouts(out, report.gate);
  return text;
}

}  // namespace gearshift::lab
