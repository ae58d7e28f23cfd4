// A sample of the campaign; that it does not matter when and on how many threads it ran; and that each law can be broken.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "haptics/gate/gate_feel.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "tests/bench/bench.h"
#include "tests/bench/campaign/campaign_car.h"
#include "tests/bench/campaign/campaign_summary.h"
#include "tests/bench/campaign/case_file.h"
#include "tests/bench/campaign/shift_campaign.h"
#include "tests/support/gates.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;
using glm::dvec2;

namespace {

const std::vector<GateLayout>& layouts() {
  static const std::vector<GateLayout> shipped = shipped_layouts(GEARSHIFT_ASSETS "/gates");
  return shipped;
}

CampaignCase plain_case(std::uint64_t number) {
  CampaignCase drawn;
  drawn.number = number;
  drawn.seed = case_seed(7, number);
  drawn.lever.hand = kGripHand;
  drawn.lever.actuator.overload_time = 1e4;  // its motors never tire: that would excuse a wall
  drawn.shifts = 4;
  return drawn;
}

bool broken(const CaseOutcome& outcome, CampaignLaw law) {
  return outcome.laws.seen(law).broken();
}

bool replays(const std::filesystem::path& trace) {
  TraceReader reader(trace);
  Replayer replayer(reader.header(), trace.string());
  for (TraceSample sample; reader.next(sample);)
    if (!replayer.step(sample)) return false;
  return replayer.finish(reader.hash()).bit_for_bit();
}

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

// One cycle of a lever that stands in the neutral aisle of the paper's gate, and the one before it.
struct TwoCycles {
  HapticSnapshot before, now;
  TwoCycles() {
    before.guard = now.guard = GuardState::running;
    now.time_ns = 1'000'000;
  }
  SeenCycle seen() const { return {now, before, false, false}; }
};

// The drawn lever goes through the first lockout of one of these kinds.
TwoCycles through_lockout(const Gate& gate, std::initializer_list<LockoutKind> kinds) {
  const auto all = lockouts(gate);
  const auto lockout = std::find_if(all.begin(), all.end(), [&](const Lockout& one) {
    return std::find(kinds.begin(), kinds.end(), one.kind) != kinds.end();
  });
  REQUIRE(lockout != all.end());
  const Slot& slot = slot_of(gate, lockout->slot);
  const double x = lockout->lateral ? lockout->barrier : column_of(gate, slot.column).center;
  const double mouth = lockout->lateral ? 0.0 : static_cast<int>(slot.side) * (gate.half_aisle + gate.chamfer);
  const dvec2 step =
      lockout->lateral ? dvec2(1e-4 * lockout->beyond, 0.0) : dvec2(0.0, 1e-4 * static_cast<int>(slot.side));
  TwoCycles through;
  through.before.proxy = dvec2(x, mouth) - step;
  through.now.proxy = dvec2(x, mouth) + step;
  return through;
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
  CHECK(refused("0,,-5" + rest + laws) == "line 3: shifts is \"-5\", not a number from 0 to 1000");
  CHECK(refused("0,,99999" + rest + laws) == "line 3: shifts is \"99999\", not a number from 0 to 1000");
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
  REQUIRE(told.size() == 2);
  CHECK(told[0].starts_with(fmt::format("case {} of seed 11 breaks quiet (", number)));
  CHECK(told[1].starts_with(fmt::format("case {} of seed 11 breaks slew (", number)));
  CHECK(record_failures(plan, {}, layouts(), {}) == 0);
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

TEST_CASE("planted: checks that refuse what nothing forbids") {
  CampaignCase drawn = plain_case(5);
  drawn.haptics.rate = 50.0;  // never drawn
  CHECK_THROWS_AS(run_case(drawn, layouts()), std::runtime_error);
  drawn = plain_case(5);
  drawn.haptics.guard.slew = 1.9;
  CHECK(run_case(drawn, layouts()).refused.find("slew") != std::string::npos);
}

TEST_CASE("planted: nobody looks at the events, and some are lost") {
  CampaignCase drawn = plain_case(5);
  CHECK_FALSE(broken(run_case(drawn, layouts()), CampaignLaw::told));
  drawn.shifts = 1500;
  const auto look_away = [](LawLimits& limits) { limits.frame = 1e6; };
  CHECK(broken(run_case(drawn, layouts(), {}, look_away), CampaignLaw::told));
}

TEST_CASE("planted: with energy bounding a force may fall to nothing at once, not to the other side") {
  LawLimits limits;
  limits.max_force = dvec2(31.7);
  limits.slew = 5.0;
  limits.falls_at_once = true;
  TwoCycles turn;
  turn.before.commanded = {30.0, 0.0};
  LawBook book;
  for (const double now : {0.0, -4.9, 34.9}) {
    turn.now.commanded = {now, 0.0};
    slew_law(turn.seen(), limits, book);
    CHECK_FALSE(book.seen(CampaignLaw::slew).broken());
  }
  turn.now.commanded = {-30.0, 0.0};
  slew_law(turn.seen(), limits, book);
  CHECK(book.seen(CampaignLaw::slew).broken());
}

TEST_CASE("a law that was broken by a number that is none stays broken") {
  LawBook book;
  book.note(CampaignLaw::slew, std::numeric_limits<double>::quiet_NaN(), 1.0, 0.1);
  book.note(CampaignLaw::slew, 0.5, 1.0, 0.2);
  CHECK(book.seen(CampaignLaw::slew).broken());
  CHECK(book.seen(CampaignLaw::slew).time == 0.1);
  book.note(CampaignLaw::quiet, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.1);  // or against one
  book.note(CampaignLaw::quiet, 0.5, 1.0, 0.2);
  CHECK(book.seen(CampaignLaw::quiet).broken());
}

TEST_CASE("planted: a lever that truly moves by a number that is none breaks the law of energy") {
  LawLimits limits;
  limits.energy_bounded = true;
  limits.damping = limits.least_damping = {5.0, 5.0};
  limits.period = limits.longest = 0.001;
  LawBook book;
  EnergyLaw law;
  TwoCycles cycles;
  cycles.now.guard = GuardState::running;
  law.look(cycles.seen(), {1e-5, 0.0}, limits, book);
  CHECK_FALSE(book.seen(CampaignLaw::energy).broken());
  law.look(cycles.seen(), {std::numeric_limits<double>::quiet_NaN(), 0.0}, limits, book);
  CHECK(book.seen(CampaignLaw::energy).broken());
}

TEST_CASE("planted: the paper's 5000 N/m at 100 Hz, forced by a study, is not quiet, and its trace replays") {
  CampaignCase drawn = plain_case(1);
  drawn.haptics.rate = 100.0;
  drawn.haptics.contact = {ContactHold::zero_order, EnergyControl::none, false, true};
  const TempFolder folder;
  const std::filesystem::path trace = folder / "case.trace";
  const CaseOutcome outcome = run_case(drawn, layouts(), trace);
  CAPTURE(outcome.ripple);
  CHECK(broken(outcome, CampaignLaw::quiet));
  CHECK(replays(trace));
}

TEST_CASE("a swing ends in every case: half as fast as handle and hand let it die away, or no wider than a tremor") {
  CampaignCase drawn = plain_case(1);
  drawn.lever.hand = {2.19, 12.2, 1468.0};
  const LawLimits limits = law_limits(drawn.haptics, drawn.lever, DeviceSpec{});
  const double decay = (12.2 + 2.9) / (2.0 * (2.19 + 0.086));  // [1/s] b / (2 m) of the slower axis
  CHECK(limits.kept == doctest::Approx(std::exp(-0.5 * decay)));
  const auto is_broken = [&](double before, double after) {
    LawBook book;
    fades_law(before, after, limits, 1.0, book);
    return book.seen(CampaignLaw::fades).broken();
  };
  CHECK(is_broken(2.19e-3, 2.19e-3));
  CHECK(is_broken(1e-5, 1e-3));
  CHECK(is_broken(0.0, std::numeric_limits<double>::quiet_NaN()));
  CHECK_FALSE(is_broken(20e-3, 3.7e-3));
  CHECK_FALSE(is_broken(0.7e-3, 0.75e-3));
}

TEST_CASE("planted: a heavy hand in the paper's 5000 N/m at 100 Hz: it is promised nothing, and its swing is found") {
  CampaignCase drawn = plain_case(1);
  drawn.hand = CaseHand::heavy;
  drawn.lever.hand = {1.0, 10.0, 1000.0};
  drawn.haptics.rate = 100.0;
  drawn.haptics.contact = {ContactHold::zero_order, EnergyControl::none, false, true};
  const CaseOutcome outcome = run_case(drawn, layouts());
  CAPTURE(outcome.ripple);
  CHECK_FALSE(outcome.promised);
  CHECK(broken(outcome, CampaignLaw::fades));
}

TEST_CASE("a heavy hand that leans on the end of a slot, beside its lock's spring, comes to rest") {
  const CampaignCase drawn = drawn_case(1, 297, static_cast<int>(layouts().size()));
  REQUIRE(drawn.hand == CaseHand::heavy);
  const CaseOutcome outcome = run_case(drawn, layouts());
  CHECK(outcome.ripple < 0.3e-3);
  CHECK_FALSE(broken(outcome, CampaignLaw::fades));
}

TEST_CASE("planted: the same with the limiter's last word is stopped by the guard") {
  CampaignCase drawn = plain_case(1);
  drawn.haptics.rate = 250.0;
  drawn.haptics.contact = {ContactHold::zero_order, EnergyControl::none, true, true};
  drawn.haptics.tuning.aisle_damping = 50.0;  // unstable whatever the wall does
  drawn.haptics.tuning.limit_damping = 50.0;
  drawn.lever.delay = 3;
  CHECK(broken(run_case(drawn, layouts()), CampaignLaw::guard));
}

TEST_CASE("planted: a wall without energy bounding gives what the damping had not taken; with it, never") {
  CampaignCase drawn = plain_case(2);
  const auto promise = [](LawLimits& limits) { limits.energy_bounded = true; };
  CHECK(broken(run_case(drawn, layouts(), {}, promise), CampaignLaw::energy));
  drawn.haptics.contact.energy_control = EnergyControl::energy_bounding;
  CHECK_FALSE(broken(run_case(drawn, layouts()), CampaignLaw::energy));
}

TEST_CASE("planted: a device of 60 N where 31.7 were promised, and a slew beyond its own") {
  CampaignCase drawn = plain_case(3);
  drawn.lever.actuator.peak_force = 60.0;
  drawn.manner.last_push = 70.0;
  const auto promise = [](LawLimits& limits) {
    limits.max_force = dvec2(31.7);
    limits.slew = 0.5;
  };
  const CaseOutcome outcome = run_case(drawn, layouts(), {}, promise);
  CHECK(broken(outcome, CampaignLaw::force));
  CHECK(broken(outcome, CampaignLaw::slew));
  CHECK_FALSE(run_case(drawn, layouts()).laws.any_broken());
}

TEST_CASE("planted: a proxy in a wall, or carried through one, and a number that is none") {
  const Gate gate = paper_gate();
  LawLimits limits;
  LawBook book;
  TwoCycles inside_wall;
  inside_wall.now.proxy = {0.5 * (gate.column[0].center + gate.column[1].center), gate.half_aisle + 0.005};
  REQUIRE_FALSE(in_free_space(gate, inside_wall.now.proxy));
  free_space_law(inside_wall.seen(), gate, book);
  CHECK(book.seen(CampaignLaw::free_space).broken());

  // From one slot to the next, as far as the lever went: each end is in free space, the wall between them is not.
  TwoCycles through;
  const double deep = gate.half_aisle + 0.02;
  through.before.proxy = through.before.lever = {gate.column[0].center, deep};
  through.now.proxy = through.now.lever = {gate.column[1].center, deep};
  REQUIRE(in_free_space(gate, through.before.proxy));
  REQUIRE(in_free_space(gate, through.now.proxy));
  no_wall_law(through.seen(), gate, limits, book);
  CHECK(book.seen(CampaignLaw::no_wall).broken());

  // From deep in a slot to the aisle before the next, and back: the wall's corner lies between.
  for (const bool is_back : {false, true}) {
    LawBook round;
    TwoCycles corner = through;
    (is_back ? corner.before : corner.now).proxy.y = (is_back ? corner.before : corner.now).lever.y = 0.0;
    no_wall_law(corner.seen(), gate, limits, round);
    CHECK(round.seen(CampaignLaw::no_wall).broken());
  }

  // Along the mouth's chamfer to where the slot ends to the last bit (case 6661 of seed 1): no way round anything.
  for (const bool is_back : {false, true}) {
    LawBook along;
    TwoCycles mouth;
    const double x = gate.column[0].center;
    mouth.before.proxy = mouth.before.lever = {x, gate.half_aisle + 1.1e-6};
    mouth.now.proxy = mouth.now.lever = {x + 1e-4, gate.half_aisle + 1.5e-10};
    if (is_back) std::swap(mouth.before, mouth.now);
    limits.period = 0.0;
    no_wall_law(mouth.seen(), gate, limits, along);
    CHECK_FALSE(along.seen(CampaignLaw::no_wall).broken());
  }

  TwoCycles none;
  none.now.commanded.x = std::numeric_limits<double>::quiet_NaN();
  finite_law(none.seen(), book);
  CHECK(book.seen(CampaignLaw::finite).broken());
}

TEST_CASE("planted: through a lockout that is closed, not through one that the hand opens") {
  const Gate gate = shipped_gate("six_speed_r_left_up");
  const TwoCycles through = through_lockout(gate, {LockoutKind::push_down, LockoutKind::lift});
  LawBook book;
  LockoutLaw law;
  law.look({through.now, through.before, true, true}, gate, book);
  CHECK_FALSE(book.seen(CampaignLaw::lockout).broken());
  law.look(through.seen(), gate, book);
  CHECK(book.seen(CampaignLaw::lockout).broken());
}

// The gate's file says 20 and 15 km/h.
TEST_CASE("planted: through a lockout that the road speed shut, and has not opened yet") {
  const Gate gate = shipped_gate("dog_leg_five");
  TwoCycles through = through_lockout(gate, {LockoutKind::speed});
  const auto is_broken = [&](std::initializer_list<double> speeds) {  // [km/h] the last as it goes through
    LawBook book;
    LockoutLaw law;
    TwoCycles stays = through;
    stays.now.proxy = stays.before.proxy;
    for (const double& speed : speeds) {
      const bool is_last = &speed == speeds.end() - 1;
      TwoCycles& cycles = is_last ? through : stays;
      cycles.before.road_speed = speed / 3.6;
      law.look({cycles.now, cycles.before, true, true}, gate, book);
    }
    return book.seen(CampaignLaw::lockout).broken();
  };
  CHECK_FALSE(is_broken({0.0}));
  CHECK(is_broken({21.0}));
  CHECK(is_broken({-21.0}));
  CHECK(is_broken({21.0, 18.0}));
  CHECK_FALSE(is_broken({19.0, 18.0}));
  CHECK_FALSE(is_broken({21.0, 14.0, 18.0}));
}

TEST_CASE("planted: a gear that toggles while nothing moves") {
  const Gate gate = paper_gate();
  TwoCycles flicker;
  flicker.now.proxy = flicker.before.proxy = rest_position(gate, 1);
  flicker.now.gear = 1;
  LawBook book;
  GearLaw law;
  law.look(flicker.seen(), gate, false, book);  // it comes
  CHECK_FALSE(book.seen(CampaignLaw::gear_holds).broken());
  std::swap(flicker.now, flicker.before);
  law.look(flicker.seen(), gate, false, book);
  std::swap(flicker.now, flicker.before);
  law.look(flicker.seen(), gate, false, book);  // and again, from where it was
  CHECK(book.seen(CampaignLaw::gear_holds).broken());
}

TEST_CASE("a hand has the time that its effort takes to grow beyond an aisle's spring of four times its force") {
  const CampaignCase drawn = drawn_case(1, 6714, static_cast<int>(layouts().size()));
  REQUIRE(drawn.haptics.tuning.feel_scale > 3.5);
  CHECK_FALSE(broken(run_case(drawn, layouts()), CampaignLaw::reached));
}

TEST_CASE("planted: a lever that is stuck misses the gears that are cleanly aimed at") {
  CampaignCase drawn = plain_case(4);
  CHECK_FALSE(broken(run_case(drawn, layouts()), CampaignLaw::reached));
  drawn.lever.coulomb_friction = 100.0;
  CHECK(broken(run_case(drawn, layouts()), CampaignLaw::reached));
}
