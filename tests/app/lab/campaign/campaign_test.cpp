// Tests a sample of the campaign, its resumption after interruptions, its independence of the number of threads, and
// the random draw of cases.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "app/lab/bench/rows/bench.h"
#include "app/lab/campaign/broken_laws.h"
#include "app/lab/campaign/campaign_car.h"
#include "app/lab/campaign/campaign_shards.h"
#include "app/lab/campaign/campaign_summary.h"
#include "app/lab/campaign/case_file.h"
#include "app/lab/campaign/shift_campaign.h"
#include "tests/app/lab/campaign/campaign_fixtures.h"
#include "tests/support/gates.h"
#include "tests/support/temp_folder.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> sorted_lines(const std::filesystem::path& file) {
  std::vector<std::string> lines = lines_of(file);
  std::sort(lines.begin(), lines.end());
  return lines;
}

}  // namespace

TEST_CASE("thousands of shifts of every kind of hand: no law is broken") {
  CampaignPlan plan;
  plan.seed = 11;
  plan.shifts = static_cast<int>(campaign_size(10000, 6000));
  plan.threads = 2;
  const std::vector<CaseOutcome> outcomes = drive_campaign(plan, layouts(), {});
  const CampaignSummary summary = summarise(plan.seed, outcomes, static_cast<int>(layouts().size()));
  for (const BrokenLaw& one : summary.broken) {
    CAPTURE(one.number);
    CAPTURE(one.result.value);
    FAIL_CHECK(law_text(one.law).name);
  }
  CHECK(summary.shifts >= plan.shifts);
  CHECK(summary.refused > 0);
  for (const LawSummary& law : summary.laws) CHECK(law.checks > 0);
  std::vector<double> ripple;  // [m] ripple of each case in which the law `quiet` was checked
  for (const CaseOutcome& outcome : outcomes)
    if (outcome.laws.result(CampaignLaw::quiet).checks > 0) ripple.push_back(outcome.ripple);
  REQUIRE(ripple.size() > 50);
  CHECK(quantile(ripple, 0.95) <= 0.3e-3);
}

TEST_CASE(
    "cases that broke a law once: heavy hands on a late wall, a trembling hand on a wall of 0.5 N/m, a released lever "
    "in a late feel, a hand of 2.4 kg that overpowers motors and device springs, elastic hands of 1.5 and 2.3 kg that "
    "swing for long after a shift, a force that is larger at the end of an energy surplus than at its start") {
  const struct {
    std::uint64_t seed, number;
  } cases[] = {{1, 26063}, {5, 23356}, {11, 19065}, {5, 7277}, {1, 14884},
               {1, 1321},  {1, 18697}, {1, 20527},  {1, 16513}};
  for (const auto& one : cases) {
    CAPTURE(one.number);
    CHECK_FALSE(
        run_case(drawn_case(one.seed, one.number, static_cast<int>(layouts().size())), layouts()).laws.any_broken());
  }
}

TEST_CASE("the result does not depend on the number of threads, nor on where it was stopped") {
  CampaignPlan plan;
  plan.shifts = 300;
  const TempFolder once, twice;
  plan.folder = once.path();
  drive_campaign(plan, layouts(), {});
  plan.folder = twice.path();
  plan.threads = 3;
  drive_campaign(plan, layouts(), {});
  const std::vector<std::string> all = sorted_lines(once / "cases.csv");
  std::vector<std::string> more = sorted_lines(twice / "cases.csv");  // three threads may start two extra cases
  CHECK(std::includes(more.begin(), more.end(), all.begin(), all.end()));

  // Simulates that the program was killed while it wrote the fourth case's line. This is lines[5], because the file
  // begins with two header lines.
  const std::vector<std::string> lines = lines_of(once / "cases.csv");
  std::ofstream cut(twice / "cases.csv", std::ios::trunc);
  for (std::size_t i = 0; i < 5; ++i) cut << lines[i] << "\n";
  cut << lines[5].substr(0, lines[5].size() / 2);
  cut.close();
  plan.threads = 1;
  const std::vector<CaseOutcome> resumed = drive_campaign(plan, layouts(), {});
  CHECK(sorted_lines(twice / "cases.csv") == all);
  CHECK(resumed.size() + 2 == all.size());

  plan.program = "another";
  CHECK_THROWS_WITH_AS(drive_campaign(plan, layouts(), {}), doctest::Contains("belongs to another campaign"),
                       std::runtime_error);
  plan = {};
  plan.folder = twice.path();
  plan.seed = 2;
  CHECK_THROWS_WITH_AS(drive_campaign(plan, layouts(), {}), doctest::Contains("belongs to another campaign"),
                       std::runtime_error);
}

