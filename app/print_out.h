// What the program says to people and scripts. An output that is full, closed or whose reader is gone ends no lesson and
// no lever: `main` tells at the end that not all of it arrived.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace gearshift {

// output: stdout or stderr.
inline void print_to(std::FILE* output, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), output);
}

// On standard output, as it stands.
template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  print_to(stdout, fmt::format(format, std::forward<Values>(values)...));
}

// A line on standard output that somebody waits for.
inline void print_line(std::string_view line) {
  print_out("{}\n", line);
  std::fflush(stdout);
}

// On standard error, a line of its own: what went wrong, or what somebody at the terminal should know.
template <class... Values>
void print_problem(fmt::format_string<Values...> format, Values&&... values) {
  print_to(stderr, "gearshift: " + fmt::format(format, std::forward<Values>(values)...) + '\n');
}

}  // namespace gearshift
