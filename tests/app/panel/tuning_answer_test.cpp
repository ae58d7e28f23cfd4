// What the panel says of a tuning, against the laws' closed forms and the function that guards the loop.
#include "app/panel/tuning_answer.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "app/panel/setup_fields.h"
#include "tests/support/gates.h"

using namespace gearshift;
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

TEST_CASE("the table's ranges are those that check_tuning() takes: the ends are taken, beyond is refused") {
  for (const TuningField& field : kTuningFields) {
    CAPTURE(field.key);
    for (const auto& [end, out] : {std::pair{field.least, -1e-3}, std::pair{field.most, 1e-3}}) {
      HapticTuning tuning;
      tuning.*field.member = end;
      CHECK_NOTHROW(check_tuning(tuning));
      tuning.*field.member = end + out * (1.0 + field.most);
      CHECK_THROWS_AS(check_tuning(tuning), std::invalid_argument);
    }
  }
}

TEST_CASE("the setup's ranges are those that check_config() takes, and each field is its own") {
  for (const SetupField& field : kSetupFields) {
    CAPTURE(field.key);
    HapticConfig config;
    config.over_push.clear_below = 1.0;
    for (const double end : {field.least, field.most}) {
      if (std::string_view(field.key) == "clear_below_n") config.over_push.warn_above = 1000.0;
      field.set(config, end);
      CHECK(field.get(config) == end);
      CHECK_NOTHROW(check_config(config));
    }
    field.set(config, field.most * 1.01 + 1.0);
    CHECK_THROWS_AS(check_config(config), std::invalid_argument);
  }
}

TEST_CASE("with a sample of delay at 1 kHz the wall's bound is 0.35 m / (2 T)^2 of the lighter axis") {
  TuningQuestion question = ask_at(1000.0, 1);
  const double bound = 0.35 * std::min(kPaperAxisX.mass, kPaperAxisY.mass) / (0.002 * 0.002);
  const TuningAnswer fine = answer(question);
  CHECK(fine.admissible);
  CHECK(stable_ranges(question)[tuning_field("wall_stiffness_n_per_m")].most == Approx(bound).epsilon(1e-9));
  question.config.tuning.wall_stiffness = 20000.0;
  const TuningAnswer refused = answer(question);
  CHECK_FALSE(refused.admissible);
  REQUIRE(refused.admitted.limited.size() == 1);
  const std::string words = limited_sentence(refused.admitted.limited[0]);
  CAPTURE(words);
  CHECK(words.find("20000 N/m") != std::string::npos);
  CHECK(words.find("7525 N/m") != std::string::npos);
  CHECK(words.find("K <= 0.35 m / tau^2") != std::string::npos);
}

TEST_CASE("every bound holds: just inside is admitted, just outside is not") {
  for (const int delay : {0, 1, 2}) {
    for (const double rate : {1000.0, 500.0}) {
      TuningQuestion question = ask_at(rate, delay);
      const auto start = most_stable(question);  // as the loop would start
      REQUIRE(start.has_value());
      question.config.tuning = *start;
      REQUIRE(answer(question).admissible);
      const StableRanges stable = stable_ranges(question);
      for (std::size_t i = 0; i < kTuningFields.size(); ++i) {
        const TuningField& field = kTuningFields[i];
        const double step = 2e-3 * (field.most - field.least);
        CAPTURE(field.key);
        CAPTURE(delay);
        const auto admits = [&](double value) {
          TuningQuestion trial = question;
          trial.config.tuning.*field.member = value;
          return answer(trial).admissible;
        };
        CHECK(admits(stable[i].most));
        CHECK(admits(stable[i].least));
        if (stable[i].most < field.most) CHECK_FALSE(admits(stable[i].most + step));
        if (stable[i].least > field.least) CHECK_FALSE(admits(stable[i].least - step));
      }
    }
  }
}

TEST_CASE("what is called the most that is stable is admitted as it is, from anywhere") {
  std::mt19937 random(9);
  for (int i = 0; i < 40; ++i) {
    TuningQuestion question = ask_at(i % 2 == 0 ? 1000.0 : 200.0, i % 4);
    for (const TuningField& field : kTuningFields)
      question.config.tuning.*field.member = std::uniform_real_distribution<double>(field.least, field.most)(random);
    const auto stable = most_stable(question);
    REQUIRE(stable.has_value());
    HapticConfig config = question.config;
    config.tuning = *stable;
    config.contact.hold = question.hold;
    const AdmittedTuning admitted = admit_tuning(config, question.device, kGate);
    CHECK(admitted.tuning == *stable);
    CHECK(admitted.limited.empty());
  }
}

TEST_CASE("in a study everything is admitted as wanted, and told; on a real device nothing is") {
  TuningQuestion question = ask_at(100.0, 0);
  question.config.contact.study = true;
  const TuningAnswer study = answer(question);
  CHECK(study.admissible);
  CHECK_FALSE(study.admitted.limited.empty());
  question.device.simulated = false;
  const TuningAnswer refused = answer(question);
  CHECK_FALSE(refused.admissible);
  CHECK_FALSE(refused.refused.empty());
}

TEST_CASE("the judge asks once for one question, and again for anything that matters") {
  TuningJudge judge;
  TuningQuestion question = ask_at(1000.0, 0);
  for (int i = 0; i < 10; ++i) judge.judge(question);
  CHECK(judge.asked() == 1);
  question.config.tuning.wall_damping += 1.0;
  judge.judge(question);
  CHECK(judge.asked() == 2);
  question.device.axis_y.mass *= 0.5;
  judge.judge(question);
  CHECK(judge.asked() == 3);
  question.hold = ContactHold::zero_order;
  judge.judge(question);
  CHECK(judge.asked() == 4);
  const Gate other = shipped_gate("four_speed");
  question.gate = &other;
  judge.judge(question);
  const int asked = judge.asked();
  judge.judge(question);
  CHECK(judge.asked() == asked);
  judge.ranges(question);
  judge.ranges(question);
  CHECK(judge.asked() == asked + 1);
  question.config.tuning.wall_damping += 1.0;
  judge.ranges(question, true);
  CHECK(judge.asked() == asked + 1);
  judge.ranges(question);
  CHECK(judge.asked() == asked + 2);
}

TEST_CASE("what an answer costs, at the worst of delays and rates") {
  using Steady = std::chrono::steady_clock;
  double verdict = 0.0, ranges = 0.0;  // [ms]
  for (const int delay : {0, 1, 2, 3}) {
    for (const double rate : {1000.0, 200.0}) {
      TuningQuestion question = ask_at(rate, delay);
      question.config.tuning = most_stable(question).value();
      const auto begin = Steady::now();
      CHECK(answer(question).admissible);
      const auto between = Steady::now();
      CHECK(stable_ranges(question)[0].most > 0.0);
      verdict = std::max(verdict, std::chrono::duration<double, std::milli>(between - begin).count());
      ranges = std::max(ranges, std::chrono::duration<double, std::milli>(Steady::now() - between).count());
    }
  }
  MESSAGE("a verdict " << verdict << " ms, all ranges " << ranges << " ms at worst");
}
