// A sample of the campaign; that it does not matter when and on how many threads it ran; and what it draws.
#include <sys/resource.h>

#include <algorithm>
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

#include "tests/bench/bench.h"
#include "tests/bench/campaign/broken_laws.h"
#include "tests/bench/campaign/campaign_car.h"
#include "tests/bench/campaign/campaign_fixtures.h"
#include "tests/bench/campaign/campaign_summary.h"
#include "tests/bench/campaign/case_file.h"
#include "tests/bench/campaign/shift_campaign.h"
#include "tests/support/gates.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

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

TEST_CASE("10,000 shifts of every kind of hand, a hundredth of the campaign: no law is broken") {
  CampaignPlan plan;
  plan.seed = 11;
  plan.shifts = 10000;
  plan.threads = 2;
  const std::vector<CaseOutcome> outcomes = drive_campaign(plan, layouts(), {});
  const CampaignSummary summary = summarise(plan.seed, outcomes, static_cast<int>(layouts().size()));
  for (const LawBroken& one : summary.broken) {
    CAPTURE(one.number);
    CAPTURE(one.seen.value);
    FAIL_CHECK(law_words(one.law).name);
  }
  CHECK(summary.shifts >= 10000);
  CHECK(summary.refused > 0);
  for (const LawSummary& law : summary.laws) CHECK(law.looks > 0);
  std::vector<double> ripple;  // [m] of each case that quiet was asked of: the goal is a p95 of 0.3 mm
  for (const CaseOutcome& outcome : outcomes)
    if (outcome.laws.seen(CampaignLaw::quiet).looks > 0) ripple.push_back(outcome.ripple);
  REQUIRE(ripple.size() > 50);
  CHECK(quantile(ripple, 0.95) <= 0.3e-3);
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
  std::vector<std::string> more = sorted_lines(twice / "cases.csv");  // three threads may begin two cases more
  CHECK(std::includes(more.begin(), more.end(), all.begin(), all.end()));

  // Killed in the middle of its fourth case's line.
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
  CHECK_THROWS_WITH_AS(drive_campaign(plan, layouts(), {}), doctest::Contains("of another campaign"),
                       std::runtime_error);
  plan = {};
  plan.folder = twice.path();
  plan.seed = 2;
  CHECK_THROWS_WITH_AS(drive_campaign(plan, layouts(), {}), doctest::Contains("of another campaign"),
                       std::runtime_error);
}

TEST_CASE("asked to end, a campaign begins no other case, and goes on from there") {
  CampaignPlan plan;
  plan.shifts = 1'000'000;
  plan.threads = 2;
  const TempFolder folder;
  plan.folder = folder.path();
  const std::vector<CaseOutcome> first = drive_campaign(plan, layouts(), [](const CampaignStand&) { return false; });
  CHECK(first.size() < 1000);  // 30,000 are a million
  plan.shifts = 300;
  const std::size_t resumed = drive_campaign(plan, layouts(), {}).size();
  plan.folder.clear();
  CHECK(resumed == drive_campaign(plan, layouts(), {}).size());
}

TEST_CASE("a case that has had more processor time than the patience is told by its number, and others are not") {
  CampaignPlan plan;
  plan.shifts = 2000;
  std::vector<std::uint64_t> overdue;  // as they were told: one thread drives one after the other
  const auto see = [&](const CampaignStand& stand) {
    if (stand.overdue) overdue.push_back(*stand.overdue);
    return true;
  };
  drive_campaign(plan, layouts(), see);
  CHECK(overdue.empty());
  plan.patience = -1.0;  // whatever runs is late
  const std::size_t cases = drive_campaign(plan, layouts(), see).size();
  REQUIRE(overdue.size() > 3);
  CHECK(std::is_sorted(overdue.begin(), overdue.end()));
  CHECK(overdue.front() < cases / 2);
  CHECK(overdue.back() > cases / 2);
  CHECK(overdue.back() < cases);
}

TEST_CASE("a line that the disk cut short is the last one, whatever other threads have done") {
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
    setrlimit(RLIMIT_FSIZE, &before);  // there is room again
    outcome.number = 2;
    CHECK_THROWS_WITH_AS(file.add(outcome), doctest::Contains("cannot be written"), std::runtime_error);
  }
  CaseFile again(name, "one campaign");
  CHECK(again.cases().size() == 1);
}

