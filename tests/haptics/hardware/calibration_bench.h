// An emulated stick, its user and the calibrator, on a virtual clock.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <glm/geometric.hpp>

#include "haptics/hardware/calibrator.h"
#include "tests/haptics/hardware/showing_hand.h"
#include "tests/haptics/hardware/stick_bench.h"

namespace gearshift::test {

// While the calibrator measures, it advances the virtual clock tick by tick.
struct CalibrationBench : StickBench {
  explicit CalibrationBench(const EmulatedStickConfig& config, const haptics::DeviceCalibration& known = {})
      : StickBench(config, person),
        calibrator((prepare(), driver),
                   [this] {
                     tick();
                     strongest = std::max(strongest, glm::length(stick.force()));
                     if (every_tick) every_tick();
                     return now_ns;
                   },
                   known) {
    stick.logs = false;
  }

  void move_along(
      const std::function<glm::dvec2(double)>& path) {  // `path`: position [m] at a time [s] since this call
    person.target_position = [this, path, begin = time()] { return path(time() - begin); };
  }
  void hands_off() { person.target_position = nullptr; }

  // `is_swapped`: the user moves the stick forward when asked for the right, and right when asked for forward.
  void find_axes(bool is_swapped = false) {
    for (const bool is_select : {true, false}) {
      const glm::dvec2 way = is_select != is_swapped ? glm::dvec2(0.060, 0.0) : glm::dvec2(0.0, 0.060);
      move_along([way](double t) { return t < 0.6 ? glm::dvec2(0.0) : way; });
      calibrator.find_axis(is_select, 2.0);
    }
  }
  std::string measure_all_stops() {
    move_along([](double t) { return 0.090 * glm::dvec2(std::cos(3.0 * t), std::sin(3.0 * t)); });
    every_tick = [this, begin = time()] {
      if (time() - begin > 4.0) hands_off();
    };
    std::string sentence = calibrator.measure_range(5.0);
    every_tick = nullptr;
    return sentence;
  }

  ShowingHand person;
  double strongest = 0.0;  // [N]
  std::function<void()> every_tick;
  haptics::Calibrator calibrator;
};

}  // namespace gearshift::test
