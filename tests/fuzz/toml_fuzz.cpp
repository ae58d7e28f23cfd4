// Fuzzes every kind of TOML file that users or the program write. The file must be read, or be rejected in one sentence
// that names the file. If the program can write this kind, the contents are written and must be read back the same. The
// first letter of the input selects the kind: Bindings, Car, Device's calibration, Gate, Headset's seat, Lesson,
// Preset.
#include <cmath>

#include "app/cabin/headset/seat_file.h"
#include "app/lessons/assessment/lesson.h"
#include "app/ui/input/bindings.h"
#include "app/vehicle/driveline.h"
#include "engine/window/window.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/hardware/device_calibration.h"
#include "haptics/loop/preset.h"
#include "tests/fuzz/toml_inputs.h"

using namespace gearshift::cabin;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::ui;
using namespace gearshift::vehicle;

// The harness is linked without the window library, so keys have the labels of a US keyboard.
std::string gearshift::engine::printed_key(int) {
  return {};
}

namespace {

constexpr const char* kFile = "read.toml";

void read_gate(std::string_view text) {
  const GateLayout layout = parse_gate_layout(text, kFile);
  check_invariant(layout.text == text, "a layout keeps its text");
}

void read_car(std::string_view text) {
  const CarSpec car = parse_car(text, kFile);
  for (const double speed : {-1e3, 0.0, 50.0, 300.0, 1e4}) {
    check_invariant(std::isfinite(full_torque(car.engine, speed)), "torque is a number");
    check_invariant(std::isfinite(friction_torque(car.engine, speed)), "friction is a number");
  }
  for (const double pedal : {0.0, 0.5, 1.0}) {
    const double carried = clutch_capacity(car.clutch, pedal);
    check_invariant(carried >= 0.0 && carried <= car.clutch.capacity, "a clutch carries its capacity");
  }
  for (int gear = kReverseGear; gear <= kMaxGear; ++gear) {
    check_invariant(std::isfinite(shaft_per_road(car, gear)), "a ratio is a number");
  }
}

void read_a_lesson(std::string_view text) {
  const Lesson lesson = parse_lesson(text, kFile);
  check_invariant(!lesson.steps.empty(), "a lesson has steps");
  check_invariant(is_printable(failing_errors_sentence(lesson)),
                  "the errors that fail a lesson are described in one line");
}

void read_a_preset(std::string_view text) {
  const std::string first = preset_text(parse_preset(text, kFile));
  check_invariant(preset_text(parse_preset(first, kFile)) == first, "a preset is written and read back the same");
}

void read_keys(std::string_view text) {
  const Bindings bindings = parse_bindings(text, kFile);
  const std::string first = bindings_text(bindings);
  const Bindings reread = parse_bindings(first, kFile);
  check_invariant(bindings_text(reread) == first && help_text(reread, {}) == help_text(bindings, {}),
                  "bindings are written and read back");
}

void read_device(std::string_view text) {
  const std::string first = calibration_text(parse_calibration(text, kFile));
  check_invariant(calibration_text(parse_calibration(first, kFile)) == first, "a calibration is written and read back");
}

// Orientations are compared with a tolerance: writing converts the orientation's quaternion to an angle, which may
// change the last bits.
void read_a_seat(std::string_view text) {
  const SeatSettings seat = parse_seat(text, kFile);
  const SeatSettings reread = parse_seat(seat_text(seat), kFile);
  check_invariant(reread.drive == seat.drive && reread.height == seat.height &&
                      reread.touch_error == seat.touch_error && reread.knob.has_value() == seat.knob.has_value() &&
                      reread.touched.has_value() == seat.touched.has_value(),
                  "a seat is written and read back");
  if (seat.knob)
    check_invariant(reread.knob->right == seat.knob->right && reread.knob->down == seat.knob->down &&
                        reread.knob->ahead == seat.knob->ahead,
                    "a knob is written and read back");
  if (!seat.touched) return;
  check_invariant(reread.touched->position == seat.touched->position, "a touched position is written and read back");
  // The quaternions q and -q are the same rotation, hence the absolute value.
  const double alignment = std::abs(glm::dot(reread.touched->orientation, seat.touched->orientation));
  check_invariant(alignment > 1.0 - 1e-12, "an orientation is written and read back");
}

void read_as(char kind, std::string_view text) {
  switch (kind) {
    case 'B':
      return read_keys(text);
    case 'C':
      return read_car(text);
    case 'D':
      return read_device(text);
    case 'G':
      return read_gate(text);
    case 'H':
      return read_a_seat(text);
    case 'L':
      return read_a_lesson(text);
    case 'P':
      return read_a_preset(text);
  }
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): libFuzzer requires these names
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  return mutate_toml(data, size, max_size, seed, 1);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    read_as(static_cast<char>(data[0]), text_of(data + 1, size - 1));
    ++accepted_inputs;
  } catch (const FileError& refusal) {  // the only exception allowed
    check_sentence(refusal, kFile + std::string(":"));
  }
  return 0;
}
// NOLINTEND(readability-identifier-naming)
