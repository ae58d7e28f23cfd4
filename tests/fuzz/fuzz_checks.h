// Checks for all harnesses: a violated invariant prints its name and aborts the program, which libFuzzer counts as a
// finding.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "haptics/files/printable.h"
#include "tests/support/temp_folder.h"

namespace gearshift::test {

inline int accepted_inputs = 0;  // number of inputs accepted; 0: the corpus tests only rejections

inline void check_invariant(bool condition, std::string_view name) {
  if (condition) return;
  std::fprintf(stderr, "broken: %.*s\n", static_cast<int>(name.size()), name.data());
  std::abort();
}

// Checks that an error message is one line of printable text and begins with `prefix`, the name of its subject.
inline void check_sentence(const std::exception& refusal, std::string_view prefix) {
  const std::string_view message = refusal.what();
  const bool is_sentence = message.starts_with(prefix) && message.size() > prefix.size() && message.size() < 4000;
  check_invariant(is_sentence && haptics::is_printable(message), "one sentence, not \"" + std::string(message) + '"');
}

// A temporary file with the fuzzed bytes, for readers that need a file.
class FuzzedFile {
 public:
  explicit FuzzedFile(const std::string& name) : path_(folder_ / name) {}
  const std::filesystem::path& put(std::string_view bytes) {
    std::filesystem::remove(path_);  // some file systems wait for the disk when a file is overwritten
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path_;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  TempFolder folder_;
  std::filesystem::path path_;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace gearshift::test