TEST_CASE("a file of cases that was edited is refused with line, column, value and range, and stays as it was") {
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
    const std::size_t name = sentence.find("cases.csv: ");
    return name == std::string::npos ? sentence : sentence.substr(name + 11);
  };
  CHECK(refused("0,,-5") == "line 3: 3 fields, not 66");
  const std::string rest = ",0,0,1,1.0,2000,0,1,0,0,0,1.0";
  std::string laws;
  for (std::size_t i = 0; i < kCampaignLaws; ++i) laws += ",1,0,0,0";
  CHECK(refused("0,,-5" + rest + laws) == "line 3: shifts is \"-5\", not a number from 0 to 40");
  CHECK(refused("0,,41" + rest + laws) == "line 3: shifts is \"41\", not a number from 0 to 40");
  // A case that no thread can have had yet, after no line or after one.
  CHECK(refused("256,,1" + rest + laws) == "line 3: case is \"256\", not a number from 0 to 255");
  CHECK(refused("255,,1" + rest + laws + "\n257,,1" + rest + laws) ==
        "line 4: case is \"257\", not a number from 0 to 256");
  CHECK(refused("18446744073709551615,,1" + rest + laws).starts_with("line 3: case is \"18446744073709551615\", not"));
  CHECK(refused("0,,1,0,3,1,1.0,2000,0,1,0,0,0,1.0" + laws) == "line 3: reached is \"3\", not a number from 0 to 1");
  CHECK(refused("0,,1,0,0,1,1.0,2000,0,7,0,0,0,1.0" + laws) == "line 3: promised is \"7\", not a number from 0 to 1");
  CHECK(refused("0,\x1b[31m,0" + rest + laws).find("text without control characters") != std::string::npos);
  CHECK(refused("0,,1,0,0,1,nan,2000,0,1,0,0,0,1.0" + laws).starts_with("line 3: seconds is \"nan\", not a number"));
  CHECK(refused("0,,1" + rest + laws + "\n0,,1" + rest + laws) == "line 4: case 0 is there twice");
  // A lever that ran away: the case that broke it worst is gone on from.
  std::ofstream(file, std::ios::trunc) << lines[0] << "\n"
                                       << lines[1] << "\n0,,1,0,0,1,1,2000,0,1,0,inf,0,inf" << laws << "\n";
  CHECK(drive_campaign(plan, layouts(), {}).front().fastest == std::numeric_limits<double>::infinity());
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  CHECK_THROWS_WITH_AS(drive_campaign(plan, layouts(), {}), doctest::Contains("is no plain file"), std::runtime_error);
}

TEST_CASE("two campaigns in one folder: the second is refused, and goes on when the first has ended") {
  CampaignPlan plan;
  plan.shifts = 1;
  const TempFolder folder;
  plan.folder = folder.path();
  drive_campaign(plan, layouts(), {});
  const std::vector<std::string> lines = lines_of(folder / "cases.csv");
  {
    const CaseFile first(folder / "cases.csv", lines[0].substr(2));
    CHECK_THROWS_WITH_AS(drive_campaign(plan, layouts(), {}), doctest::Contains("another campaign is at work there"),
                         std::runtime_error);
  }
  plan.shifts = 100;
  CHECK(drive_campaign(plan, layouts(), {}).size() > 1);
  CHECK(lines_of(folder / "cases.csv")[2] == lines[2]);
}

