#include "app/verbs/campaign_words.h"

#include <cstddef>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/energy_words.h"
#include "app/hold_words.h"

namespace gearshift {
namespace {

constexpr std::size_t kMostListed = 20;  // failures that are printed; the JSON has them all

std::string law_row(CampaignLaw law, const LawSummary& seen) {
  const LawWords& words = law_words(law);
  const std::string name(words.name), says(words.says);
  if (seen.cases == 0) return fmt::format("| {} | {} | 0 | - | - | - | - |\n", name, says);
  return fmt::format("| {} | {} | {} | {:.4g} {} | {:.4g} | {} | {} |\n", name, says, seen.cases, seen.worst.value,
                     std::string(words.unit), seen.worst.bound, seen.worst_case, seen.broken);
}

std::string laws_text(const CampaignSummary& summary) {
  std::string text = "| law | says | cases | worst | bound | in case | broken in |\n|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < kCampaignLaws; ++i) text += law_row(static_cast<CampaignLaw>(i), summary.laws[i]);
  return text;
}

std::string groups_text(const CampaignSummary& summary) {
  std::string text =
      "| drawn | | cases | shifts | gear meant is in | wall softened in | stopped by the guard in | tuning limited in "
      "| a law broken in |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const CaseGroup& group : summary.groups) {
    const double reached =
        group.shifts > 0 ? 100.0 * static_cast<double>(group.reached) / static_cast<double>(group.shifts) : 0.0;
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", group.of, group.name, group.cases,
                        group.shifts, group.shifts > 0 ? fmt::format("{:.2f} %", reached) : "-", group.softened,
                        group.stopped, group.limited, group.failed);
  }
  return text;
}

std::string ripple_text(const CampaignSummary& summary, bool promised) {
  std::string text = "| rate | delay | cases | median mm | p95 mm | worst mm |\n|---|---|---|---|---|---|\n";
  for (const RippleCell& cell : summary.ripple)
    if (cell.promised == promised)
      text += fmt::format("| {:g} to {:g} Hz | {}{} | {} | {:.3f} | {:.3f} | {:.3f} |\n", cell.slowest, cell.fastest,
                          cell.delay, cell.delay == 4 ? " to 8" : "", cell.cases, 1e3 * cell.median, 1e3 * cell.p95,
                          1e3 * cell.most);
  return text;
}

std::string failures_text(const CampaignSummary& summary) {
  if (summary.broken.empty()) return "No law was broken.\n";
  std::string text = "| case | seed | law | value | bound | at s |\n|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < summary.broken.size() && i < kMostListed; ++i) {
    const LawBroken& one = summary.broken[i];
    text += fmt::format("| {} | {:016x} | {} | {:.4g} | {:.4g} | {:.3f} |\n", one.number, one.seed,
                        std::string(law_words(one.law).name), one.seen.value, one.seen.bound, one.seen.time);
  }
  if (summary.broken.size() > kMostListed)
    text += fmt::format("\nand {} more in summary.json\n", summary.broken.size() - kMostListed);
  return text;
}

std::string refusals_text(const CampaignSummary& summary) {
  std::string text;
  for (const auto& [why, times] : summary.refusals) text += fmt::format("- refused {} times: {}\n", times, why);
  return text;
}

nlohmann::ordered_json seen_json(const LawSeen& seen) {
  return {{"value", seen.value}, {"bound", seen.bound}, {"at_s", seen.time}};
}

}  // namespace

std::string campaign_text(const CampaignSummary& summary) {
  return fmt::format(
             "{} shifts in {} cases of seed {}: {} cycles, {:.1f} hours simulated; {} clean aims of a gripping hand; "
             "{} "
             "cases refused by the loop's own checks\n\n",
             summary.shifts, summary.cases, summary.seed, summary.cycles, summary.seconds / 3600.0, summary.clean,
             summary.refused) +
         laws_text(summary) + "\n" + failures_text(summary) + "\n" + groups_text(summary) +
         "\nHeld still, back and forth in the last 0.5 s of 3, where quiet is promised:\n\n" +
         ripple_text(summary, true) + "\nWhere it is not:\n\n" + ripple_text(summary, false) + "\n" +
         refusals_text(summary);
}

