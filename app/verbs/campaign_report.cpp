#include "app/verbs/campaign_report.h"

#include <cstddef>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "haptics/contact/virtual_coupling.h"
#include "haptics/safety/energy_control.h"

namespace gearshift::verbs {
namespace {

constexpr std::size_t kMaxListedFailures = 20;  // maximum number of printed failures; the JSON contains all failures

std::string law_row(lab::CampaignLaw law, const lab::LawSummary& summary) {
  const lab::LawText& law_info = lab::law_text(law);
  const std::string name(law_info.name), requirement(law_info.requirement);
  if (summary.cases == 0) return fmt::format("| {} | {} | 0 | - | - | - | - |\n", name, requirement);
  return fmt::format("| {} | {} | {} | {:.4g} {} | {:.4g} | {} | {} |\n", name, requirement, summary.cases,
                     summary.worst.value, std::string(law_info.unit), summary.worst.bound, summary.worst_case,
                     summary.broken);
}

std::string laws_text(const lab::CampaignSummary& summary) {
  std::string text =
      "| law | requirement | cases | worst value | bound | worst case | cases that break the law "
      "|\n|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < lab::kCampaignLaws; ++i)
    text += law_row(static_cast<lab::CampaignLaw>(i), summary.laws[i]);
  return text;
}

std::string groups_text(const lab::CampaignSummary& summary) {
  std::string text =
      "| random property | value | cases | shifts | intended gear reached | cases with a softened wall | cases "
      "stopped by the guard | cases with limited tuning | cases with a broken law |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const lab::CaseGroup& group : summary.groups) {
    const double reached =
        group.shifts > 0 ? 100.0 * static_cast<double>(group.reached) / static_cast<double>(group.shifts) : 0.0;
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", group.of, group.name, group.cases,
                        group.shifts, group.shifts > 0 ? fmt::format("{:.2f} %", reached) : "-", group.softened,
                        group.stopped, group.limited, group.failed);
  }
  return text;
}

std::string ripple_text(const lab::CampaignSummary& summary, bool promised) {
  std::string text = "| rate | delay | cases | median mm | p95 mm | worst mm |\n|---|---|---|---|---|---|\n";
  for (const lab::RippleCell& cell : summary.ripple)
    if (cell.promised == promised)
      text += fmt::format("| {:g} to {:g} Hz | {}{} | {} | {:.3f} | {:.3f} | {:.3f} |\n", cell.slowest, cell.fastest,
                          cell.delay, cell.delay == 4 ? " to 8" : "", cell.cases, 1e3 * cell.median, 1e3 * cell.p95,
                          1e3 * cell.max);
  return text;
}

std::string failures_text(const lab::CampaignSummary& summary) {
  if (summary.broken.empty()) return "No law was broken.\n";
  std::string text = "| case | seed | law | value | bound | time s |\n|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < summary.broken.size() && i < kMaxListedFailures; ++i) {
    const lab::BrokenLaw& one = summary.broken[i];
    text += fmt::format("| {} | {:016x} | {} | {:.4g} | {:.4g} | {:.3f} |\n", one.number, one.seed,
                        std::string(lab::law_text(one.law).name), one.result.value, one.result.bound, one.result.time);
  }
  if (summary.broken.size() > kMaxListedFailures)
    text +=
        fmt::format("\n{} more broken laws are listed in summary.json.\n", summary.broken.size() - kMaxListedFailures);
  return text;
}

std::string refusals_text(const lab::CampaignSummary& summary) {
  std::string text;
  for (const auto& [why, times] : summary.refusals)
    text += fmt::format("- rejected {}: {}\n", times == 1 ? "once" : fmt::format("{} times", times), why);
  return text;
}

nlohmann::ordered_json result_json(const lab::LawResult& result) {
  return {{"value", result.value}, {"bound", result.bound}, {"at_s", result.time}};
}

}  // namespace

std::string campaign_text(const lab::CampaignSummary& summary) {
  return fmt::format(
             "{} shifts in {} cases with seed {}: {} cycles, {:.1f} hours of simulated time; {} of the shifts must "
             "reach the intended gear; {} cases rejected by the loop's checks\n\n",
             summary.shifts, summary.cases, summary.seed, summary.cycles, summary.seconds / 3600.0, summary.clean,
             summary.refused) +
         laws_text(summary) + "\n" + failures_text(summary) + "\n" + groups_text(summary) +
         "\nPeak-to-peak motion of a lever held still for 3 s, measured in the last 0.5 s. Cases for which the "
         "stability check guarantees no vibration:\n\n" +
         ripple_text(summary, true) + "\nCases without a guarantee against vibration:\n\n" +
         ripple_text(summary, false) + "\n" + refusals_text(summary);
}

