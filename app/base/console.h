// Console output. Output errors (full disk, closed stream or pipe) never interrupt the work; main() reports them at the
// end.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace gearshift::base {

// Prints to `output`, which is stdout or stderr.
inline void print_to(std::FILE* output, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), output);
}

// Prints to standard output, without adding a line feed.
template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  print_to(stdout, fmt::format(format, std::forward<Values>(values)...));
}

// Prints a line to standard output and flushes it, because a user or script is waiting for the line.
inline void print_line(std::string_view line) {
  print_out("{}\n", line);
  std::fflush(stdout);
}

// Hides what libraries print to standard error while it exists; our own messages are still printed. Only one may exist at
// a time. All those who redirect standard error must do it on one thread, or one after the other.
class QuietLibraries {
 public:
  QuietLibraries();
  ~QuietLibraries();
  QuietLibraries(const QuietLibraries&) = delete;
  QuietLibraries& operator=(const QuietLibraries&) = delete;

 private:
  int saved_;
};

std::FILE* message_output() noexcept;  // standard error, also while QuietLibraries hides it

// Prints a line to standard error; for errors and for messages that are not part of the results.
template <class... Values>
void print_message(fmt::format_string<Values...> format, Values&&... values) {
  print_to(message_output(), "gearshift: " + fmt::format(format, std::forward<Values>(values)...) + '\n');
}

}  // namespace gearshift::base
