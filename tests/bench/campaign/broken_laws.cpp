#include "tests/bench/campaign/broken_laws.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <system_error>

#include <fmt/core.h>

#include "haptics/files/part_file.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShows = "gearshift train --replay ";
constexpr double kBefore = 2.0;         // [s] that are seen before the moment: what a hold is judged by
constexpr std::size_t kMostTold = 100;  // lines: whatever text lies there

fs::path text_beside(fs::path trace) {
  return trace.replace_extension(".txt");
}

std::string line_of(const LawBroken& one, std::uint64_t campaign_seed) {
  const LawWords& words = law_words(one.law);
  return fmt::format("case {} of seed {} breaks {} ({}): {:.4g} {}, bound {:.4g}, at {:.3f} s", one.number,
                     campaign_seed, std::string(words.name), std::string(words.says), one.seen.value,
                     std::string(words.unit), one.seen.bound, one.seen.time);
}

// [s] to a tenth.
double seen_from(double time) {
  return std::floor(10.0 * std::max(0.0, time - kBefore)) / 10.0;
}

// A path as a shell takes it for one word.
std::string shell_word(const std::string& text) {
  const bool is_plain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '/' || c == '.' || c == '_' || c == '-' || c >= 0x80;
  });
  if (is_plain) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

void tell_broken(const fs::path& trace, std::uint64_t campaign_seed, std::span<const LawBroken> broken) {
  const std::string name = trace.filename().string();
  std::string text;
  for (const LawBroken& one : broken)
    text += fmt::format("{}: {}\n{}{} --from {:.1f}\n", name, line_of(one, campaign_seed), kShows, name,
                        seen_from(one.seen.time));
  std::error_code nothing_there;
  if (text.empty()) {
    fs::remove(text_beside(trace), nothing_there);
  } else {
    write_text_file(text_beside(trace), text);
  }
}

std::string told_of(const fs::path& trace) {
  const fs::path beside = text_beside(trace);
  std::error_code error;
  if (!fs::is_regular_file(beside, error)) return {};
  const std::string says = trace.filename().string() + ": ", shows = kShows + trace.filename().string() + " ";
  std::ifstream in(beside);
  std::string text;
  std::size_t lines = 0;
  for (std::string line; lines < kMostTold && std::getline(in, line); ++lines) {
    if (line.starts_with(says)) text += printable(line) + "\n";
    if (line.starts_with(shows))
      text += printable(kShows + shell_word(trace.string()) + " " + line.substr(shows.size())) + "\n";
  }
  return text;
}

}  // namespace gearshift
