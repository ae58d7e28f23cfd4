#include "app/lab/campaign/campaign_summary.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

constexpr std::array<double, 6> kRateBands{100.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0};  // [Hz]
constexpr int kLongDelay = 4;  // [cycles] delays of this length or longer form one group

// True if `a` is further beyond its bound than `b`, or has a smaller margin to its bound. Bounds above 0 are compared
// by the ratio of value and bound.
bool is_worse(const LawResult& a, const LawResult& b) {
  if (a.broken() != b.broken()) return a.broken();
  if (a.bound > 0.0 && b.bound > 0.0) return a.value / a.bound > b.value / b.bound;
  return a.value > b.value;
}

void add_laws(CampaignSummary& summary, const CampaignCase& drawn, const CaseOutcome& outcome) {
  for (std::size_t i = 0; i < kCampaignLaws; ++i) {
    const LawResult& result = outcome.laws.result(static_cast<CampaignLaw>(i));
    if (result.checks == 0) continue;
    LawSummary& law = summary.laws[i];
    if (law.cases++ == 0 || is_worse(result, law.worst)) law.worst = result, law.worst_case = outcome.number;
    law.checks += result.checks;
    law.broken += result.broken();
    if (result.broken()) summary.broken.push_back({outcome.number, drawn.seed, static_cast<CampaignLaw>(i), result});
  }
}

void add_to_group(CampaignSummary& summary, const std::string& of, const std::string& name,
                  const CaseOutcome& outcome) {
  const auto is_same_group = [&](const CaseGroup& group) { return group.of == of && group.name == name; };
  auto found = std::find_if(summary.groups.begin(), summary.groups.end(), is_same_group);
  if (found == summary.groups.end()) found = summary.groups.insert(found, CaseGroup{of, name});
  ++found->cases;
  found->shifts += static_cast<std::uint64_t>(outcome.shifts);
  found->reached += static_cast<std::uint64_t>(outcome.reached);
  found->stopped += outcome.stopped > 0;
  found->softened += outcome.softened > 0;
  found->limited += outcome.limited > 0;
  found->failed += outcome.laws.any_broken();
}

std::string band_name(double rate) {
  std::size_t i = 0;
  while (i + 2 < kRateBands.size() && rate >= kRateBands[i + 1]) ++i;
  return std::to_string(static_cast<int>(kRateBands[i])) + " to " +
         std::to_string(static_cast<int>(kRateBands[i + 1])) + " Hz";
}

void add_groups(CampaignSummary& summary, const CampaignCase& drawn, const CaseOutcome& outcome) {
  static constexpr const char* kHolds[] = {"automatic", "zero-order", "half-sample", "observer"};
  const auto add = [&](const char* of, const std::string& name) { add_to_group(summary, of, name, outcome); };
  const double count = count_of(drawn);
  const bool is_bounded = drawn.haptics.contact.energy_control == haptics::EnergyControl::energy_bounding;
  const bool is_beyond = drawn.lever.model_error > 0.05 || drawn.lever.period_jitter > 0.1;
  add("hand", std::string(kCaseHandNames[static_cast<std::size_t>(drawn.hand)]));
  if (drawn.hand != CaseHand::bare) add("grip", drawn.is_elastic ? "elastic" : "rigid");
  add("gate", drawn.shipped_gate >= 0 ? "shipped" : "random");
  add("rate", band_name(drawn.haptics.rate));
  add("delay", drawn.lever.delay < kLongDelay ? std::to_string(drawn.lever.delay) : "4 to 8");
  add("range of values", drawn.is_wide ? "wide" : "narrow");
  add("load", drawn.has_car ? "a car" : "none");
  add("hold", kHolds[static_cast<int>(drawn.haptics.contact.hold)]);
  add("energy bounding", is_bounded ? "yes" : "no");
  add("encoder step", count == 0.0     ? "none"
                      : count < 20e-6  ? "below 20 um"
                      : count < 150e-6 ? "20 to 150 um"
                                       : "above 150 um");
  add("plant error, jitter", is_beyond ? "above 5 %, 10 %" : "up to 5 %, 10 %");
  add("quiet promised", outcome.promised ? "yes" : "no");
  add("device walls", drawn.lever.device_wall_stiffness > 0.0 ? "yes" : "no");
}

std::string without_values(const std::string& refusal) {
  return refusal.substr(0, refusal.find(" ="));
}

using RippleSamples = std::map<std::tuple<bool, std::string, int>, std::vector<double>>;

void add_ripple(CampaignSummary& summary, RippleSamples& samples, bool promised) {
  for (std::size_t band = 0; band + 1 < kRateBands.size(); ++band) {
    for (int delay = 0; delay <= kLongDelay; ++delay) {
      std::vector<double>& sample = samples[{promised, band_name(kRateBands[band]), delay}];
      if (sample.empty()) continue;
      summary.ripple.push_back({kRateBands[band], kRateBands[band + 1], delay, promised, sample.size(),
                                quantile(sample, 0.5), quantile(sample, 0.95), quantile(sample, 1.0)});
    }
  }
}

bool by_kind_and_name(const CaseGroup& a, const CaseGroup& b) {
  return a.of != b.of ? a.of < b.of : a.name < b.name;
}

}  // namespace

CampaignSummary summarise(std::uint64_t campaign_seed, std::span<const CaseOutcome> outcomes, int shipped_gates) {
  CampaignSummary summary;
  summary.seed = campaign_seed;
  RippleSamples ripple;
  for (const CaseOutcome& outcome : outcomes) {
    ++summary.cases;
    if (!outcome.refused.empty()) {
      ++summary.refused;
      ++summary.refusals[without_values(outcome.refused)];
      continue;
    }
    const CampaignCase drawn = drawn_case(campaign_seed, outcome.number, shipped_gates);
    summary.shifts += static_cast<std::uint64_t>(outcome.shifts);
    summary.clean += static_cast<std::uint64_t>(outcome.clean);
    summary.cycles += outcome.cycles;
    summary.seconds += outcome.seconds;
    add_laws(summary, drawn, outcome);
    add_groups(summary, drawn, outcome);
    if (outcome.laws.result(CampaignLaw::fades).checks > 0)
      ripple[{outcome.promised, band_name(drawn.haptics.rate), std::min(drawn.lever.delay, kLongDelay)}].push_back(
          outcome.ripple);
  }
  std::sort(summary.groups.begin(), summary.groups.end(), by_kind_and_name);
  for (const bool promised : {true, false}) add_ripple(summary, ripple, promised);
  return summary;
}

}  // namespace gearshift::lab