std::string campaign_json(const lab::CampaignSummary& summary, const std::string& program) {
  nlohmann::ordered_json json{{"program", program},         {"seed", summary.seed},      {"cases", summary.cases},
                              {"refused", summary.refused}, {"shifts", summary.shifts},  {"clean", summary.clean},
                              {"cycles", summary.cycles},   {"seconds", summary.seconds}};
  for (std::size_t i = 0; i < lab::kCampaignLaws; ++i) {
    const lab::LawSummary& law = summary.laws[i];
    const lab::LawText& law_info = lab::law_text(static_cast<lab::CampaignLaw>(i));
    json["laws"].push_back({{"name", law_info.name},
                            {"says", law_info.requirement},
                            {"unit", law_info.unit},
                            {"cases", law.cases},
                            {"looks", law.checks},
                            {"broken", law.broken},
                            {"worst", result_json(law.worst)},
                            {"worst_case", law.worst_case}});
  }
  json["failures"] = nlohmann::ordered_json::array();
  for (const lab::BrokenLaw& one : summary.broken)
    json["failures"].push_back({{"case", one.number},
                                {"seed", fmt::format("{:016x}", one.seed)},
                                {"law", lab::law_text(one.law).name},
                                {"seen", result_json(one.result)}});
  for (const lab::CaseGroup& group : summary.groups)
    json["drawn"].push_back({{"of", group.of},
                             {"name", group.name},
                             {"cases", group.cases},
                             {"shifts", group.shifts},
                             {"reached", group.reached},
                             {"softened", group.softened},
                             {"stopped", group.stopped},
                             {"limited", group.limited},
                             {"failed", group.failed}});
  for (const lab::RippleCell& cell : summary.ripple)
    json["ripple"].push_back({{"from_hz", cell.slowest},
                              {"to_hz", cell.fastest},
                              {"delay", cell.delay},
                              {"promised", cell.promised},
                              {"cases", cell.cases},
                              {"median_m", cell.median},
                              {"p95_m", cell.p95},
                              {"most_m", cell.max}});
  for (const auto& [why, times] : summary.refusals) json["refusals"].push_back({{"why", why}, {"times", times}});
  return json.dump(2) + "\n";
}

std::string case_text(const lab::CampaignCase& drawn, const lab::CaseOutcome& outcome) {
  const haptics::HapticConfig& haptics = drawn.haptics;
  std::string text = fmt::format(
      "case {}, seed {:016x}: {} hand ({:.3g} kg, {:.3g} N s/m, {:.4g} N/m{}), {} gate, {}{:.1f} Hz, delay: {} "
      "cycle{}, "
      "period jitter: {:.1f} %, plant error: {:.1f} %, encoder step: {:.1f} um, {}, energy control: {}, wall "
      "stiffness: {:.0f} N/m requested, {:.0f} used, final push: {:.0f} N\n",
      drawn.number, drawn.seed, std::string(lab::kCaseHandNames[static_cast<std::size_t>(drawn.hand)]),
      drawn.lever.hand.mass, drawn.lever.hand.damping, drawn.lever.hand.stiffness,
      drawn.is_elastic
          ? fmt::format(", elastic grip of {:.3g} kg, {:.3g} N s/m, {:.4g} N/m", drawn.lever.hand.finger_mass,
                        drawn.lever.hand.grip_damping, drawn.lever.hand.grip_stiffness)
          : "",
      drawn.shipped_gate >= 0 ? "shipped" : "random", drawn.has_car ? "with a car, " : "", haptics.rate,
      drawn.lever.delay, drawn.lever.delay == 1 ? "" : "s", 100.0 * drawn.lever.period_jitter,
      100.0 * drawn.lever.model_error, 1e6 * lab::count_of(drawn), haptics::to_string(haptics.contact.hold),
      haptics::to_string(haptics.contact.energy_control), haptics.tuning.wall_stiffness, outcome.stiffness,
      drawn.manner.last_push);
  if (!outcome.refused.empty()) return text + "rejected: " + outcome.refused + "\n";
  text += fmt::format(
      "{} of {} shifts reached the intended gear; the wall was softened {} time{}; {:.1f} s of simulated time\n",
      outcome.reached, outcome.shifts, outcome.softened, outcome.softened == 1 ? "" : "s", outcome.seconds);
  for (std::size_t i = 0; i < lab::kCampaignLaws; ++i) {
    const lab::LawResult& result = outcome.laws.result(static_cast<lab::CampaignLaw>(i));
    const lab::LawText& law_info = lab::law_text(static_cast<lab::CampaignLaw>(i));
    if (result.checks == 0) continue;
    text += fmt::format("{:<10} {:>10.4g} {:<14} bound {:<10.4g} at {:>8.3f} s  {}\n", std::string(law_info.name),
                        result.value, std::string(law_info.unit), result.bound, result.time,
                        result.broken() ? "BROKEN" : "");
  }
  return text;
}

}  // namespace gearshift::verbs
