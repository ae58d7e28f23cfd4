// gearshift campaign: checks laws that must always hold on random gates, hands, rates, delays and tunings.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/base/program_name.h"
#include "app/base/progress_bar.h"
#include "app/base/stop_signals.h"
#include "app/lab/campaign/broken_laws.h"
#include "app/lab/campaign/case_file.h"
#include "app/lab/campaign/shift_campaign.h"
#include "app/verbs/campaign_report.h"
#include "app/verbs/verbs.h"
#include "app/verbs/version_text.h"
#include "app/verbs/whole_number.h"
#include "haptics/files/atomic_file.h"

namespace gearshift::verbs {
namespace {

constexpr const char* kCampaignFooter =
    "The seed and the case number determine the random gate, hand, rate, delay, jitter, encoder and tuning of each\n"
    "case; the loop's checks may limit the tuning or reject the case. A simulated hand then makes several dozen\n"
    "shifts, and every law is checked in every cycle.\n"
    "\n"
    "Results are saved to cases.csv in the folder. If you stop the campaign (Ctrl-C), run the same command to resume.\n"
    "At the end, the folder contains summary.json and, for each of the first 100 failed cases, failures/SEED.trace\n"
    "and SEED.txt, which names the broken laws. gearshift replay also prints these laws, with a command that\n"
    "reproduces the failure. --case also writes a trace and, if a law is broken, a text file that names the law.\n"
    "\n"
    "A large campaign can be split into shards, which take about the same time on equal machines. --merge continues "
    "with\n"
    "their results, and gives the result of one run bit for bit. With GNU parallel, and as a Slurm array:\n"
    "  parallel gearshift campaign --shard {}/8 --threads 1 --out part/{} ::: 1 2 3 4 5 6 7 8\n"
    "  sbatch --array=1-8 --wrap 'gearshift campaign --shard $SLURM_ARRAY_TASK_ID/8 --out part/$SLURM_ARRAY_TASK_ID'\n"
    "  gearshift campaign --merge part/* --out whole\n"
    "\n"
    "Exit code: 0 if every law holds; 1 if a law is broken or the campaign failed or was stopped; 2 if the command\n"
    "line is invalid.\n"
    "\n"
    "  gearshift campaign --shifts 1000 --out look\n"
    "  gearshift campaign --case 1 --out look    prints \"trace look/case_1.trace\"\n"
    "  gearshift replay look/case_1.trace";

struct CampaignArguments {
  lab::CampaignPlan plan;
  std::optional<std::uint64_t> number;        // number of the only case to run; empty: all cases
  std::vector<std::filesystem::path> shards;  // folders of all shards, to be merged; empty: nothing is merged
};

// "2/8": shard 2 of 8. Empty if the text is anything else.
std::optional<lab::CampaignShard> read_shard(const std::string& text) {
  lab::CampaignShard shard;
  const char *at = text.data(), *end = at + text.size();
  const auto [slash, bad_number] = std::from_chars(at, end, shard.number);
  if (bad_number != std::errc() || slash == end || *slash != '/') return std::nullopt;
  const auto [last, bad_count] = std::from_chars(slash + 1, end, shard.count);
  const bool is_valid = bad_count == std::errc() && last == end && shard.number >= 1 && shard.number <= shard.count &&
                        shard.count <= lab::kMaxShards;
  return is_valid ? std::optional(shard) : std::nullopt;
}

int run_one_case(const CampaignArguments& arguments, const std::vector<haptics::GateLayout>& shipped) {
  const int gates = static_cast<int>(shipped.size());
  const lab::CampaignCase drawn = lab::drawn_case(arguments.plan.seed, *arguments.number, gates);
  const std::filesystem::path trace = arguments.plan.folder / fmt::format("case_{}.trace", drawn.number);
  const lab::CaseOutcome outcome = lab::run_case(drawn, shipped, trace);
  base::print_out("{}", case_text(drawn, outcome));
  if (!outcome.refused.empty()) {
    base::print_out("the case was rejected, so nothing was recorded\n");
    return 0;
  }
  lab::write_broken_laws(trace, arguments.plan.seed, lab::summarise(arguments.plan.seed, {&outcome, 1}, gates).broken);
  base::print_out("trace {}\n{}", trace.string(), lab::broken_laws_text(trace));
  return outcome.laws.any_broken() ? 1 : 0;
}

// Ends the whole program, because the thread of a hung case cannot be stopped. Finished cases are already on disk.
[[noreturn]] void exit_with_hung_case(base::ProgressBar& bar, const lab::CampaignPlan& plan, std::uint64_t number) {
  bar.clear();
  base::print_message(
      "case {} did not finish within {:g} s, so the campaign was stopped; finished cases are saved. To run only this "
      "case: gearshift campaign --seed {} --case {} --out DIR",
      number, plan.case_time_limit, plan.seed, number);
  std::_Exit(1);
}

int report_interruption(base::ProgressBar& bar, std::string_view where) {
  bar.clear();
  base::print_message("interrupted {}; run the same command to resume", where);
  return 1;
}

int run_cases(const lab::CampaignPlan& plan, const std::vector<haptics::GateLayout>& shipped) {
  const base::StopSignals signals;
  base::ProgressBar bar;
  const auto show = [&](std::string_view part, const lab::CampaignStatus& status) {
    if (status.overdue) exit_with_hung_case(bar, plan, *status.overdue);
    bar.show(part, status.fraction);
    return !base::StopSignals::requested();
  };
  const std::vector<lab::CaseOutcome> outcomes =
      lab::drive_campaign(plan, shipped, [&](const lab::CampaignStatus& status) { return show("campaign", status); });
  if (base::StopSignals::requested())
    return report_interruption(bar, outcomes.size() == 1 ? std::string("after 1 finished case")
                                                         : fmt::format("after {} finished cases", outcomes.size()));
  const lab::CampaignSummary summary = lab::summarise(plan.seed, outcomes, static_cast<int>(shipped.size()));
  haptics::write_text_file(plan.folder / "summary.json", campaign_json(summary, plan.program));
  bar.clear();
  if (plan.shard) base::print_out("shard {} of {}: ", plan.shard->number, plan.shard->count);
  base::print_out("{}", campaign_text(summary));
  std::fflush(stdout);
  const std::size_t failed = lab::record_failures(
      plan, summary.broken, shipped, [&](const lab::CampaignStatus& status) { return show("traces", status); });
  if (base::StopSignals::requested()) return report_interruption(bar, "before all failed cases were recorded");
  bar.clear();
  if (failed > lab::kMaxTraces)
    base::print_out("{} cases failed; the first {} are recorded in failures/\n", failed, lab::kMaxTraces);
  return summary.broken.empty() ? 0 : 1;
}

int run_campaign_verb(const CampaignArguments& arguments) {
  const std::vector<haptics::GateLayout> shipped = lab::shipped_layouts(base::shipped_folder("gates"));
  base::make_folder(arguments.plan.folder);
  if (arguments.number) return run_one_case(arguments, shipped);
  lab::CampaignPlan plan = arguments.plan;
  plan.program = base::program_name() + " " + commit_text();
  if (!arguments.shards.empty()) lab::merge_shards(plan, arguments.shards, shipped);
  return run_cases(plan, shipped);
}

}  // namespace

void add_campaign_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<CampaignArguments>();
  arguments->plan.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  CLI::App* verb = app.add_subcommand(
      "campaign",
      "Check laws that must always hold, on a million shifts with random gates, hands, rates, delays and tunings");
  verb->footer(kCampaignFooter);
  CLI::Option* shifts = verb->add_option("--shifts", arguments->plan.shifts, "minimum number of shifts")
                            ->check(whole_number(1, 1'000'000'000))
                            ->capture_default_str();
  verb->add_option("--seed", arguments->plan.seed, "seed of the whole campaign")
      ->check(whole_number())
      ->capture_default_str();
  verb->add_option("--out", arguments->plan.folder, "folder for progress and results; created if missing")
      ->required()
      ->type_name("DIR");
  verb->add_option("--threads", arguments->plan.threads, "number of threads; does not affect the results")
      ->check(whole_number(1, lab::kMaxThreads))
      ->capture_default_str();
  CLI::Option* number =
      verb->add_option("--case", arguments->number, "run only case K and record it as DIR/case_K.trace")
          ->check(whole_number())
          ->excludes(shifts)
          ->type_name("K");
  CLI::Option* shard =
      verb->add_option_function<std::string>(
              "--shard", [arguments](const std::string& text) { arguments->plan.shard = read_shard(text); },
              "run only shard I of N, I from 1")
          ->check(CLI::Validator(
              [](const std::string& text) {
                return read_shard(text)
                           ? std::string()
                           : fmt::format("\"{}\" is not I/N, from 1/N to N/N, with N up to {}", text, lab::kMaxShards);
              },
              ""))
          ->excludes(number)
          ->type_name("I/N");
  verb->add_option("--merge", arguments->shards, "folders of all shards, whose results are merged")
      ->excludes(number)
      ->excludes(shard)
      ->type_name("DIR");
  verb->callback([arguments, &action] { action = [arguments] { return run_campaign_verb(*arguments); }; });
}

}  // namespace gearshift::verbs
