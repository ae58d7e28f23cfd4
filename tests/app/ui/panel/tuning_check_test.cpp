// The panel's feedback on a tuning, compared with the closed forms of the stability laws, and with admit_tuning(),
// which the loop uses.
#include "app/ui/panel/tuning_check.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "app/ui/panel/setup_fields.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;
using doctest::Approx;

namespace {

const Gate kGate = paper_gate();

TuningQuestion ask_at(double rate, int delay) {
  TuningQuestion question;
  question.config.rate = rate;
  question.device.delay = delay;
  question.device.simulated = true;
  question.gate = &kGate;
  return question;
}

}  // namespace

TEST_CASE("the ranges in the table equal those of check_tuning(): the ends are accepted, values beyond are rejected") {
  for (const TuningField& field : kTuningFields) {
    CAPTURE(field.key);
    for (const auto& [end, out] : {std::pair{field.min, -1e-3}, std::pair{field.max, 1e-3}}) {
      HapticTuning tuning;
      tuning.*field.member = end;
      CHECK_NOTHROW(check_tuning(tuning));
      tuning.*field.member = end + out * (1.0 + field.max);
      CHECK_THROWS_AS(check_tuning(tuning), std::invalid_argument);
    }
  }
}

TEST_CASE("the ranges of the setup equal those of check_config(), and each field is separate") {
  for (const SetupField& field : kSetupFields) {
    CAPTURE(field.key);
    HapticConfig config;
    config.over_push.clear_below = 1.0;
    for (const double end : {field.min, field.max}) {
      if (std::string_view(field.key) == "clear_below_n") config.over_push.warn_above = 1000.0;
      field.set(config, end);
      CHECK(field.get(config) == end);
      CHECK_NOTHROW(check_config(config));
    }
    field.set(config, field.max * 1.01 + 1.0);
    CHECK_THROWS_AS(check_config(config), std::invalid_argument);
  }
}

TEST_CASE(
    "with one cycle of delay at 1 kHz the wall's bound is 0.35 m / (2 T)^2, with the mass m of the lighter axis") {
  TuningQuestion question = ask_at(1000.0, 1);
  const double bound = 0.35 * std::min(kPaperAxisX.mass, kPaperAxisY.mass) / (0.002 * 0.002);
  const TuningAnswer fine = answer(question);
  CHECK(fine.admissible);
  CHECK(stable_ranges(question)[tuning_field("wall_stiffness_n_per_m")].max == Approx(bound).epsilon(1e-9));
  question.config.tuning.wall_stiffness = 20000.0;
  const TuningAnswer refused = answer(question);
  CHECK_FALSE(refused.admissible);
  REQUIRE(refused.admitted.limits.size() == 1);
  const std::string words = format_limit(refused.admitted.limits[0]);
  CAPTURE(words);
  CHECK(words.find("20000 N/m") != std::string::npos);
  CHECK(words.find("7525 N/m") != std::string::npos);
  CHECK(words.find("K <= 0.35 m / tau^2") != std::string::npos);
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
      for (std::size_t i = 0; i < kTuningFields.size(); ++i) {
        const TuningField& field = kTuningFields[i];
        const double step = 2e-3 * (field.max - field.min);
        CAPTURE(field.key);
        CAPTURE(delay);
        const auto admits = [&](double value) {
          TuningQuestion trial = question;
          trial.config.tuning.*field.member = value;
          return answer(trial).admissible;
        };
        CHECK(admits(stable[i].max));
        CHECK(admits(stable[i].min));
        if (stable[i].max < field.max) CHECK_FALSE(admits(stable[i].max + step));
        if (stable[i].min > field.min) CHECK_FALSE(admits(stable[i].min - step));
      }
    }
  }
}

TEST_CASE("the value named as the stable maximum is accepted unchanged, from any start") {
  std::mt19937 random(9);
  for (int i = 0; i < 40; ++i) {
    TuningQuestion question = ask_at(i % 2 == 0 ? 1000.0 : 200.0, i % 4);
    for (const TuningField& field : kTuningFields)
      question.config.tuning.*field.member = std::uniform_real_distribution<double>(field.min, field.max)(random);
    const auto stable = nearest_stable(question);
    REQUIRE(stable.has_value());
    HapticConfig config = question.config;
    config.tuning = *stable;
    config.contact.hold = question.hold;
    const AdmittedTuning admitted = admit_tuning(config, question.device, kGate);
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

TEST_CASE("the check runs once per question, and again after any relevant change") {
  TuningJudge judge;
  TuningQuestion question = ask_at(1000.0, 0);
  for (int i = 0; i < 10; ++i) judge.judge(question);
  CHECK(judge.evaluations() == 1);
  question.config.tuning.wall_damping += 1.0;
  judge.judge(question);
  CHECK(judge.evaluations() == 2);
  question.device.axis_y.mass *= 0.5;
  judge.judge(question);
  CHECK(judge.evaluations() == 3);
  question.hold = ContactHold::zero_order;
  judge.judge(question);
  CHECK(judge.evaluations() == 4);
  const Gate other = shipped_gate("four_speed");
  question.gate = &other;
  judge.judge(question);
  const int evaluations = judge.evaluations();
  judge.judge(question);
  CHECK(judge.evaluations() == evaluations);
  judge.ranges(question);
  judge.ranges(question);
  CHECK(judge.evaluations() == evaluations + 1);
  question.config.tuning.wall_damping += 1.0;
  judge.ranges(question, true);
  CHECK(judge.evaluations() == evaluations + 1);
  judge.ranges(question);
  CHECK(judge.evaluations() == evaluations + 2);
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
