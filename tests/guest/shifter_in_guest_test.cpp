// The lever as a shifter, with the kernel's own uinput and evdev: another program's view of the buttons against what the
// lever did, axes passed on, telemetry over loopback. Runs only in the guest.
#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/input.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "app/shifter/shifter.h"
#include "app/shifter/virtual_joystick.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/preset.h"
#include "tests/guest/guest_bench.h"

using namespace gearshift;
using test::becomes_true;

namespace {

// The newest input device of this name, opened as any program would. -1: there is none.
int open_named(const std::string& name, std::string* path = nullptr) {
  int found = -1;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/input")) {
    const int file = open(entry.path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    char its_name[80] = {};
    if (file >= 0 && ioctl(file, EVIOCGNAME(sizeof its_name), its_name) > 0 && name == its_name && found < 0) {
      found = file;
      if (path != nullptr) *path = entry.path();
    } else if (file >= 0) {
      close(file);
    }
  }
  return found;
}

std::vector<input_event> events_of(int file) {
  std::vector<input_event> all;
  for (input_event event{}; read(file, &event, sizeof event) == static_cast<ssize_t>(sizeof event);)
    if (event.type != EV_SYN) all.push_back(event);
  return all;
}

// A session in a thread of its own, and the lines that it prints.
struct Session {
  explicit Session(shifter::ShifterConfig config) {
    thread = std::thread([this, config = std::move(config)] {
      base::LineReader answers(STDIN_FILENO);
      shifter::run_shifter(config, answers, [this](const std::string& line) { lines.push_back(line); });
      is_over = true;
    });
  }
  ~Session() { thread.join(); }
  std::thread thread;
  std::vector<std::string> lines;  // read them only once is_over
  std::atomic<bool> is_over{false};
};

shifter::ShifterConfig config_for(const std::string& gate) {
  const std::string assets = GEARSHIFT_ASSETS;
  shifter::ShifterConfig config;
  config.layout = haptics::read_gate_layout(assets + "/gates/" + gate + ".toml");
  config.preset = haptics::read_preset(assets + "/presets/default.toml");
  config.car = vehicle::read_car(assets + "/cars/hatchback.toml");
  return config;
}

// The buttons that the session's lines name: pressed, or released by a neutral.
std::vector<std::pair<int, int>> lines_as_events(const std::vector<std::string>& lines) {
  std::vector<std::pair<int, int>> events;
  int held = 0;
  for (const std::string& line : lines) {
    const std::size_t at = line.find(" s: ");
    if (at == std::string::npos) continue;
    const std::size_t button = line.find("button ", at);
    const int next = line.find("no button") != std::string::npos ? 0 : std::stoi(line.substr(button + 7));
    if (held != 0) events.emplace_back(held, 0);
    if (next != 0) events.emplace_back(next, 1);
    held = next;
  }
  return events;
}

std::vector<std::uint8_t> packet() {  // 15 m/s, 2000 rpm, clutch pressed; offsets of Live for Speed's docs/InSim.txt
  std::vector<std::uint8_t> bytes(92, 0);
  const auto put = [&](std::size_t at, float value) { std::memcpy(&bytes[at], &value, sizeof value); };
  bytes[10] = 1;
  put(12, 15.0f);
  put(16, 2000.0f);
  put(56, 1.0f);
  return bytes;
}

}  // namespace

TEST_CASE("another program sees each gear as a held button, in the order of the tour, as the session says") {
  for (const char* gate : {"paper", "selector_p_r_n_d"}) {
    std::printf("%s\n", gate);
    std::vector<input_event> events;
    int file = -1;
    std::vector<std::string> lines;
    {
      Session session(config_for(gate));
      REQUIRE(becomes_true([&] { return (file = open_named("gearshift shifter")) >= 0; }, 20.0));
      while (!session.is_over) {
        for (const input_event& event : events_of(file)) events.push_back(event);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      lines = session.lines;
    }
    std::vector<std::pair<int, int>> seen;
    for (const input_event& event : events) {
      CHECK(event.type == EV_KEY);
      seen.emplace_back(event.code - BTN_JOYSTICK + 1, event.value);
      std::printf("  button %d %s\n", event.code - BTN_JOYSTICK + 1, event.value != 0 ? "down" : "up");
    }
    CHECK(seen == lines_as_events(lines));
    CHECK(seen.size() >= 11);
    if (std::string(gate) == "paper")
      for (int i = 0; i < 6; ++i) CHECK(seen[static_cast<std::size_t>(2 * i)] == std::pair(i + 1, 1));
    close(file);
    CHECK(becomes_true(
        [] {
          const int left = open_named("gearshift shifter");
          if (left >= 0) close(left);
          return left < 0;
        },
        5.0));
  }
}

TEST_CASE("the axes of another device are passed on, with their range, until it is gone; telemetry arrives and stops") {
  std::optional<shifter::VirtualJoystick> source;
  source.emplace(1, std::vector<shifter::JoystickAxis>{{ABS_Z, 0, 0, 1023, 0, 0}});
  shifter::ShifterConfig config = config_for("paper");
  int of_source = -1;
  REQUIRE(becomes_true([&] { return (of_source = open_named("gearshift shifter", &config.pedals)) >= 0; }, 20.0));
  close(of_source);
  config.telemetry = "127.0.0.1:4444";
  std::vector<std::string> lines;
  {
    Session session(config);
    std::string path;
    int file = -1;
    REQUIRE(becomes_true(
        [&] {
          for (const auto& entry : std::filesystem::directory_iterator("/dev/input")) {
            char its_name[80] = {};
            if (entry.path() == config.pedals) continue;
            const int other = open(entry.path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
            if (other >= 0 && ioctl(other, EVIOCGNAME(sizeof its_name), its_name) > 0 &&
                std::string(its_name) == "gearshift shifter") {
              file = other;
              return true;
            }
            if (other >= 0) close(other);
          }
          return false;
        },
        20.0));
    input_absinfo info{};
    REQUIRE(ioctl(file, EVIOCGABS(ABS_Z), &info) == 0);
    CHECK(info.maximum == 1023);
    source->set_axis(ABS_Z, 700);
    source->publish();
    CHECK(becomes_true([&] { return ioctl(file, EVIOCGABS(ABS_Z), &info) == 0 && info.value == 700; }, 5.0));
    const int sender = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(4444);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    for (int i = 0; i < 100; ++i) {
      (void)sendto(sender, packet().data(), 92, 0, reinterpret_cast<sockaddr*>(&to), sizeof to);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    close(sender);
    source.reset();
    while (!session.is_over) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    close(file);
    lines = session.lines;
  }
  const auto count = [&](const std::string& words) {
    return std::count_if(lines.begin(), lines.end(),
                         [&](const std::string& line) { return line.find(words) != std::string::npos; });
  };
  CHECK(count("telemetry arrives") == 1);
  CHECK(count("the telemetry stopped; the gate continues without it") == 1);
  CHECK(count("is gone; its axes stay where they are") == 1);
}
