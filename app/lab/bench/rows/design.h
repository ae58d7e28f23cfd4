// The design's requirements for performance. Each bench row names the requirement that it answers.
#pragma once

#include <array>
#include <string_view>

namespace gearshift::lab {

enum class Design {
  none,  // the bench row answers no requirement
  cycle,
  headless,
  jitter,
  wall,
  energy,
  delivered,
  boundary,
  intent,
  plant,
  first_frame,
  cabin,
  projected,
  driveline,
  score
};

struct DesignRow {
  Design key = Design::none;
  std::string_view name;    // name of `key` in files
  std::string_view what;    // the required quantity
  std::string_view figure;  // its required value
};

inline constexpr std::array<DesignRow, 14> kDesignRows{{
    {Design::cycle, "cycle", "whole haptic cycle on a tour, at least 30 % of it in contact",
     "p50 at most 150 ns, p99 at most 400 ns"},
    {Design::headless, "headless", "headless simulation at 1 kHz, one core",
     "3500 x real time; 2200 x with the driveline; 1300 x for a whole lesson"},
    {Design::jitter, "jitter", "wake-up lateness of the loop thread, alone and under load",
     "p99 and p99.9 at most 1.2 x cyclictest's"},
    {Design::wall, "wall", "5000 N/m wall under 4 to 30 N, every hand: final peak-to-peak motion",
     "p95 and maximum at most 0.04 and 0.08 mm at 2 kHz, 0.06 and 0.09 mm at 1 kHz, 0.10 and 0.12 mm at 500 Hz or with "
     "one sample of delay, with 95 % of the stiffness displayed; otherwise p95 at most 0.12 mm; no hand of 0.02 to "
     "2.5 kg above 0.15 mm"},
    {Design::energy, "energy", "energy that the wall adds to an impact, worst case",
     "none at 13 rates and delays up to 12.5 ms, nor on device walls; with energy bounding, never more than the "
     "damping dissipated"},
    {Design::delivered, "delivered", "tip force against a steady push; force along a slot", "within 3 %"},
    {Design::boundary, "boundary", "predicted stability boundary against simulated divergence, 100 random levers",
     "within 2 %"},
    {Design::intent, "intent", "the intended gear is reached, 10,000 noisy aims, every gate", "at least 99 %"},
    {Design::plant, "plant", "simulated plant compared with the closed form", "1e-12 relative"},
    {Design::first_frame, "first_frame", "start to first frame, cabin loaded", "below 1 s"},
    {Design::cabin, "cabin", "time per frame at 1280x720, one sample",
     "cabin at most 60 ms; 222,000 untextured triangles at most 104 ms"},
    {Design::projected, "projected", "projected points of each eye", "within 0.1 px of the closed form"},
    {Design::driveline, "driveline", "momentum and energy balance; lock-up time and slip energy at 1 ms",
     "exact to rounding; within 0.01 % of the closed form"},
    {Design::score, "score", "grade of practised simulated drivers against others, each lesson",
     "AUC at least 0.95 at error 0.6, 0.80 at 0.3; 95 % of the practised and at most 20 % at 0.6 pass"},
}};

}  // namespace gearshift::lab
