// gearshift campaign: random gates, hands, rates, delays and tunings against the laws that always hold.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/devices/stop_signals.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/program_name.h"
#include "app/verbs/campaign_words.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "app/version/version_text.h"
#include "haptics/files/part_file.h"
#include "tests/bench/campaign/broken_laws.h"
#include "tests/bench/campaign/case_file.h"
#include "tests/bench/campaign/shift_campaign.h"

namespace gearshift {
namespace {

constexpr const char* kCampaignFooter =
    "A case is a random gate, hand, rate, delay, jitter, encoder and tuning, drawn from seed and number; the loop's "
    "own\n"
    "checks limit or refuse it. Some dozens of shifts are driven, and every law is looked at in every cycle.\n"
    "\n"
    "The folder keeps what is done (cases.csv): stopped, by Ctrl-C too, the same command goes on where it was. At the "
    "end it has\n"
    "summary.json, and failures/SEED.trace of each failed case (100 at most) with SEED.txt, what it breaks: gearshift\n"
    "replay says it, and the command that shows it. A case alone that breaks a law has them, too.\n"
    "\n"
    "Exit code: 0 every law holds, 1 one is broken, or the work failed or was stopped, 2 bad usage.\n"
    "\n"
    "  gearshift campaign --shifts 1000 --out look\n"
    "  gearshift campaign --case 1 --out look    says \"trace look/case_1.trace\"\n"
    "  gearshift replay look/case_1.trace";

struct CampaignArguments {
  CampaignPlan plan;
  std::optional<std::uint64_t> number;  // of the one case
};

int run_one_case(const CampaignArguments& arguments, const std::vector<GateLayout>& shipped) {
  const int gates = static_cast<int>(shipped.size());
  const CampaignCase drawn = drawn_case(arguments.plan.seed, *arguments.number, gates);
  const std::filesystem::path trace = arguments.plan.folder / fmt::format("case_{}.trace", drawn.number);
  const CaseOutcome outcome = run_case(drawn, shipped, trace);
  print_out("{}", case_text(drawn, outcome));
  if (!outcome.refused.empty()) {
    print_out("it was not driven, so nothing is recorded\n");
    return 0;
  }
  tell_broken(trace, arguments.plan.seed, summarise(arguments.plan.seed, {&outcome, 1}, gates).broken);
  print_out("trace {}\n{}", trace.string(), told_of(trace));
  return outcome.laws.any_broken() ? 1 : 0;
}

// Its thread cannot be ended from outside, so the program is: what is done is in the folder.
[[noreturn]] void leave_hanging(ProgressBar& bar, const CampaignPlan& plan, std::uint64_t number) {
  bar.clear();
  print_problem(
      "case {} has not ended after {:g} s: gearshift campaign --seed {} --case {} --out DIR drives it "
      "alone; what is done is kept",
      number, plan.patience, plan.seed, number);
  std::_Exit(1);
}

int end_early(ProgressBar& bar, std::string_view where) {
  bar.clear();
  print_problem("ended {}; the same command goes on there", where);
  return 1;
}

int run_cases(CampaignPlan plan, const std::vector<GateLayout>& shipped) {
  plan.program = program_name() + " " + commit_text();
  const StopSignals signals;
  ProgressBar bar;
  const auto show = [&](std::string_view what, const CampaignStand& stand) {
    if (stand.overdue) leave_hanging(bar, plan, *stand.overdue);
    bar.show(what, stand.share);
    return !StopSignals::asked();
  };
  const std::vector<CaseOutcome> outcomes =
      drive_campaign(plan, shipped, [&](const CampaignStand& stand) { return show("campaign", stand); });
  if (StopSignals::asked()) return end_early(bar, fmt::format("with {} cases in a row done", outcomes.size()));
  const CampaignSummary summary = summarise(plan.seed, outcomes, static_cast<int>(shipped.size()));
  write_text_file(plan.folder / "summary.json", campaign_json(summary, plan.program));
  bar.clear();
  print_out("{}", campaign_text(summary));
  std::fflush(stdout);
  const std::size_t failed =
      record_failures(plan, summary.broken, shipped, [&](const CampaignStand& stand) { return show("traces", stand); });
  if (StopSignals::asked()) return end_early(bar, "before every failed case was recorded");
  bar.clear();
  if (failed > kMostTraces) print_out("Of {} failed cases {} are recorded in failures/\n", failed, kMostTraces);
  return summary.broken.empty() ? 0 : 1;
}

int run_campaign_verb(const CampaignArguments& arguments) {
  const std::vector<GateLayout> shipped = shipped_layouts(shipped_folder("gates"));
  make_folder(arguments.plan.folder);
  return arguments.number ? run_one_case(arguments, shipped) : run_cases(arguments.plan, shipped);
}

}  // namespace

void add_campaign_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<CampaignArguments>();
  arguments->plan.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  CLI::App* verb = app.add_subcommand(
      "campaign", "A million random shifts: gates, hands, rates, delays, tunings against the laws that always hold");
  verb->footer(kCampaignFooter);
  CLI::Option* shifts = verb->add_option("--shifts", arguments->plan.shifts, "that are tried at least")
                            ->check(whole_number(1, 1'000'000'000))
                            ->capture_default_str();
  verb->add_option("--seed", arguments->plan.seed, "of the whole campaign")
      ->check(whole_number())
      ->capture_default_str();
  verb->add_option("--out", arguments->plan.folder, "folder for what is done and what came of it")
      ->required()
      ->type_name("DIR");
  verb->add_option("--threads", arguments->plan.threads, "at a time; the result is the same with any number")
      ->check(whole_number(1, kMostThreads))
      ->capture_default_str();
  verb->add_option("--case", arguments->number, "this one alone, recorded as DIR/case_K.trace")
      ->check(whole_number())
      ->excludes(shifts)
      ->type_name("K");
  verb->callback([arguments, &action] { action = [arguments] { return run_campaign_verb(*arguments); }; });
}

}  // namespace gearshift
