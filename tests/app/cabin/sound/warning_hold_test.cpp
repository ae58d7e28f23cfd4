// WarningHold: how long a warning sounds after its cause has ended.
#include "app/cabin/sound/warning_hold.h"

#include <doctest/doctest.h>

using namespace gearshift::cabin;

namespace {

constexpr double kFrame = 1.0 / 60.0;

// How long a warning sounds [s] during 3 s, and how often it starts.
struct WarningSound {
  double seconds = 0.0;
  int starts = 0;
};

template <typename Lasts>
WarningSound sound_of(WarningHold hold, Lasts lasts) {
  WarningSound out;
  for (int n = 0; n < 180; ++n) {
    const auto now = hold.update(lasts(n * kFrame), n * kFrame);
    out.seconds += now.is_audible ? kFrame : 0.0;
    out.starts += now.starts;
  }
  return out;
}

}  // namespace

TEST_CASE("a warning lasts as long as its cause, if that is longer than the hold") {
  const WarningSound out = sound_of(WarningHold(0.3, 0.0), [](double t) { return t >= 0.5 && t < 1.5; });
  CHECK(out.seconds == doctest::Approx(1.0).epsilon(0.02));
  CHECK(out.starts == 1);
}

TEST_CASE("a cause of one frame, or between two frames, sounds for the whole hold") {
  const WarningSound frame = sound_of(WarningHold(0.3, 0.0), [](double t) { return t >= 0.5 && t < 0.51; });
  CHECK(frame.seconds == doctest::Approx(0.3).epsilon(0.06));
  WarningHold between(0.3, 0.0);
  between.begin();
  const WarningSound event = sound_of(between, [](double) { return false; });
  CHECK(event.seconds == doctest::Approx(0.3).epsilon(0.06));
  CHECK(event.starts == 1);
  CHECK(sound_of(WarningHold(0.3, 0.0), [](double) { return false; }).seconds == 0.0);
}

TEST_CASE("a cause that flickers faster than the hold is one warning; without a hold it would be many") {
  // The cause lasts 0.1 s in every 0.4 s, five times. The fifth time ends at 1.7 s.
  const auto flickers = [](double t) { return t < 2.0 && static_cast<int>(t / 0.1) % 4 == 0; };
  const WarningSound held = sound_of(WarningHold(0.3, 0.35), flickers);
  CHECK(held.starts == 1);
  CHECK(held.seconds == doctest::Approx(1.7 + 0.35).epsilon(0.03));
  CHECK(sound_of(WarningHold(0.1, 0.0), flickers).starts == 5);
}

TEST_CASE("after the clock was set back, a warning ends no later than one hold afterwards") {
  WarningHold hold(0.3, 0.25);
  hold.begin();
  CHECK(hold.update(false, 1000.0).is_audible);
  CHECK(hold.update(false, 5.0).is_audible);
  CHECK(!hold.update(false, 5.31).is_audible);
}
