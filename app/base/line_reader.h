// Reads lines that a user or a script sends through a terminal, a pipe or a file, with a time limit.
#pragma once

#include <optional>
#include <string>

namespace gearshift::base {

class LineReader {
 public:
  explicit LineReader(int file) noexcept : file_(file) {}  // file descriptor, not owned

  // Returns the next line without its line end; waits at most so long [s], and not at all for 0. Empty if no line came
  // or at the end of the input; there the full time passes as well. A last line without a line end counts as a line. A
  // signal ends the wait.
  std::optional<std::string> read_line(double seconds);
  bool at_end() const noexcept { return at_end_ && buffer_.empty(); }

 private:
  std::optional<std::string> take_line();
  void read_more(int milliseconds);

  int file_;
  std::string buffer_;
  bool at_end_ = false;
};

}  // namespace gearshift::base
