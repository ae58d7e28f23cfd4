// Fuzzes the compiler of gates. A gate must compile, or be rejected in one sentence that names the file.
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"
#include "tests/fuzz/toml_inputs.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

// NOLINTBEGIN(readability-identifier-naming): libFuzzer requires these names
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  return mutate_toml(data, size, max_size, seed, 0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kFile = "gate.toml";
  constexpr double kHalf = 0.08;  // [m] about half the travel of the paper's joystick
  try {
    const Gate gate = compile_gate(parse_gate_layout(text_of(data, size), kFile), {kHalf, kHalf});
    check_invariant(!slots(gate).empty(), "a gate has slots");
    ++accepted_inputs;
  } catch (const FileError& refusal) {  // the only exception allowed
    check_sentence(refusal, kFile + std::string(":"));
  }
  return 0;
}
// NOLINTEND(readability-identifier-naming)
