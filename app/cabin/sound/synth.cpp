#include "app/cabin/sound/synth.h"

#include "app/cabin/sound/tones.h"

namespace gearshift::cabin {

std::vector<float> wall_knock() {
  std::vector<float> out(samples_in(0.16));
  strike(out, 0.0, 1.0,
         {{170.0, 0.030, 1.0}, {430.0, 0.022, 0.8}, {960.0, 0.014, 0.6}, {1830.0, 0.008, 0.4}, {3300.0, 0.004, 0.3}});
  fade_out(out, 0.01);
  normalise(out, 0.95f);
  return out;
}

std::vector<float> gear_in_click() {
  std::vector<float> out(samples_in(0.14));
  strike(out, 0.0, 0.5, {{820.0, 0.010, 1.0}, {2150.0, 0.006, 0.7}, {4100.0, 0.003, 0.4}});
  strike(out, 0.016, 1.0, {{260.0, 0.024, 1.0}, {690.0, 0.016, 0.7}, {1900.0, 0.007, 0.5}});
  fade_out(out, 0.01);
  normalise(out, 0.55f);
  return out;
}

std::vector<float> gear_out_click() {
  std::vector<float> out(samples_in(0.08));
  strike(out, 0.0, 1.0, {{610.0, 0.012, 1.0}, {1750.0, 0.007, 0.7}, {3600.0, 0.003, 0.4}});
  fade_out(out, 0.01);
  normalise(out, 0.4f);
  return out;
}

std::vector<float> over_push_loop() {
  constexpr double kEach = 0.2;  // [s] length of each tone
  std::vector<float> out(samples_in(2.0 * kEach));
  for (const int n : {0, 1}) tone(out, n * kEach, kEach, kOverPushTones[n]);
  normalise(out, 0.9f);
  return out;
}

std::vector<float> saturation_loop() {
  std::vector<float> out(samples_in(0.5));
  for (const int n : {0, 1, 2}) tone(out, n * 0.11, 0.06, kSaturationTone);
  normalise(out, 0.9f);
  return out;
}

}  // namespace gearshift::cabin
