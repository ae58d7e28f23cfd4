// The panel's feedback on a tuning, compared with the closed forms of the stability laws, and with admit_tuning(),
// which the loop uses.
#include "app/ui/panel/tuning_check.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>
#include <utility>

#include <doctest/doctest.h>

#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;
using doctest::Approx;

namespace {

TuningQuestion ask_at(double rate, int delay) {
  TuningQuestion question;
  question.config.rate = rate;
  question.device.delay = delay;
  question.device.simulated = true;
  question.config.contact.hold = ContactHold::half_sample;
  question.feel_stiffness = paper_feel();
  return question;
}

}  // namespace

TEST_CASE("an answer is not reused for a device whose own walls differ: it names another limit") {
  TuningQuestion question = ask_at(1000.0, 1);
  question.config.tuning.wall_stiffness = 20000.0;
  TuningJudge judge;
  const double bound = 0.25 * std::min(kPaperAxisX.mass, kPaperAxisY.mass) / (0.002 * 0.002);
  CHECK(judge.judge(question).admitted.tuning.wall_stiffness == Approx(bound).epsilon(1e-9));
  question.device.device_wall_stiffness = glm::dvec2(1000.0);  // added to what the loop may render
  CHECK(judge.judge(question).admitted.tuning.wall_stiffness > bound + 500.0);
  question.device.device_wall_stiffness = glm::dvec2(0.0);
  const double damping = judge.judge(question).admitted.tuning.wall_damping;
  question.config.tuning.wall_damping = 100.0;
  const double loop_damping = judge.judge(question).admitted.tuning.wall_damping;
  question.device.device_wall_damping = glm::dvec2(5.0);
  CHECK(judge.judge(question).admitted.tuning.wall_damping > loop_damping + 2.0);
  CHECK(damping <= loop_damping);
}

TEST_CASE(
    "with one cycle of delay at 1 kHz the wall's bound is 0.25 m / (2 T)^2, with the mass m of the lighter axis") {
  TuningQuestion question = ask_at(1000.0, 1);
  const double bound = 0.25 * std::min(kPaperAxisX.mass, kPaperAxisY.mass) / (0.002 * 0.002);
  const TuningAnswer fine = answer(question);
  CHECK(fine.admissible);
  CHECK(stable_ranges(question)[index_of(&HapticTuning::wall_stiffness)].max == Approx(bound).epsilon(1e-9));
  question.config.tuning.wall_stiffness = 20000.0;
  const TuningAnswer refused = answer(question);
  CHECK_FALSE(refused.admissible);
  REQUIRE(refused.admitted.limits.size() == 1);
  const std::string words = format_limit(refused.admitted.limits[0]);
  CAPTURE(words);
  CHECK(words.find("20000 N/m") != std::string::npos);
  CHECK(words.find("5375 N/m") != std::string::npos);
  CHECK(words.find("K <= 0.25 m / tau^2") != std::string::npos);
}

TEST_CASE("every bound is exact: a value just inside is accepted, one just outside is not") {
  for (const int delay : {0, 1, 2}) {
    for (const double rate : {1000.0, 500.0}) {
      TuningQuestion question = ask_at(rate, delay);
      const auto start = nearest_stable(question);  // the loop would start with this tuning
      REQUIRE(start.has_value());
      question.config.tuning = *start;
      REQUIRE(answer(question).admissible);
      const StableRanges stable = stable_ranges(question);
      for (std::size_t i = 0; i < std::size(kTuningFields); ++i) {
        const TuningField& field = kTuningFields[i];
        const double step = 2e-3 * (field.range.max - field.range.min);
        CAPTURE(field.key);
        CAPTURE(delay);
        const auto admits = [&](double value) {
          TuningQuestion trial = question;
          value_of(trial.config.tuning, field) = value;
          return answer(trial).admissible;
        };
        CHECK(admits(stable[i].max));
        CHECK(admits(stable[i].min));
        if (stable[i].max < field.range.max) CHECK_FALSE(admits(stable[i].max + step));
        if (stable[i].min > field.range.min) CHECK_FALSE(admits(stable[i].min - step));
      }
    }
  }
}