// Each case goes to the shard with the least to do so far, so no shard has more to do than another by more than one case
// (list scheduling: Graham, SIAM J. Appl. Math. 17 (1969) 416).
TEST_CASE("shards share all cases, and are expected to take about the same time") {
  constexpr int kShards = 4, kGates = 20;
  const std::vector<int> shard_of = split_cases(5, 40'000, kShards, kGates);
  std::array<double, kShards> cycles{};
  std::uint64_t shifts = 0, last = 0;
  for (std::uint64_t number = 0; number < shard_of.size(); ++number) {
    const CampaignCase drawn = drawn_case(5, number, kGates);
    REQUIRE((shard_of[number] >= 1 && shard_of[number] <= kShards));
    if (is_forbidden(drawn)) continue;
    last = static_cast<std::uint64_t>(drawn.shifts);
    shifts += last;
    cycles[static_cast<std::size_t>(shard_of[number] - 1)] += drawn.haptics.rate * (drawn.shifts > 0 ? 72.5 : 20.0);
  }
  CHECK((shifts >= 40'000 && shifts - last < 40'000));  // as many cases as are needed, and not one more
  const auto [least, most] = std::minmax_element(cycles.begin(), cycles.end());
  CHECK(*most - *least <= 4000.0 * 72.5);  // one case at the highest rate
}

TEST_CASE("the shards' outcomes are those of one campaign, and they take about the same number of cycles") {
  CampaignPlan plan;
  plan.seed = 11;
  plan.shifts = 2000;
  const std::vector<CaseOutcome> whole = drive_campaign(plan, layouts(), {});
  std::vector<std::uint64_t> numbers;
  std::array<double, 2> cycles{};
  for (int number = 1; number <= 2; ++number) {
    plan.shard = CampaignShard{number, 2};
    for (const CaseOutcome& outcome : drive_campaign(plan, layouts(), {})) {
      numbers.push_back(outcome.number);
      cycles[static_cast<std::size_t>(number - 1)] += static_cast<double>(outcome.cycles);
      REQUIRE(outcome.number < whole.size());
      CHECK(outcome.cycles == whole[outcome.number].cycles);
      CHECK(outcome.fastest == whole[outcome.number].fastest);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  for (std::uint64_t number = 0; number < numbers.size(); ++number) CHECK(numbers[number] == number);
  CHECK(std::abs(cycles[0] / cycles[1] - 1.0) < 0.25);
}

TEST_CASE("asked to stop, a campaign starts no more cases, and resumes from there") {
  CampaignPlan plan;
  plan.shifts = 1'000'000;
  plan.threads = 2;
  const TempFolder folder;
  plan.folder = folder.path();
  const std::vector<CaseOutcome> first = drive_campaign(plan, layouts(), [](const CampaignStatus&) { return false; });
  CHECK(first.size() < 1000);  // the plan's million shifts would take 30,000 cases
  plan.shifts = 300;
  const std::size_t resumed = drive_campaign(plan, layouts(), {}).size();
  plan.folder.clear();
  CHECK(resumed == drive_campaign(plan, layouts(), {}).size());
}

TEST_CASE("a case beyond its limit of processor time is reported by its number, and others are not") {
  CampaignPlan plan;
  plan.shifts = 2000;
  std::vector<std::uint64_t> overdue;  // numbers of reported cases; ascending, because a single thread runs the plan
  const auto record_overdue = [&](const CampaignStatus& status) {
    if (status.overdue) overdue.push_back(*status.overdue);
    return true;
  };
  drive_campaign(plan, layouts(), record_overdue);
  CHECK(overdue.empty());
  plan.case_time_limit = -1.0;  // every running case is beyond this limit
  const std::size_t cases = drive_campaign(plan, layouts(), record_overdue).size();
  REQUIRE(overdue.size() > 3);
  CHECK(std::is_sorted(overdue.begin(), overdue.end()));
  CHECK(overdue.front() < cases / 2);
  CHECK(overdue.back() > cases / 2);
  CHECK(overdue.back() < cases);
}

TEST_CASE("a line cut off by a full disk stays the last one, whatever other threads have finished") {
  const TempFolder folder;
  const std::filesystem::path name = folder / "cases.csv";
  CaseOutcome outcome;
  {
    CaseFile file(name, "one campaign");
    file.add(outcome);
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit tight = before;
    tight.rlim_cur = std::filesystem::file_size(name) + 10;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &tight) == 0);
    outcome.number = 1;
    CHECK_THROWS_WITH_AS(file.add(outcome), doctest::Contains("cannot be written"), std::runtime_error);
    setrlimit(RLIMIT_FSIZE, &before);  // the file may grow again, but nothing may follow the incomplete line
    outcome.number = 2;
    CHECK_THROWS_WITH_AS(file.add(outcome), doctest::Contains("cannot be written"), std::runtime_error);
  }
  CaseFile again(name, "one campaign");
  CHECK(again.cases().size() == 1);
}

TEST_CASE("an edited file of cases is rejected with line, column, value and range, and stays unchanged") {
  CampaignPlan plan;
  plan.shifts = 1;
  const TempFolder folder;
  plan.folder = folder.path();
  const std::filesystem::path file = folder / "cases.csv";
  drive_campaign(plan, layouts(), {});
  const std::vector<std::string> lines = lines_of(file);
  const auto refused = [&](const std::string& last) {
    std::ofstream(file, std::ios::trunc) << lines[0] << "\n" << lines[1] << "\n" << last << "\n";
    std::string sentence;
    try {
      drive_campaign(plan, layouts(), {});
    } catch (const std::runtime_error& problem) {
      sentence = problem.what();
    }
    CHECK(lines_of(file).back() == last.substr(last.rfind('\n') + 1));
    const std::size_t name = sentence.find("cases.csv:");
    return name == std::string::npos ? sentence : sentence.substr(name + 10);
  };
  CHECK(refused("0,,-5") == "3: the line has 3 fields instead of 62");
  const std::string rest = ",0,0,1,1.0,2000,0,1,0,0,0,1.0";
  std::string laws;
  for (std::size_t i = 0; i < kCampaignLaws; ++i) laws += ",1,0,0,0";
  CHECK(refused("0,,-5" + rest + laws) == "3: shifts is \"-5\", not a number from 0 to 40");
  CHECK(refused("0,,41" + rest + laws) == "3: shifts is \"41\", not a number from 0 to 40");
  // Cases start in order on at most 256 threads. So with no earlier line, case 256 cannot have started yet; with one
  // earlier line, case 257 cannot.
  CHECK(refused("256,,1" + rest + laws) == "3: case is \"256\", not a number from 0 to 255");
  CHECK(refused("255,,1" + rest + laws + "\n257,,1" + rest + laws) == "4: case is \"257\", not a number from 0 to 256");
  CHECK(refused("18446744073709551615,,1" + rest + laws).starts_with("3: case is \"18446744073709551615\", not"));
  CHECK(refused("0,,1,0,3,1,1.0,2000,0,1,0,0,0,1.0" + laws) == "3: reached is \"3\", not a number from 0 to 1");
  CHECK(refused("0,,1,0,0,1,1.0,2000,0,7,0,0,0,1.0" + laws) == "3: promised is \"7\", not a number from 0 to 1");
  CHECK(refused("0,\x1b[31m,0" + rest + laws).find("text without control characters") != std::string::npos);
  CHECK(refused("0,,1,0,0,1,nan,2000,0,1,0,0,0,1.0" + laws).starts_with("3: seconds is \"nan\", not a number"));
  CHECK(refused("0,,1" + rest + laws + "\n0,,1" + rest + laws) == "4: case 0 appears twice");
  // A diverged lever's infinite values are accepted, so that the campaign can be resumed.
  std::ofstream(file, std::ios::trunc) << lines[0] << "\n"
                                       << lines[1] << "\n0,,1,0,0,1,1,2000,0,1,0,inf,0,inf" << laws << "\n";
  CHECK(drive_campaign(plan, layouts(), {}).front().fastest == std::numeric_limits<double>::infinity());
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  CHECK_THROWS_WITH_AS(drive_campaign(plan, layouts(), {}), doctest::Contains("is not a regular file"),
                       std::runtime_error);
}

TEST_CASE("two campaigns in one folder: the second is rejected, and can resume when the first has ended") {
  CampaignPlan plan;
  plan.shifts = 1;
  const TempFolder folder;
  plan.folder = folder.path();
  drive_campaign(plan, layouts(), {});
  const std::vector<std::string> lines = lines_of(folder / "cases.csv");
  {
    const CaseFile first(folder / "cases.csv", lines[0].substr(2));
    CHECK_THROWS_WITH_AS(drive_campaign(plan, layouts(), {}),
                         doctest::Contains("another campaign is writing to this file"), std::runtime_error);
  }
  plan.shifts = 100;
  CHECK(drive_campaign(plan, layouts(), {}).size() > 1);
  CHECK(lines_of(folder / "cases.csv")[2] == lines[2]);
}

TEST_CASE("a case that broke a law is run again, and its trace replays") {
  CampaignPlan plan;
  const TempFolder folder;
  plan.folder = folder.path();
  plan.seed = 11;
  std::uint64_t number = 0;
  while (drawn_case(plan.seed, number, static_cast<int>(layouts().size())).shifts == 0 ||
         !run_case(drawn_case(plan.seed, number, static_cast<int>(layouts().size())), layouts()).refused.empty())
    ++number;
  const std::uint64_t seed = case_seed(plan.seed, number);
  const std::vector<BrokenLaw> broken{{number, seed, CampaignLaw::quiet, {}}, {number, seed, CampaignLaw::slew, {}}};
  CHECK(record_failures(plan, broken, layouts(), {}) == 1);
  CHECK(replays(folder / fmt::format("failures/{:016x}.trace", seed)));
  const std::vector<std::string> lines = lines_of(folder / fmt::format("failures/{:016x}.txt", seed));
  REQUIRE(lines.size() == 4);
  CHECK(lines[0].starts_with(fmt::format("{:016x}.trace: case {} of seed 11 violates quiet (", seed, number)));
  CHECK(lines[1] == fmt::format("gearshift train --replay {:016x}.trace --from 0.0", seed));
  CHECK(lines[2].starts_with(fmt::format("{:016x}.trace: case {} of seed 11 violates slew (", seed, number)));
  CHECK(record_failures(plan, {}, layouts(), {}) == 0);
}

TEST_CASE("a trace's broken laws are reported only for that trace, with a command that starts two seconds earlier") {
  const TempFolder folder;
  const std::filesystem::path trace = folder / "it's one.trace", text = folder / "it's one.txt";
  BrokenLaw one{3, 4, CampaignLaw::fades, {1, 0.002, 0.001, 42.57}};
  write_broken_laws(trace, 1, std::vector{one});
  const std::string message = broken_laws_text(trace);
  CHECK(message.starts_with("it's one.trace: case 3 of seed 1 violates fades ("));
  CHECK(message.find("): 0.002 m, bound 0.001, at 42.570 s\ngearshift train --replay '") != std::string::npos);
  CHECK(message.ends_with("/it'\\''s one.trace' --from 40.5\n"));
  std::filesystem::rename(text, folder / "other.txt");
  CHECK(broken_laws_text(trace).empty());
  CHECK(broken_laws_text(folder / "other.trace").empty());
  std::ofstream(text) << "a note\nit's one.trace: \x1b[31m\n"
                      << std::string(1'000'000, '\n') << "it's one.trace: late\n";
  CHECK(broken_laws_text(trace) == "it's one.trace: ?[31m\n");
  write_broken_laws(trace, 1, {});
  CHECK_FALSE(std::filesystem::exists(text));
}

TEST_CASE("every seventh case is wide, half of them with a car; no other is") {
  double slowest = 1e9, longest_ramp = 0.0, widest_margin = 0.0;
  int longest_delay = 0, cars = 0, wide = 0;
  constexpr int kCases = 7000;
  for (std::uint64_t number = 0; number < kCases; ++number) {
    const CampaignCase drawn = drawn_case(1, number, 8);
    CHECK(drawn.is_wide == (number % 7 == 4));
    if (!drawn.is_wide) {
      CHECK(drawn.haptics.rate >= 250.0);
      CHECK_FALSE(drawn.has_car);
      continue;
    }
    ++wide;
    cars += drawn.has_car;
    slowest = std::min(slowest, drawn.haptics.rate);
    longest_ramp = std::max(longest_ramp, drawn.haptics.guard.ramp_time);
    widest_margin = std::max(widest_margin, drawn.haptics.guard.position_margin);
    longest_delay = std::max(longest_delay, drawn.lever.delay);
  }
  CHECK(wide == kCases / 7);
  CHECK(std::abs(cars - wide / 2) < 80);  // 80: five standard deviations in `wide` = 1000 coin tosses
  CHECK(slowest < 101.0);
  CHECK(longest_ramp > 59.0);
  CHECK(widest_margin > 0.99);
  CHECK(longest_delay == 8);
}

// Constructing a car checks all its ranges; this is done for 500 random cars.
TEST_CASE("random cars are valid, of every size, and reproducible") {
  double lightest = 1e9, heaviest = 0.0, max_torque = 0.0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const CarSpec car = random_car(seed);
    CHECK(car.gearbox.ratio[kMaxGear - 1] > 0.0);
    lightest = std::min(lightest, car.body.mass);
    heaviest = std::max(heaviest, car.body.mass);
    max_torque = std::max(max_torque, full_torque(car.engine, car.engine.idle));
  }
  CHECK(lightest < 110.0);
  CHECK(heaviest > 55000.0);
  CHECK(max_torque > 1000.0);
  CHECK(random_car(7).text == random_car(7).text);
}

TEST_CASE("a case with a car: its pedals move, its lockouts depend on its speed, and its trace replays") {
  CampaignCase drawn = plain_case(6);
  drawn.has_car = true;
  const TempFolder folder;
  const std::filesystem::path trace = folder / "case.trace";
  CHECK_FALSE(run_case(drawn, layouts(), trace).laws.any_broken());
  TraceReader reader(trace);
  const auto car = [](const std::string& name, const Gate& gate) -> std::unique_ptr<LeverLoad> {
    return make_car_load(name, gate);
  };
  Replayer replayer(reader.header(), trace.string(), car);
  double fastest = 0.0, max_clutch = 0.0;
  for (TraceSample sample; reader.next(sample);) {
    REQUIRE(replayer.step(sample));
    fastest = std::max(fastest, std::abs(sample.out.road_speed));
    max_clutch = std::max(max_clutch, sample.controls.pedals.clutch);
  }
  CHECK(replayer.finish(reader.hash()).bit_for_bit());
  CHECK(fastest > 0.1);
  CHECK(max_clutch == 1.0);
}
