// Compares the exact stiffness limits with values from an earlier, independent program.
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "haptics/analysis/sampled_loop.h"

using namespace gearshift::haptics;

namespace {

ContactLaw textbook_wall(double damping, int delay = 0, int window = 1) {
  ContactLaw law;
  law.hold = ContactHold::zero_order;
  law.damping = damping;
  law.delay = delay;
  law.window = window;
  return law;
}

double limit(double damping, int delay, double period, const HandImpedance& hand = kBareHand) {
  return stiffness_limit(kPaperAxisX, hand, textbook_wall(damping, delay), period);
}

constexpr double kDampings[] = {0.0, 3.0, 5.0, 10.0, 20.0};  // [N s/m]
constexpr double kNotPrinted = -1.0;

struct Row {
  double period;          // [s]
  double printed[5];      // [N/m] for kDampings
  double best_b, best_k;  // damping [N s/m] with the highest limit, and that limit [N/m]
};

void check_table(const Row& row, int delay) {
  for (int i = 0; i < 5; ++i) {
    if (row.printed[i] == kNotPrinted) continue;
    CAPTURE(row.period);
    CAPTURE(kDampings[i]);
    CHECK(std::abs(limit(kDampings[i], delay, row.period) - row.printed[i]) <= 0.51);
  }
  if (row.best_b == kNotPrinted) return;
  // The limit as a function of damping has a flat maximum, so the rounding of `best_b` does not matter.
  const double best = limit(row.best_b, delay, row.period);
  CHECK(best == doctest::Approx(row.best_k).epsilon(0.005));
  CHECK(best > limit(0.9 * row.best_b, delay, row.period));
  CHECK(best > limit(1.1 * row.best_b, delay, row.period));
}

// The range of damping, from `first` to `last` [N s/m], in which a wall of 5000 N/m is stable. `first_digit` and
// `last_digit`: the value of one unit in the last printed digit of `first` and `last`.
struct Band {
  double period;
  int delay;
  HandImpedance hand;
  double first, first_digit, last, last_digit;
};

bool is_stable_at_5000(const Band& band, double damping) {
  ContactLaw law = textbook_wall(damping, band.delay);
  law.stiffness = 5000.0;
  return spectral_radius(kPaperAxisX, band.hand, law, band.period) < 1.0;
}

// The value of `Band::last` if the range has no upper end up to 200 N s/m, the largest damping that is tested.
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("the table without delay, 10 ms to 0.25 ms, to its last digit") {
  const Row rows[] = {{0.01, {634, 964, 1069, 1058, 350}, 7.2, 1105},
                      {0.005, {1233, 2128, 2573, 3255, 3306}, 15, 3460},
                      {0.002, {3032, 5703, 7300, 10706, 15377}, 38, 18350},
                      {0.001, {6032, 11694, 15272, 23562, 37562}, 78, 69248},
                      {0.0005, {12032, 23689, 31257, 49483, 83087}, 159, 268806},
                      {0.00025, {24032, 47687, 63250, 101442, 174830}, 317, 1.06e6}};
  for (const Row& row : rows) check_table(row, 0);
}

TEST_CASE("the table with one sample of delay") {
  constexpr double n = kNotPrinted;
  const Row rows[] = {
      {0.01, {217, 310, 302, 13, 0}, 3.8, 313},          {0.005, {417, 703, 819, 839, 0}, 7.8, 879},
      {0.002, {1017, 1898, 2409, 3413, 4220}, n, n},     {0.001, {2018, 3896, 5072, 7738, 11886}, 40, 15277},
      {0.0005, {4018, 7896, 10403, 16400, 27217}, n, n}, {0.00025, {8018, n, n, n, 57882}, n, n}};
  for (const Row& row : rows) check_table(row, 1);
}

TEST_CASE("two to four samples of delay at 1 ms, bare and gripped") {
  const struct {
    int delay;
    double undamped, best_b, best_k;
  } rows[] = {{2, 1216, 20, 6454}, {3, 873, 20, 4038}, {4, 683, 17, 2701}};
  for (const auto& row : rows) {
    CHECK(std::abs(limit(0.0, row.delay, 0.001) - row.undamped) <= 0.51);
    CHECK(std::abs(limit(row.best_b, row.delay, 0.001) - row.best_k) <= 0.51);
  }
  CHECK(std::abs(limit(0.0, 3, 0.001, kGripHand) - 3843) <= 0.51);
  CHECK(std::abs(limit(40.0, 3, 0.001, kGripHand) - 11059) <= 0.51);
}

TEST_CASE("with a long window damping destabilises the wall: with 15 ms, as in chai3d, 5000 N/m becomes unstable") {
  const struct {
    int window;
    double printed[5];
  } rows[] = {{1, {6032, 11694, 15272, 23562, 37562}},
              {4, {6032, 9852, 11664, 14599, 16685}},
              {8, {6032, 7329, 7659, 7722, 6553}},
              {15, {6032, 4978, 4464, 3466, 1879}},
              {20, {6032, 4539, 3637, 2312, 840}}};
  for (const auto& row : rows) {
    for (int i = 0; i < 5; ++i) {
      CAPTURE(row.window);
      CAPTURE(kDampings[i]);
      const ContactLaw law = textbook_wall(kDampings[i], 0, row.window);
      CHECK(std::abs(stiffness_limit(kPaperAxisX, kBareHand, law, 0.001) - row.printed[i]) <= 0.51);
    }
  }
}

TEST_CASE("the range of damping in which 5000 N/m is stable") {
  const Band bands[] = {{0.01, 0, kArmHand, 24, 1, 128, 1},
                        {0.005, 0, kLightHand, 5.9, 0.1, 62, 1},
                        {0.005, 0, kGripHand, 0, 0, 90, 1},
                        {0.005, 0, kArmHand, 4, 1, kUnbounded, 0},
                        {0.002, 0, kBareHand, 2.2, 0.1, 89, 1},
                        {0.002, 0, kLightHand, 0, 0, 196, 1},
                        {0.001, 0, kBareHand, 0, 0, 189, 1},
                        {0.005, 1, kArmHand, 43, 1, 103, 1},
                        {0.002, 1, kLightHand, 8, 1, 72, 1},
                        {0.002, 1, kGripHand, 1.8, 0.1, 97, 1},
                        {0.002, 1, kArmHand, 6.7, 0.1, kUnbounded, 0},
                        {0.001, 1, kBareHand, 4.9, 0.1, 74, 1}};
  for (const Band& band : bands) {
    CAPTURE(band.period);
    CAPTURE(band.delay);
    CAPTURE(band.hand.mass);
    CHECK(is_stable_at_5000(band, band.first + band.first_digit));
    if (band.first > 0.0) CHECK_FALSE(is_stable_at_5000(band, band.first - band.first_digit));
    CHECK(is_stable_at_5000(band, band.last < kUnbounded ? band.last - band.last_digit : 200.0));
    if (band.last < kUnbounded) CHECK_FALSE(is_stable_at_5000(band, band.last + band.last_digit));
  }
}

TEST_CASE("the cases in which no damping makes 5000 N/m stable") {
  const Band none[] = {
      {0.01, 0, kBareHand, 0, 0, 0, 0},   {0.01, 0, kLightHand, 0, 0, 0, 0}, {0.01, 0, kGripHand, 0, 0, 0, 0},
      {0.005, 0, kBareHand, 0, 0, 0, 0},  {0.01, 1, kArmHand, 0, 0, 0, 0},   {0.005, 1, kBareHand, 0, 0, 0, 0},
      {0.005, 1, kLightHand, 0, 0, 0, 0}, {0.005, 1, kGripHand, 0, 0, 0, 0}, {0.002, 1, kBareHand, 0, 0, 0, 0}};
  for (const Band& band : none) {
    for (double damping = 0.0; damping <= 200.0; damping += 0.5) CHECK_FALSE(is_stable_at_5000(band, damping));
  }
}
