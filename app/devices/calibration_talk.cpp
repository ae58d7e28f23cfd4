#include "app/devices/calibration_talk.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift {
namespace {

// "140", "140 mm": a number, and its unit where it is said.
std::optional<double> number_of(std::string_view text, std::string_view unit) {
  const auto trim = [&text] {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  };
  trim();
  if (text.ends_with(unit)) text.remove_suffix(unit.size());
  trim();
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

class Talk {
 public:
  Talk(Calibrator& calibrator, const CalibrationTalk& talk, const CalibrationTimes& times)
      : calibrator_(calibrator), talk_(talk), times_(times) {}

  void take(CalibrationStep step) {
    switch (step) {
      case CalibrationStep::range:
        return take_range();
      case CalibrationStep::numbers:
        return take_numbers();
      case CalibrationStep::polarity:
        return hands_off("Which way its forces push: it moves by itself, a little, with at most a tenth of its force.",
                         Needed::yes, [&] { return calibrator_.measure_polarity(); });
      case CalibrationStep::timing:
        return hands_off("How fast it answers: it shakes a little for some seconds.", Needed::yes,
                         [&] { return calibrator_.measure_timing(); });
      case CalibrationStep::handle:
        return hands_off("How heavy its handle is: it is pushed to and fro, with up to four tenths of its force.",
                         Needed::no, [&] { return calibrator_.measure_handle(); });
      case CalibrationStep::springs:
        return hands_off(
            "How its own springs and dampers push: it is drawn to a side and held there, then pushed to and fro.",
            Needed::no, [&] { return calibrator_.measure_springs(); });
    }
  }

 private:
  enum class Needed { yes, no };

  // Again and again until something was found, or is left out. Returns whether it was found.
  template <class Measure>
  bool try_out(const std::string& instruction, Needed needed, const Measure& measure) {
    const char* answers = needed == Needed::yes ? "[Enter begins]" : "[Enter begins, - leaves it out]";
    for (;;) {
      const std::string answer = talk_.ask(instruction + " " + answers);
      if (needed == Needed::no && answer == "-") return false;
      if (!answer.empty()) {
        talk_.say(fmt::format("\"{}\" is no answer here.", printable(answer)));
        continue;
      }
      try {
        talk_.say("  Found: " + measure() + ".");
        return true;
      } catch (const CalibrationRefused& refused) {
        talk_.say(fmt::format("  Not taken: {}. Once more.", refused.what()));
      }
    }
  }

  void keep() const { talk_.keep(calibrator_.calibration()); }

  template <class Measure>
  void hands_off(const std::string& what, Needed needed, const Measure& measure) {
    try_out("HANDS OFF the stick, its motors will move it. " + what, needed, measure);
    keep();  // of what was left out, too: its springs may be known and its dampers not
  }

  // The buttons before the range: until that is known, all of it is asked again.
  void take_range() {
    talk_.say("Its motors stay off now.");
    try_out(fmt::format("Let the stick stand still. Then, within {:g} s, push it to the RIGHT as far as it goes and "
                        "hold it there.",
                        times_.axis),
            Needed::yes, [&] { return calibrator_.find_axis(true, times_.axis); });
    try_out(fmt::format("The same FORWARD, away from you, within {:g} s.", times_.axis), Needed::yes,
            [&] { return calibrator_.find_axis(false, times_.axis); });
    take_button(LeverButton::press, "that pushes the knob down, as for reverse in many cars");
    take_button(LeverButton::lift, "that lifts the ring");
    take_button(LeverButton::stop, "that switches the motors off at once");
    try_out(fmt::format("Move the stick round along all its ends, for {:g} s, and LET GO of it in the last two.",
                        times_.range),
            Needed::yes, [&] { return calibrator_.measure_range(times_.range); });
    keep();
  }

  void take_button(LeverButton button, const char* does) {
    try_out(fmt::format("Press the button of the stick {}, within {:g} s.", does, times_.button), Needed::no,
            [&] { return calibrator_.find_button(button, times_.button); });
  }

  double ask_number(const std::string& question, double least, double most, std::string_view unit) {
    for (;;) {
      const std::string answer = talk_.ask(fmt::format("{} [{:g} to {:g} {}]", question, least, most, unit));
      const std::optional<double> number = number_of(answer, unit);
      if (number && *number >= least && *number <= most) return *number;
      talk_.say(fmt::format("  Not taken: \"{}\" is no number from {:g} to {:g} {}. Once more.", printable(answer),
                            least, most, unit));
    }
  }

  void take_numbers() {
    const double select = ask_number("How far does the knob go from the left stop to the right one?", 20, 500, "mm");
    const double shift = ask_number("And from the back stop to the forward one?", 20, 500, "mm");
    const double force =
        ask_number("How strong is it at the knob at most, by its data sheet (torque over length) or a spring scale?",
                   0.5, 100, "N");
    talk_.say("  Taken: " + calibrator_.set_numbers(1e-3 * select, 1e-3 * shift, force) + ".");
    keep();
  }

  Calibrator& calibrator_;
  const CalibrationTalk& talk_;
  const CalibrationTimes& times_;
};

}  // namespace

void calibrate(Calibrator& calibrator, bool springs, const CalibrationTalk& talk, const CalibrationTimes& times) {
  Talk one(calibrator, talk, times);
  for (const CalibrationStep step : missing_steps(calibrator.calibration(), springs)) one.take(step);
}

}  // namespace gearshift
