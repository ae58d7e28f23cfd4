// Reads lines that a user or a script sends through a terminal, a pipe or a file, with a time limit.
#pragma once

#include <optional>
#include <string>

namespace gearshift::base {

class LineReader {
 public:
  explicit LineReader(int file) noexcept : file_(file) {}  // file: descriptor that the caller keeps open

  // Returns the next line without its line end. Waits at most `seconds` for it; a signal ends the wait. Returns nothing
  // if no line has arrived or the input has ended. At the end of the input, too, the call takes the full time. A last
  // line without a line end counts as a line.
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
