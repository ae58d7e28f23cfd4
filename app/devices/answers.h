// Lines of a person or a script at a terminal, a pipe or a file, waited for no longer than asked.
#pragma once

#include <optional>
#include <string>

namespace gearshift {

class Answers {
 public:
  explicit Answers(int file) noexcept : file_(file) {}  // a file descriptor, not owned

  // The next line without its end, within so much time [s]; 0 only looks. Nothing where none came, and at the end, where
  // the time passes all the same: what is left there without a line's end is a line. A signal ends the wait.
  std::optional<std::string> line(double seconds);
  bool ended() const noexcept { return ended_ && buffer_.empty(); }

 private:
  std::optional<std::string> take_line();
  void read_more(int milliseconds);

  int file_;
  std::string buffer_;
  bool ended_ = false;
};

}  // namespace gearshift