TEST_CASE("a case that broke a law is driven again, and its trace replays") {
  CampaignPlan plan;
  const TempFolder folder;
  plan.folder = folder.path();
  plan.seed = 11;
  std::uint64_t number = 0;
  while (drawn_case(plan.seed, number, static_cast<int>(layouts().size())).shifts == 0 ||
         !run_case(drawn_case(plan.seed, number, static_cast<int>(layouts().size())), layouts()).refused.empty())
    ++number;
  const std::uint64_t seed = case_seed(plan.seed, number);
  const std::vector<LawBroken> broken{{number, seed, CampaignLaw::quiet, {}}, {number, seed, CampaignLaw::slew, {}}};
  CHECK(record_failures(plan, broken, layouts(), {}) == 1);
  CHECK(replays(folder / fmt::format("failures/{:016x}.trace", seed)));
  const std::vector<std::string> told = lines_of(folder / fmt::format("failures/{:016x}.txt", seed));
  REQUIRE(told.size() == 4);
  CHECK(told[0].starts_with(fmt::format("{:016x}.trace: case {} of seed 11 breaks quiet (", seed, number)));
  CHECK(told[1] == fmt::format("gearshift train --replay {:016x}.trace --from 0.0", seed));
  CHECK(told[2].starts_with(fmt::format("{:016x}.trace: case {} of seed 11 breaks slew (", seed, number)));
  CHECK(record_failures(plan, {}, layouts(), {}) == 0);
}

TEST_CASE("what a trace breaks is said of it alone, with the command that shows it two seconds before") {
  const TempFolder folder;
  const std::filesystem::path trace = folder / "it's one.trace", text = folder / "it's one.txt";
  LawBroken one{3, 4, CampaignLaw::fades, {1, 0.002, 0.001, 42.57}};
  tell_broken(trace, 1, std::vector{one});
  const std::string told = told_of(trace);
  CHECK(told.starts_with("it's one.trace: case 3 of seed 1 breaks fades ("));
  CHECK(told.find("): 0.002 m, bound 0.001, at 42.570 s\ngearshift train --replay '") != std::string::npos);
  CHECK(told.ends_with("/it'\\''s one.trace' --from 40.5\n"));
  std::filesystem::rename(text, folder / "other.txt");
  CHECK(told_of(trace).empty());
  CHECK(told_of(folder / "other.trace").empty());
  std::ofstream(text) << "a note\nit's one.trace: \x1b[31m\n"
                      << std::string(1'000'000, '\n') << "it's one.trace: late\n";
  CHECK(told_of(trace) == "it's one.trace: ?[31m\n");
  tell_broken(trace, 1, {});
  CHECK_FALSE(std::filesystem::exists(text));
}

TEST_CASE("each seventh case is wide, half of them with a car; no other is") {
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
  CHECK(std::abs(cars - wide / 2) < 80);  // five standard deviations of a thousand coins
  CHECK(slowest < 101.0);
  CHECK(longest_ramp > 59.0);
  CHECK(widest_margin > 0.99);
  CHECK(longest_delay == 8);
}

// The reader of cars says what a car may be; here it reads 500 of them.
TEST_CASE("random cars are cars, of every size, and the same again") {
  double lightest = 1e9, heaviest = 0.0, most_torque = 0.0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const CarSpec car = random_car(seed);
    CHECK(car.gearbox.ratio[kMaxGear - 1] > 0.0);
    lightest = std::min(lightest, car.body.mass);
    heaviest = std::max(heaviest, car.body.mass);
    most_torque = std::max(most_torque, full_torque(car.engine, car.engine.idle));
  }
  CHECK(lightest < 110.0);
  CHECK(heaviest > 55000.0);
  CHECK(most_torque > 1000.0);
  CHECK(random_car(7).text == random_car(7).text);
}

TEST_CASE("a case with a car: its feet move, its lockouts hear of its speed, and its trace replays") {
  CampaignCase drawn = plain_case(6);
  drawn.has_car = true;
  const TempFolder folder;
  const std::filesystem::path trace = folder / "case.trace";
  CHECK_FALSE(run_case(drawn, layouts(), trace).laws.any_broken());
  TraceReader reader(trace);
  const auto car = [](const std::string& name, const Gate& gate) -> std::unique_ptr<LeverWorld> {
    return make_car_world(name, gate);
  };
  Replayer replayer(reader.header(), trace.string(), car);
  double fastest = 0.0, most_clutch = 0.0;
  for (TraceSample sample; reader.next(sample);) {
    REQUIRE(replayer.step(sample));
    fastest = std::max(fastest, std::abs(sample.out.road_speed));
    most_clutch = std::max(most_clutch, sample.controls.clutch);
  }
  CHECK(replayer.finish(reader.hash()).bit_for_bit());
  CHECK(fastest > 0.1);
  CHECK(most_clutch == 1.0);
}
