// What every harness asks: a law that is broken ends the program with its name, which is what libFuzzer takes for a finding.
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

namespace gearshift {

inline int read_whole = 0;  // inputs that were not refused: a corpus of none tests refusals alone

inline void hold(bool law, std::string_view name) {
  if (law) return;
  std::fprintf(stderr, "broken: %.*s\n", static_cast<int>(name.size()), name.data());
  std::abort();
}

// A refusal: one line that a terminal may show, and of what.
inline void hold_sentence(const std::exception& refusal, std::string_view begins) {
  const std::string_view words = refusal.what();
  const bool is_sentence = words.starts_with(begins) && words.size() > begins.size() && words.size() < 4000;
  hold(is_sentence && is_printable(words), "one sentence, not \"" + std::string(words) + '"');
}

// The bytes where a reader wants a file.
class FuzzedFile {
 public:
  explicit FuzzedFile(const std::string& name) : path_(folder_ / name) {}
  const std::filesystem::path& put(std::string_view bytes) {
    std::filesystem::remove(path_);  // some file systems wait for the disk when a file is written anew
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

}  // namespace gearshift
