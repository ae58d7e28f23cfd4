// Runs a fuzz harness without libFuzzer, on every file of the given folders.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/fuzz_checks.h"

namespace fs = std::filesystem;

// NOLINTBEGIN(readability-identifier-naming,readability-redundant-declaration): libFuzzer requires these names
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
// Stub for libFuzzer's function: without libFuzzer, inputs are not mutated.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t*, std::size_t size, std::size_t) {
  return size;
}
// NOLINTEND(readability-identifier-naming,readability-redundant-declaration)

int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape): an exception fails the test
  int inputs = 0;
  for (int i = 1; i < argc; ++i) {
    for (const fs::directory_entry& entry : fs::directory_iterator(argv[i])) {
      std::printf("%s\n", entry.path().c_str());
      std::fflush(stdout);  // flushes the name, so that it is printed even if this input crashes
      std::ifstream in(entry.path(), std::ios::binary);
      const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
      std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
      LLVMFuzzerTestOneInput(data.data(), data.size());
      ++inputs;
    }
  }
  std::printf("%d inputs, %d read whole\n", inputs, gearshift::test::accepted_inputs);
  return inputs > 0 ? 0 : 1;
}
