#include "app/lab/campaign/broken_laws.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <system_error>

#include <fmt/core.h>

#include "haptics/files/atomic_file.h"
#include "haptics/files/printable.h"

namespace gearshift::lab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReplayCommand = "gearshift train --replay ";
// [s] The replay starts this long before the violation, so that it includes the motion that the law has measured.
constexpr double kLeadTime = 2.0;
constexpr std::size_t kMaxLines = 100;  // maximum number of lines to read, in case another program wrote the file

fs::path text_file_of(fs::path trace) {
  return trace.replace_extension(".txt");
}

std::string line_of(const BrokenLaw& one, std::uint64_t campaign_seed) {
  const LawText& law_info = law_text(one.law);
  return fmt::format("case {} of seed {} violates {} ({}): {:.4g} {}, bound {:.4g}, at {:.3f} s", one.number,
                     campaign_seed, std::string(law_info.name), std::string(law_info.requirement), one.result.value,
                     std::string(law_info.unit), one.result.bound, one.result.time);
}

// Start time for the replay command, rounded down to 0.1 s. [s]
double replay_start(double time) {
  return std::floor(10.0 * std::max(0.0, time - kLeadTime)) / 10.0;
}

// Quotes a path so that a shell reads it as one word.
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

void write_broken_laws(const fs::path& trace, std::uint64_t campaign_seed, std::span<const BrokenLaw> broken) {
  const std::string name = trace.filename().string();
  std::string text;
  for (const BrokenLaw& one : broken)
    text += fmt::format("{}: {}\n{}{} --from {:.1f}\n", name, line_of(one, campaign_seed), kReplayCommand, name,
                        replay_start(one.result.time));
  std::error_code ignored;
  if (text.empty()) {
    fs::remove(text_file_of(trace), ignored);
  } else {
    haptics::write_text_file(text_file_of(trace), text);
  }
}

std::string broken_laws_text(const fs::path& trace) {
  const fs::path file = text_file_of(trace);
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  const std::string name_prefix = trace.filename().string() + ": ",
                    command_prefix = kReplayCommand + trace.filename().string() + " ";
  std::ifstream in(file);
  std::string text;
  std::size_t lines = 0;
  for (std::string line; lines < kMaxLines && std::getline(in, line); ++lines) {
    if (line.starts_with(name_prefix)) text += haptics::printable(line) + "\n";
    if (line.starts_with(command_prefix))
      text +=
          haptics::printable(kReplayCommand + shell_word(trace.string()) + " " + line.substr(command_prefix.size())) +
          "\n";
  }
  return text;
}

}  // namespace gearshift::lab
