#include "app/runtime/devices/calibration_dialog.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift::runtime {
namespace {

// Parses "140" or "140 mm": a number with an optional unit.
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

class DialogRunner {
 public:
  DialogRunner(haptics::Calibrator& calibrator, const CalibrationDialog& dialog, const CalibrationTimes& times)
      : calibrator_(calibrator), dialog_(dialog), times_(times) {}

  void run_step(haptics::CalibrationStep step) {
    switch (step) {
      case haptics::CalibrationStep::range:
        return run_range();
      case haptics::CalibrationStep::numbers:
        return run_numbers();
      case haptics::CalibrationStep::polarity:
        return measure_hands_off(
            "This step measures in which direction the forces push. The stick moves a little, using at most a tenth of "
            "its force.",
            Needed::yes, [&] { return calibrator_.measure_polarity(); });
      case haptics::CalibrationStep::timing:
        return measure_hands_off(
            "This step measures how fast the stick responds. The stick shakes a little for a few seconds.", Needed::yes,
            [&] { return calibrator_.measure_timing(); });
      case haptics::CalibrationStep::handle:
        return measure_hands_off(
            "This step measures how heavy the handle is. The motors push the handle back and forth with up to 40 % of "
            "their force.",
            Needed::no, [&] { return calibrator_.measure_handle(); });
      case haptics::CalibrationStep::springs:
        return measure_hands_off(
            "This step measures the springs and dampers that the stick itself can render. The motors pull the handle "
            "to one side, hold it there, and then push it back and forth.",
            Needed::no, [&] { return calibrator_.measure_springs(); });
    }
  }

 private:
  enum class Needed { yes, no };

  // Repeats a measurement until it succeeds or is skipped. Returns true if it succeeded.
  template <class Measure>
  bool repeat_until_measured(const std::string& instruction, Needed needed, const Measure& measure) {
    const char* answers = needed == Needed::yes ? "[Enter to start]" : "[Enter to start, - to skip]";
    for (;;) {
      const std::string answer = dialog_.ask(instruction + " " + answers);
      if (needed == Needed::no && answer == "-") return false;
      if (!answer.empty()) {
        dialog_.print(
            fmt::format("\"{}\" is not a valid answer. {}", haptics::printable(answer),
                        needed == Needed::yes ? "Press Enter to start." : "Press Enter to start, or type - to skip."));
        continue;
      }
      try {
        dialog_.print("  Found: " + measure() + ".");
        return true;
      } catch (const haptics::CalibrationRefused& refused) {
        dialog_.print(fmt::format("  Rejected: {}. Try again.", refused.what()));
      }
    }
  }

  void save() const { dialog_.save(calibrator_.calibration()); }

  template <class Measure>
  void measure_hands_off(const std::string& instruction, Needed needed, const Measure& measure) {
    repeat_until_measured("HANDS OFF the stick: its motors will move it. " + instruction, needed, measure);
    save();  // even if the step was skipped: a part of it (e.g. the springs) may have been measured
  }

  // Finds the axes and buttons, then measures the range. A calibration without a range repeats this whole step, so the
  // range is measured last.
  void run_range() {
    dialog_.print("The motors stay off during this step.");
    repeat_until_measured(
        fmt::format(
            "Leave the stick at rest and press Enter. Then, within {:g} s, push the stick all the way to the RIGHT and "
            "hold it there.",
            times_.axis),
        Needed::yes, [&] { return calibrator_.find_axis(true, times_.axis); });
    repeat_until_measured(
        fmt::format("Press Enter. Then, within {:g} s, push the stick all the way FORWARD, away from you, and hold it "
                    "there.",
                    times_.axis),
        Needed::yes, [&] { return calibrator_.find_axis(false, times_.axis); });
    run_button(haptics::LeverButton::press, "to push the knob down, as for reverse in many cars");
    run_button(haptics::LeverButton::lift, "to lift the ring below the knob");
    run_button(haptics::LeverButton::stop, "to stop the motors in an emergency");
    repeat_until_measured(
        fmt::format(
            "Press Enter. Then move the stick along all its stops for {:g} s, and LET GO of it for the last two "
            "seconds.",
            times_.range),
        Needed::yes, [&] { return calibrator_.measure_range(times_.range); });
    save();
  }

  void run_button(haptics::LeverButton button, const char* purpose) {
    repeat_until_measured(
        fmt::format(
            "Choose the button on the stick that you will use {}. Press Enter, then press that button within {:g} s.",
            purpose, times_.button),
        Needed::no, [&] { return calibrator_.find_button(button, times_.button); });
  }

  double ask_number(const std::string& question, double min, double max, std::string_view unit) {
    for (;;) {
      const std::string answer = dialog_.ask(fmt::format("{} [{:g} to {:g} {}]", question, min, max, unit));
      const std::optional<double> number = number_of(answer, unit);
      if (number && *number >= min && *number <= max) return *number;
      dialog_.print(fmt::format("  Rejected: \"{}\" is not a number from {:g} to {:g} {}. Try again.",
                                haptics::printable(answer), min, max, unit));
    }
  }

  void run_numbers() {
    const double select =
        ask_number("How far does the knob travel from the left stop to the right stop?", 20, 500, "mm");
    const double shift =
        ask_number("How far does the knob travel from the back stop to the forward stop?", 20, 500, "mm");
    const double force = ask_number(
        "What is the stick's maximum force at the knob? Take the value from the data sheet (torque divided by lever "
        "length), or measure it with a spring scale.",
        0.5, 100, "N");
    dialog_.print("  Saved: " + calibrator_.set_numbers(1e-3 * select, 1e-3 * shift, force) + ".");
    save();
  }

  haptics::Calibrator& calibrator_;
  const CalibrationDialog& dialog_;
  const CalibrationTimes& times_;
};

}  // namespace

void calibrate(haptics::Calibrator& calibrator, bool springs, const CalibrationDialog& dialog,
               const CalibrationTimes& times) {
  DialogRunner runner(calibrator, dialog, times);
  for (const haptics::CalibrationStep step : haptics::missing_steps(calibrator.calibration(), springs))
    runner.run_step(step);
}

}  // namespace gearshift::runtime
