#include "app/runtime/devices/calibration_dialog.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <glm/vec2.hpp>

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

// False if the step needs the result of an earlier one that was left out.
bool is_possible(haptics::CalibrationStep step, const haptics::DeviceCalibration& known) {
  switch (step) {
    case haptics::CalibrationStep::range:
      return true;
    case haptics::CalibrationStep::numbers:
    case haptics::CalibrationStep::polarity:
      return known.has_stops();
    case haptics::CalibrationStep::timing:
    case haptics::CalibrationStep::strength:
      return known.has_polarity();
    case haptics::CalibrationStep::handle:
    case haptics::CalibrationStep::springs:
      return known.has_polarity() && known.has_range() && known.has_force();
  }
  return true;
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
            "If the grip has a hand sensor, cover it with tape. This step measures in which direction the forces push. "
            "The stick moves a little, using at most a tenth of its force.",
            "the stick cannot be used", [&] { return calibrator_.measure_polarity(); });
      case haptics::CalibrationStep::timing:
        return measure_hands_off(
            "This step measures how fast the stick responds. The stick shakes a little for a few seconds.",
            "the stick cannot be used", [&] { return calibrator_.measure_timing(); });
      case haptics::CalibrationStep::strength:
        return measure_hands_off(
            "This step measures how strong the forces are. The motors push the handle for an instant with 5, 20, 60 "
            "and 100 % of their force.",
            "forces are as right as the stick's maker made them, and some sticks are far off",
            [&] { return calibrator_.measure_strength(); });
      case haptics::CalibrationStep::handle:
        return measure_hands_off(
            "This step measures how heavy the handle is. The motors push the handle back and forth with up to 40 % of "
            "their force.",
            "the handle is assumed to be light, and walls are softer than they could be",
            [&] { return calibrator_.measure_handle(); });
      case haptics::CalibrationStep::springs:
        return measure_hands_off(
            "This step measures the springs and dampers that the stick itself can render. The motors pull the handle "
            "to one side, hold it there, and then push it back and forth.",
            "walls are as soft as the stick's delay makes them", [&] { return calibrator_.measure_springs(); });
    }
  }

 private:
  static constexpr int kMaxTries = 3, kMaxAnswers = 20;

  // Repeats a measurement until it succeeds, is left out, or was rejected kMaxTries times. Returns true if it succeeded.
  // `cost`: what follows if it is left out.
  template <class Measure>
  bool repeat_until_measured(const std::string& instruction, const std::string& cost, const Measure& measure) {
    for (int tries = 0, answers = 0; tries < kMaxTries && answers < kMaxAnswers; ++answers) {
      const std::string answer =
          dialog_.ask(fmt::format("{} [Enter to start, - to leave it out: then {}]", instruction, cost));
      if (answer == "-") return false;
      if (!answer.empty()) {
        dialog_.print(fmt::format("\"{}\" is not a valid answer. Press Enter to start, or type - to leave it out.",
                                  haptics::printable(answer)));
        continue;
      }
      try {
        dialog_.print("  Found: " + measure() + ".");
        return true;
      } catch (const haptics::CalibrationRefused& refused) {
        const bool is_last = ++tries == kMaxTries;
        dialog_.print(fmt::format("  Rejected: {}. {}", refused.what(),
                                  is_last ? fmt::format("This step is left out: {}.", cost) : "Try again."));
      }
    }
    return false;
  }

  void save() const { dialog_.save(calibrator_.calibration()); }

  template <class Measure>
  void measure_hands_off(const std::string& instruction, const std::string& cost, const Measure& measure) {
    repeat_until_measured("HANDS OFF the stick: its motors will move it. " + instruction, cost, measure);
    save();  // even if the step was skipped: a part of it (e.g. the springs) may have been measured
  }

  // Finds the axes and buttons, then measures the range. A calibration without a range repeats this whole step, so the
  // range is measured last.
  void run_range() {
    constexpr const char* kCost = "the stick cannot be used";
    dialog_.print("The motors stay off during this step.");
    const bool has_axes =
        repeat_until_measured(
            fmt::format("Leave the stick at rest and press Enter. Then, within {:g} s, push the stick all the way to "
                        "the RIGHT and hold it there.",
                        times_.axis),
            kCost, [&] { return calibrator_.find_axis(true, times_.axis); }) &&
        repeat_until_measured(
            fmt::format("Press Enter. Then, within {:g} s, push the stick all the way FORWARD, away from you, and hold "
                        "it there.",
                        times_.axis),
            kCost, [&] { return calibrator_.find_axis(false, times_.axis); });
    if (!has_axes) return;
    run_button(haptics::LeverButton::press, "to push the knob down, as for reverse in many cars",
               "reverse gears behind that lock stay closed");
    run_button(haptics::LeverButton::lift, "to lift the ring below the knob",
               "reverse gears behind a ring stay closed");
    run_button(haptics::LeverButton::stop, "to stop the motors in an emergency", "only the program's own stop is left");
    repeat_until_measured(
        fmt::format(
            "Press Enter. Then move the stick along all its stops for {:g} s, and LET GO of it for the last two "
            "seconds.",
            times_.range),
        kCost, [&] { return calibrator_.measure_range(times_.range); });
    save();
  }

  void run_button(haptics::LeverButton button, const char* purpose, const char* cost) {
    repeat_until_measured(
        fmt::format(
            "Choose the button on the stick that you will use {}. Press Enter, then press that button within {:g} s.",
            purpose, times_.button),
        cost, [&] { return calibrator_.find_button(button, times_.button); });
  }

  // Repeats the question until it is answered with a number, or with two if `may_differ`: one for each axis. Empty if it
  // is left out or was answered otherwise kMaxAnswers times.
  std::optional<glm::dvec2> ask_numbers(const std::string& question, double min, double max, std::string_view unit,
                                        bool may_differ = false) {
    const auto is_within = [&](double number) { return number >= min && number <= max; };
    for (int answers = 0; answers < kMaxAnswers; ++answers) {
      const std::string answer = dialog_.ask(fmt::format(
          "{} [{:g} to {:g} {}, - to leave it out: then the stick cannot be used]", question, min, max, unit));
      if (answer == "-") return std::nullopt;
      if (const std::optional<double> one = number_of(answer, unit); one && is_within(*one)) return glm::dvec2(*one);
      for (std::size_t space = answer.find(' '); may_differ && space != answer.npos;
           space = answer.find(' ', space + 1)) {
        const std::optional<double> select = number_of(std::string_view(answer).substr(0, space), unit),
                                    shift = number_of(std::string_view(answer).substr(space), unit);
        if (select && shift && is_within(*select) && is_within(*shift)) return glm::dvec2(*select, *shift);
      }
      dialog_.print(fmt::format("  Rejected: \"{}\" is not {} from {:g} to {:g} {}. Try again.",
                                haptics::printable(answer), may_differ ? "one or two numbers" : "a number", min, max,
                                unit));
    }
    return std::nullopt;
  }

  void run_numbers() {
    const std::optional<glm::dvec2> select =
        ask_numbers("How far does the knob travel from the left stop to the right stop?", 20, 500, "mm");
    if (!select) return;
    const std::optional<glm::dvec2> shift =
        ask_numbers("How far does the knob travel from the back stop to the forward stop?", 20, 500, "mm");
    if (!shift) return;
    const std::optional<glm::dvec2> force = ask_numbers(
        "What is the stick's maximum force at the knob? Take the value from the data sheet (torque divided by lever "
        "length), or measure it with a spring scale. If it differs, type that to the right and then that forward, "
        "for example \"20 15\".",
        0.5, 100, "N", true);
    if (!force) return;
    dialog_.print("  Saved: " + calibrator_.set_numbers(1e-3 * glm::dvec2(select->x, shift->x), *force) + ".");
    save();
  }

  haptics::Calibrator& calibrator_;
  const CalibrationDialog& dialog_;
  const CalibrationTimes& times_;
};

}  // namespace

void calibrate(haptics::Calibrator& calibrator, const haptics::PidAbility& ability, const CalibrationDialog& dialog,
               const CalibrationTimes& times) {
  DialogRunner runner(calibrator, dialog, times);
  for (const haptics::CalibrationStep step :
       haptics::missing_steps(calibrator.calibration(), ability.spring, ability.damper)) {
    if (is_possible(step, calibrator.calibration())) runner.run_step(step);
  }
}

}  // namespace gearshift::runtime
