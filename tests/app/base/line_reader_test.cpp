// LineReader on a pipe: lines arrive complete and in order, and no read waits longer than its timeout.
#include "app/base/line_reader.h"

#include <unistd.h>

#include <array>
#include <chrono>
#include <string_view>

#include <doctest/doctest.h>

using namespace gearshift::base;

namespace {

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() { REQUIRE(pipe(ends.data()) == 0); }
  ~Pipe() {
    close(ends[0]);
    close_end();
  }
  void write_text(std::string_view text) { REQUIRE(write(ends[1], text.data(), text.size()) == ssize_t(text.size())); }
  void close_end() {
    if (ends[1] >= 0) close(ends[1]);
    ends[1] = -1;
  }
};

}  // namespace

TEST_CASE("lines arrive one by one however the pipe splits them, and the end of file ends the last one") {
  Pipe pipe;
  LineReader answers(pipe.ends[0]);
  CHECK_FALSE(answers.read_line(0.0).has_value());
  pipe.write_text("70");
  CHECK_FALSE(answers.read_line(0.0).has_value());
  CHECK_FALSE(answers.at_end());
  pipe.write_text(" mm\r\n\nle");
  CHECK(answers.read_line(1.0) == "70 mm");
  CHECK(answers.read_line(1.0) == "");
  CHECK_FALSE(answers.read_line(0.0).has_value());
  pipe.write_text("ft");
  pipe.close_end();
  while (!answers.at_end()) {
    if (const auto line = answers.read_line(1.0)) CHECK(*line == "left");
  }
  CHECK_FALSE(answers.read_line(1.0).has_value());
}

// At the end of the input, a read must still wait for its timeout. Otherwise a caller that polls would occupy the core
// that the haptic loop needs.
TEST_CASE("at the end of the input a read still waits for its timeout; an unreadable file counts as ended") {
  const auto waits = [](LineReader& answers) {
    const auto begin = std::chrono::steady_clock::now();
    CHECK_FALSE(answers.read_line(0.05).has_value());
    return std::chrono::steady_clock::now() - begin >= std::chrono::milliseconds(50);
  };
  Pipe pipe;
  pipe.close_end();
  LineReader answers(pipe.ends[0]);
  while (!answers.at_end()) CHECK_FALSE(answers.read_line(1.0).has_value());
  CHECK(waits(answers));
  LineReader closed(1'000'000);  // no file is open under this descriptor
  (void)closed.read_line(0.0);
  CHECK(closed.at_end());
  CHECK(waits(closed));
}
