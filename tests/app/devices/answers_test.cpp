// Lines from a pipe, whole, in order, and never waited for longer than asked.
#include "app/devices/answers.h"

#include <unistd.h>

#include <array>
#include <chrono>
#include <string_view>

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() { REQUIRE(pipe(ends.data()) == 0); }
  ~Pipe() {
    close(ends[0]);
    shut();
  }
  void say(std::string_view text) { REQUIRE(write(ends[1], text.data(), text.size()) == ssize_t(text.size())); }
  void shut() {
    if (ends[1] >= 0) close(ends[1]);
    ends[1] = -1;
  }
};

}  // namespace

TEST_CASE("lines come one by one, cut anywhere, and an end of file ends the last one") {
  Pipe pipe;
  Answers answers(pipe.ends[0]);
  CHECK_FALSE(answers.line(0.0).has_value());
  pipe.say("70");
  CHECK_FALSE(answers.line(0.0).has_value());
  CHECK_FALSE(answers.ended());
  pipe.say(" mm\r\n\nle");
  CHECK(answers.line(1.0) == "70 mm");
  CHECK(answers.line(1.0) == "");
  CHECK_FALSE(answers.line(0.0).has_value());
  pipe.say("ft");
  pipe.shut();
  while (!answers.ended()) {
    if (const auto line = answers.line(1.0)) CHECK(*line == "left");
  }
  CHECK_FALSE(answers.line(1.0).has_value());
}

// Who looks at the world between two lines would do it without a pause, on the core that the loop needs.
TEST_CASE("at the end the time that was given passes, and what cannot be read is at its end") {
  const auto waits = [](Answers& answers) {
    const auto begin = std::chrono::steady_clock::now();
    CHECK_FALSE(answers.line(0.05).has_value());
    return std::chrono::steady_clock::now() - begin >= std::chrono::milliseconds(50);
  };
  Pipe pipe;
  pipe.shut();
  Answers answers(pipe.ends[0]);
  while (!answers.ended()) CHECK_FALSE(answers.line(1.0).has_value());
  CHECK(waits(answers));
  Answers closed(1'000'000);  // no such file
  (void)closed.line(0.0);
  CHECK(closed.ended());
  CHECK(waits(closed));
}