TEST_CASE("the value named as the stable maximum is accepted unchanged, from any start") {
  std::mt19937 random(9);
  for (int i = 0; i < 40; ++i) {
    TuningQuestion question = ask_at(i % 2 == 0 ? 1000.0 : 200.0, i % 4);
    for (const TuningField& field : kTuningFields)
      value_of(question.config.tuning, field) =
          std::uniform_real_distribution<double>(field.range.min, field.range.max)(random);
    const auto stable = nearest_stable(question);
    REQUIRE(stable.has_value());
    HapticConfig config = question.config;
    config.tuning = *stable;
    const AdmittedTuning admitted = admit_tuning(config, question.device, paper_feel());
    CHECK(admitted.tuning == *stable);
    CHECK(admitted.limits.empty());
  }
}

TEST_CASE("with allow_unstable every value is accepted and reported; on a real device it is rejected") {
  TuningQuestion question = ask_at(100.0, 0);
  question.config.contact.allow_unstable = true;
  const TuningAnswer study = answer(question);
  CHECK(study.admissible);
  CHECK_FALSE(study.admitted.limits.empty());
  question.device.simulated = false;
  const TuningAnswer refused = answer(question);
  CHECK_FALSE(refused.admissible);
  CHECK_FALSE(refused.refused.empty());
}

// A cached answer keeps its list of limits, so the list's address stays; a new check makes a new list while the old one
// exists.
TEST_CASE("the check runs once per question, and again after any relevant change") {
  TuningJudge judge;
  TuningQuestion question = ask_at(100.0, 0);  // not stable, so there are limits
  const TuningLimit* before = nullptr;
  const auto is_checked_again = [&] {
    const TuningLimit* now = judge.judge(question).admitted.limits.data();
    REQUIRE(now != nullptr);
    return std::exchange(before, now) != now;
  };
  CHECK(is_checked_again());
  for (int i = 0; i < 10; ++i) CHECK_FALSE(is_checked_again());
  question.config.tuning.wall_damping += 1.0;
  CHECK(is_checked_again());
  question.device.axis_y.mass *= 0.5;
  CHECK(is_checked_again());
  question.config.contact.hold = ContactHold::zero_order;
  CHECK(is_checked_again());
  question.feel_stiffness *= 2.0;
  CHECK(is_checked_again());
  CHECK_FALSE(is_checked_again());
}

TEST_CASE("ranges follow the question unless they are frozen") {
  constexpr std::size_t kWall = index_of(&HapticTuning::wall_stiffness);
  TuningJudge judge;
  const double first = judge.ranges(ask_at(1000.0, 1))[kWall].max;
  CHECK(judge.ranges(ask_at(1000.0, 2), true)[kWall].max == first);
  const double second = judge.ranges(ask_at(1000.0, 2))[kWall].max;
  CHECK(second == stable_ranges(ask_at(1000.0, 2))[kWall].max);
  CHECK(second < first);
}

TEST_CASE("reports how long an answer takes at the worst delays and rates") {
  using Steady = std::chrono::steady_clock;
  double verdict = 0.0, ranges = 0.0;  // [ms]
  for (const int delay : {0, 1, 2, 3}) {
    for (const double rate : {1000.0, 200.0}) {
      TuningQuestion question = ask_at(rate, delay);
      question.config.tuning = nearest_stable(question).value();
      const auto begin = Steady::now();
      CHECK(answer(question).admissible);
      const auto between = Steady::now();
      CHECK(stable_ranges(question)[0].max > 0.0);
      verdict = std::max(verdict, std::chrono::duration<double, std::milli>(between - begin).count());
      ranges = std::max(ranges, std::chrono::duration<double, std::milli>(Steady::now() - between).count());
    }
  }
  MESSAGE("a verdict " << verdict << " ms, all ranges " << ranges << " ms at worst");
}
