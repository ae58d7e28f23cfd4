// Fuzzes the script of `gearshift drive`: TOML if the input begins with a bracket, CSV otherwise. The script must be
// read, or be rejected in one sentence that names the file. The pedals of a script that is read stay within 0 and 1.
#include <cmath>
#include <string>

#include "app/lab/drive/drive_script.h"
#include "haptics/files/file_error.h"
#include "tests/fuzz/fuzz_checks.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

bool is_fraction(double value) {
  return value >= 0.0 && value <= 1.0;
}

void check_row(const ScriptRow& row) {
  const Pedals& pedals = row.controls.pedals;
  check_invariant(is_fraction(pedals.throttle) && is_fraction(pedals.brake) && is_fraction(pedals.clutch) &&
                      is_fraction(pedals.hand_brake),
                  "pedals are within 0 and 1");
  check_invariant(std::abs(std::tan(row.controls.slope)) <= 1.0 + 1e-12, "the slope is at most 100 %");
  check_invariant(!row.lever || (std::abs(row.lever->x) <= 0.1 && std::abs(row.lever->y) <= 0.1),
                  "the lever is within 100 mm");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
  const std::string file = text.starts_with('[') ? "script.toml" : "script.csv";
  try {
    const DriveScript script = parse_drive_script(text, file);
    ++accepted_inputs;
    ScriptPlayer player(script);
    for (int i = -1; i <= 1000; ++i) check_row(player.at(script.end() * i / 999.0));
  } catch (const FileError& refusal) {  // the only exception allowed
    check_sentence(refusal, file + ":");
  }
  return 0;
}
