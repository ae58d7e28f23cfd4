#include <algorithm>
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
  const bool is_column = !haptics::is_mechanism(report.gate);
  const bool returns = report.layout.feel.center_force > 0.0;
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    const bool neutral = is_column && static_cast<int>(i) == report.gate.neutral_column;
    fmt::format_to(
        out, "{:<10}{:>8.1f}  {:<28}{}{}\n", junctions[i].name, millimetres(junctions[i].center.x),
        fmt::format("{}", fmt::join(open_directions(junctions[i]), ", ")), junctions[i].buffer ? "buffer" : "-",
        neutral ? (returns ? ", neutral: the lever returns here" : ", neutral: nothing returns the lever") : "");
  }
}

void add_gears(Text out, const GateReport& report) {
  fmt::format_to(out, "\n{:<6}{:<10}{:<10}{:>10}{:>12}{:>12}{:>12}{:>14}\n", "gear", "junction", "side", "rest [mm]",
                 "engages at", "releases at", "end [mm]", "pull-out [N]");
  for (const haptics::Slot& slot : haptics::slots(report.gate)) {
    fmt::format_to(out, "{:<6}{:<10}{:<10}{:>10.1f}{:>12.1f}{:>12.1f}{:>12.1f}{:>14.1f}\n",
                   haptics::gear_label(report.gate, slot.gear), junction_name(report, slot), to_string(slot.side),
                   millimetres(slot.rest), millimetres(slot.engage_depth), millimetres(slot.release_depth),
                   millimetres(slot.end), haptics::is_sequential(report.gate) ? 0.0 : report.layout.feel.lock_force);
  }
  if (!haptics::is_sequential(report.gate)) return;
  fmt::format_to(out, "one stroke is one gear: {} N", haptics::gear_name(haptics::kReverseGear));
  for (int gear = 1; gear <= report.gate.sequential_gears; ++gear) fmt::format_to(out, " {}", gear);
  fmt::format_to(out, "\n");
}

// The places of a mechanism.
void add_places(Text out, const haptics::Gate& gate) {
  fmt::format_to(out, "\n{:<10}{:>10}{:>10}{:>14}{:>16}{:>16}{:>12}\n", "place", "x [mm]", "y [mm]", "radius [mm]",
                 "engages within", "releases beyond", "detent [N]");
  for (const haptics::Slot& place : haptics::slots(gate)) {
    double lock = 0.0;
    for (double depth = 0.0; depth < place.end; depth += 1e-5)
      lock = std::max(lock, haptics::feel_force(place.feel, depth));
    fmt::format_to(out, "{:<10}{:>10.1f}{:>10.1f}{:>14.1f}{:>16.1f}{:>16.1f}{:>12.1f}{}\n",
                   haptics::gear_label(gate, place.gear), millimetres(place.at.x), millimetres(place.at.y),
                   millimetres(place.end), millimetres(place.end - place.engage_depth),
                   millimetres(place.end - place.release_depth), lock,
                   place.gear == haptics::kNeutralGear ? "  neutral" : "");
  }
}

void add_pairs(Text out, const haptics::GateDescription& list) {
  fmt::format_to(out, "\n{:<6}{:<12}{:<10}{:>12}{:>13}\n", "pair", "between", "along", "width [mm]", "length [mm]");
  for (std::size_t i = 0; i < list.wall_pairs.size(); ++i) {
    const PairSize size = pair_size(list, i);
    fmt::format_to(out, "{:<6}{:<12}{:<10}{:>12.1f}{:>13.1f}\n", i + 1, list.wall_pairs[i].name,
                   axis_name(list.wall_pairs[i].horizontal), millimetres(size.width), millimetres(size.length));
  }
}

std::string place_of_lockout(const haptics::Gate& gate, const haptics::Lockout& lockout) {
  if (haptics::is_mechanism(gate)) return lockout.is_leaving ? "on the way out of the place" : "round the place";
  if (!lockout.lateral) return "in the mouth of the slot";
  return fmt::format("across the aisle at x = {:.1f} mm", millimetres(lockout.barrier));
}

void add_lockouts(Text out, const haptics::Gate& gate) {
  if (gate.lockout_count == 0) return;
  fmt::format_to(out, "\n{:<10}{:<34}{}\n", "lockout", "where", "when");
  for (const haptics::Lockout& lockout : haptics::lockouts(gate)) {
    fmt::format_to(out, "{:<10}{:<34}{}\n", haptics::gear_label(gate, haptics::locked_gear(gate, lockout)),
                   place_of_lockout(gate, lockout), haptics::describe(lockout));
  }
}

}  // namespace

std::string gate_table(const GateReport& report) {
  const haptics::GateDescription& list = report.description;
  std::string text;
  const Text out(text);
  fmt::format_to(out, "{} ({})\n", report.layout.name, report.layout.file);
  fmt::format_to(out, "{} aisles, {} junctions, {} wall pairs, {} {}, {} lockouts\n", list.aisles.size(),
                 list.junctions.size(), list.wall_pairs.size(),
                 haptics::is_sequential(report.gate) ? report.gate.sequential_gears + 1 : report.gate.slot_count,
                 haptics::is_mechanism(report.gate) ? "places" : "gears", report.gate.lockout_count);
  add_aisles(out, list);
  add_junctions(out, report);
  if (haptics::is_mechanism(report.gate))
    add_places(out, report.gate);
  else
    add_gears(out, report);
  add_pairs(out, list);
  add_lockouts(out, report.gate);
  return text;
}

}  // namespace gearshift::lab