std::string campaign_json(const CampaignSummary& summary, const std::string& program) {
  nlohmann::ordered_json json{{"program", program},         {"seed", summary.seed},      {"cases", summary.cases},
                              {"refused", summary.refused}, {"shifts", summary.shifts},  {"clean", summary.clean},
                              {"cycles", summary.cycles},   {"seconds", summary.seconds}};
  for (std::size_t i = 0; i < kCampaignLaws; ++i) {
    const LawSummary& law = summary.laws[i];
    const LawWords& words = law_words(static_cast<CampaignLaw>(i));
    json["laws"].push_back({{"name", words.name},
                            {"says", words.says},
                            {"unit", words.unit},
                            {"cases", law.cases},
                            {"looks", law.looks},
                            {"broken", law.broken},
                            {"worst", seen_json(law.worst)},
                            {"worst_case", law.worst_case}});
  }
  json["failures"] = nlohmann::ordered_json::array();
  for (const LawBroken& one : summary.broken)
    json["failures"].push_back({{"case", one.number},
                                {"seed", fmt::format("{:016x}", one.seed)},
                                {"law", law_words(one.law).name},
                                {"seen", seen_json(one.seen)}});
  for (const CaseGroup& group : summary.groups)
    json["drawn"].push_back({{"of", group.of},
                             {"name", group.name},
                             {"cases", group.cases},
                             {"shifts", group.shifts},
                             {"reached", group.reached},
                             {"softened", group.softened},
                             {"stopped", group.stopped},
                             {"limited", group.limited},
                             {"failed", group.failed}});
  for (const RippleCell& cell : summary.ripple)
    json["ripple"].push_back({{"from_hz", cell.slowest},
                              {"to_hz", cell.fastest},
                              {"delay", cell.delay},
                              {"promised", cell.promised},
                              {"cases", cell.cases},
                              {"median_m", cell.median},
                              {"p95_m", cell.p95},
                              {"most_m", cell.most}});
  for (const auto& [why, times] : summary.refusals) json["refusals"].push_back({{"why", why}, {"times", times}});
  return json.dump(2) + "\n";
}

std::string case_text(const CampaignCase& drawn, const CaseOutcome& outcome) {
  const HapticConfig& haptics = drawn.haptics;
  std::string text = fmt::format(
      "case {}, seed {:016x}: {} hand ({:.3g} kg, {:.3g} N s/m, {:.4g} N/m), {} gate, {}{:.1f} Hz, delay {}, jitter "
      "{:.1f} "
      "%, plant error {:.1f} %, count {:.1f} um, {}, {}, K {:.0f} N/m wanted, {:.0f} used, last push {:.0f} "
      "N\n",
      drawn.number, drawn.seed, std::string(kCaseHandNames[static_cast<std::size_t>(drawn.hand)]),
      drawn.lever.hand.mass, drawn.lever.hand.damping, drawn.lever.hand.stiffness,
      drawn.shipped_gate >= 0 ? "shipped" : "random", drawn.has_car ? "a car behind it, " : "", haptics.rate,
      drawn.lever.delay, 100.0 * drawn.lever.period_jitter, 100.0 * drawn.lever.model_error, 1e6 * count_of(drawn),
      hold_words(haptics.contact.hold), energy_words(haptics.contact.energy_control), haptics.tuning.wall_stiffness,
      outcome.stiffness, drawn.manner.last_push);
  if (!outcome.refused.empty()) return text + "refused: " + outcome.refused + "\n";
  text += fmt::format("{} of {} shifts reached, wall softened {} times, {:.1f} s\n", outcome.reached, outcome.shifts,
                      outcome.softened, outcome.seconds);
  for (std::size_t i = 0; i < kCampaignLaws; ++i) {
    const LawSeen& seen = outcome.laws.seen(static_cast<CampaignLaw>(i));
    const LawWords& words = law_words(static_cast<CampaignLaw>(i));
    if (seen.looks == 0) continue;
    text += fmt::format("{:<10} {:>10.4g} {:<14} bound {:<10.4g} at {:>8.3f} s  {}\n", std::string(words.name),
                        seen.value, std::string(words.unit), seen.bound, seen.time, seen.broken() ? "BROKEN" : "");
  }
  return text;
}

}  // namespace gearshift
