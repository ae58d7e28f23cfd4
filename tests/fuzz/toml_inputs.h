// Mutates TOML files line by line, so that most of them still are TOML: lines are copied, removed and swapped, keys and
// values exchanged, and values changed to hostile ones.
#pragma once

#include <algorithm>
#include <cstring>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_checks.h"

// NOLINTBEGIN(readability-identifier-naming): libFuzzer requires these names
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace gearshift::test {

inline std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    lines.emplace_back(text.substr(0, end + 1));
    text.remove_prefix(end + 1);
  }
  return lines;
}

inline std::string bytes_mutated(std::string text) {
  const std::size_t size = text.size();
  text.resize(size + 16);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size()));
  return text;
}

inline std::string mutated_line(const std::string& line, const std::string& other, std::minstd_rand& random) {
  static constexpr const char* kValues[] = {
      "0",    "-1", "1e308", "-1e308", "1e-308",      "nan",        "-inf",   "0.1",
      "true", "[]", "{}",    "\"\"",   "\"\\u202e\"", "1979-05-27", "[1, 2]", "99999999999999999999"};
  const std::size_t equals = line.find('='), other_equals = other.find('=');
  if (equals == std::string::npos || other_equals == std::string::npos) return bytes_mutated(line);
  switch (random() % 4) {
    case 0:
      return line.substr(0, equals) + other.substr(other_equals);
    case 1:
      return other.substr(0, other_equals) + line.substr(equals);
    case 2:
      return line.substr(0, equals) + "= " + kValues[random() % std::size(kValues)] + '\n';
    default:
      return line.substr(0, equals + 1) + bytes_mutated(line.substr(equals + 1));
  }
}

inline std::string toml_mutated(std::string_view text, std::minstd_rand& random) {
  std::vector<std::string> lines = lines_of(text);
  if (lines.empty()) return bytes_mutated({});
  const auto any = [&] { return random() % lines.size(); };
  const std::size_t chosen = any();
  switch (random() % 6) {
    case 0: {
      const std::string copied = lines[chosen];
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(any()), copied);
      break;
    }
    case 1:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(chosen));
      break;
    case 2:
      std::swap(lines[chosen], lines[any()]);
      break;
    default:
      lines[chosen] = mutated_line(lines[chosen], lines[any()], random);
  }
  std::string file;
  for (const std::string& line : lines) file += line;
  return file;
}

// Mutates an input whose first `kept` bytes are no TOML.
inline std::size_t mutate_toml(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed,
                               std::size_t kept) {
  std::minstd_rand random(seed);
  if (size <= kept || random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::string file = toml_mutated(text_of(data + kept, size - kept), random);
  const std::size_t copied = std::min(file.size(), max_size - kept);
  std::memcpy(data + kept, file.data(), copied);
  return kept + copied;
}

}  // namespace gearshift::test
// NOLINTEND(readability-identifier-naming)
