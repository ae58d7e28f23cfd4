#include "app/base/line_reader.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <utility>

namespace gearshift::base {

std::optional<std::string> LineReader::take_line() {
  const std::size_t end = buffer_.find('\n');
  if (end == std::string::npos) {
    if (!at_end_ || buffer_.empty()) return std::nullopt;
    return std::exchange(buffer_, {});
  }
  std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end + 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

void LineReader::read_more(int milliseconds) {
  pollfd wanted{file_, POLLIN, 0};
  if (poll(&wanted, 1, milliseconds) <= 0) return;
  char bytes[256];
  const ssize_t count = read(file_, bytes, sizeof bytes);
  if (count > 0) buffer_.append(bytes, static_cast<std::size_t>(count));
  at_end_ = count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN);
}

std::optional<std::string> LineReader::read_line(double seconds) {
  if (std::optional<std::string> line = take_line()) return line;
  const int milliseconds = static_cast<int>(std::ceil(1e3 * seconds));
  if (at_end_) {
    // Wait the full time even at the end of the input, because callers rely on this wait to limit the rate of their
    // loops.
    poll(nullptr, 0, milliseconds);
    return std::nullopt;
  }
  read_more(milliseconds);
  return take_line();
}

}  // namespace gearshift::base
