// Fuzzes read_gltf(): any bytes must be rejected in one sentence or give a valid model. The mutator keeps the lengths
// in the .glb header consistent, because nearly every input would be rejected at its header otherwise.
#include <algorithm>
#include <cstring>
#include <random>
#include <string>

#include "tests/engine/model/gltf_everything.h"
#include "tests/engine/model/model_laws.h"
#include "tests/fuzz/fuzz_checks.h"

using namespace gearshift::engine;
using namespace gearshift::test;

// libFuzzer requires these names.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

std::size_t integer_at(const std::uint8_t* at) {
  std::uint32_t value = 0;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::string mutated(std::string bytes, std::size_t max_growth) {
  const std::size_t size = bytes.size();
  bytes.resize(size + max_growth);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
  return bytes;
}

std::string assembled(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto little_endian = GltfMaker::little_endian;
  return "glTF" + little_endian(2) + little_endian(28 + json.size() + binary.size()) + little_endian(json.size()) +
         "JSON" + json + little_endian(binary.size()) + std::string("BIN\0", 4) + binary;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  const std::size_t json_size = size < 28 ? 0 : integer_at(data + 12);
  std::string file;
  const bool is_glb = json_size > 0 && json_size <= size - 28 && text_of(data, size).starts_with("glTF");
  // Sometimes mutates the bytes without regard to the .glb structure. Does so more often for a .gltf, which is plain
  // text.
  if (random() % (is_glb ? 8 : 2) == 0) return LLVMFuzzerMutate(data, size, max_size);
  if (!is_glb) {
    file = everything().glb();
  } else {
    std::string json(reinterpret_cast<const char*>(data) + 20, json_size);
    std::string binary(reinterpret_cast<const char*>(data) + 28 + json_size, size - 28 - json_size);
    std::string& part = random() % 3 == 0 ? binary : json;
    part = mutated(part, 64);
    file = assembled(json, binary);
  }
  if (file.size() > max_size) file.resize(max_size);
  std::copy(file.begin(), file.end(), data);
  return file.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static FuzzedFile file("model.glb");
  try {
    check_invariant(is_valid(read_gltf(file.put(text_of(data, size)))), "data that was read is valid");
    ++accepted_inputs;
  } catch (const GltfError& refusal) {  // the only exception allowed
    check_sentence(refusal, file.path().string() + ":");
  }
  return 0;
}
// NOLINTEND(readability-identifier-naming)
