// When a warning is heard.
#include "app/cabin_sound/warning_hold.h"

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

constexpr double kFrame = 1.0 / 60.0;

// How long it is heard, and how often it starts, when its cause lasts where `lasts` says so. [s] over 3 s
struct Heard {
  double seconds = 0.0;
  int starts = 0;
};

template <typename Lasts>
Heard heard(WarningHold hold, Lasts lasts) {
  Heard out;
  for (int n = 0; n < 180; ++n) {
    const auto now = hold.update(lasts(n * kFrame), n * kFrame);
    out.seconds += now.heard ? kFrame : 0.0;
    out.starts += now.starts;
  }
  return out;
}

}  // namespace

TEST_CASE("a warning lasts as long as its cause") {
  const Heard out = heard(WarningHold(0.3, 0.0), [](double t) { return t >= 0.5 && t < 1.5; });
  CHECK(out.seconds == doctest::Approx(1.0).epsilon(0.02));
  CHECK(out.starts == 1);
}

TEST_CASE("a cause of one frame, or that came and went between two, is heard for the whole length") {
  const Heard frame = heard(WarningHold(0.3, 0.0), [](double t) { return t >= 0.5 && t < 0.51; });
  CHECK(frame.seconds == doctest::Approx(0.3).epsilon(0.06));
  WarningHold between(0.3, 0.0);
  between.begin();
  const Heard event = heard(between, [](double) { return false; });
  CHECK(event.seconds == doctest::Approx(0.3).epsilon(0.06));
  CHECK(event.starts == 1);
  CHECK(heard(WarningHold(0.3, 0.0), [](double) { return false; }).seconds == 0.0);
}

TEST_CASE("a cause that flutters faster than the hold is one warning; without a hold it would be many") {
  const auto flutters = [](double t) { return t < 2.0 && static_cast<int>(t / 0.1) % 4 == 0; };  // 0.1 s of every 0.4 s
  const Heard held = heard(WarningHold(0.3, 0.35), flutters);
  CHECK(held.starts == 1);
  CHECK(held.seconds == doctest::Approx(1.7 + 0.35).epsilon(0.03));
  CHECK(heard(WarningHold(0.1, 0.0), flutters).starts == 5);
}

TEST_CASE("a clock that is set back ends a warning no later than its length from then on") {
  WarningHold hold(0.3, 0.25);
  hold.begin();
  CHECK(hold.update(false, 1000.0).heard);
  CHECK(hold.update(false, 5.0).heard);
  CHECK(!hold.update(false, 5.31).heard);
}
