// Which packets of telemetry count, and what is said about the others.
#include "app/shifter/telemetry.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::shifter;

namespace {

// A packet by the offsets of Live for Speed's docs/InSim.txt, counted by hand: time 0, car 4, flags 8, gear 10, player
// 11, speed 12, rpm 16, turbo 20, engine temperature 24, fuel 28, oil pressure 32, oil temperature 36, lights 40 and 44,
// throttle 48, brake 52, clutch 56, displays 60 and 76, ID 92.
struct Packet {
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(92, 0);
  Packet& word(std::size_t at, std::uint32_t value) {
    std::memcpy(&bytes[at], &value, 4);
    return *this;
  }
  Packet& number(std::size_t at, float value) {
    std::memcpy(&bytes[at], &value, 4);
    return *this;
  }
  Packet& gear(int value) {
    bytes[10] = static_cast<std::uint8_t>(value);
    return *this;
  }
};

Packet cruising(std::uint32_t time_ms) {
  return Packet()
      .word(0, time_ms)
      .gear(4)
      .number(12, 20.0f)
      .number(16, 3000.0f)
      .number(48, 0.5f)
      .number(52, 0.75f)
      .number(56, 0.25f);
}

std::vector<std::string> messages_of(TelemetryFilter& filter) {
  std::vector<std::string> all;
  while (const auto message = filter.take_message()) all.push_back(*message);
  return all;
}

}  // namespace

TEST_CASE("a packet of either length gives gear, speed, engine speed, throttle and clutch") {
  Packet packet = cruising(1234);
  for (const std::size_t size : {92u, 96u}) {
    packet.bytes.resize(size, 7);
    const auto car = parse_outgauge(packet.bytes);
    REQUIRE(car);
    CHECK(car->time_ms == 1234);
    CHECK(car->gear == 3);
    CHECK(car->speed == 20.0);
    CHECK(car->engine_speed == doctest::Approx(3000.0 * 2.0 * M_PI / 60.0));
    CHECK(car->throttle == 0.5);
    CHECK(car->brake == 0.75);
    CHECK(car->clutch == 0.25);
  }
  CHECK(parse_outgauge(cruising(0).gear(0).bytes)->gear == -1);
  CHECK(parse_outgauge(cruising(0).gear(1).bytes)->gear == 0);
}

TEST_CASE("other lengths and values that no car has are refused") {
  for (const std::size_t size : {0u, 1u, 91u, 93u, 95u, 97u, 2000u}) {
    Packet packet = cruising(1);
    packet.bytes.resize(size, 0);
    CHECK_FALSE(parse_outgauge(packet.bytes));
  }
  for (const std::size_t at : {12u, 16u, 48u, 52u, 56u})
    for (const float value : {NAN, INFINITY, -INFINITY, 1e9f, -1e9f})
      CHECK_FALSE(parse_outgauge(cruising(1).number(at, value).bytes));
  CHECK_FALSE(parse_outgauge(cruising(1).gear(20).bytes));
  CHECK(parse_outgauge(cruising(1).number(48, 1.005f).bytes)->throttle == 1.0);
}

TEST_CASE("late, foreign and malformed packets are told once and change nothing") {
  TelemetryFilter filter;
  filter.receive(cruising(1000).bytes, 1, 0.0);
  CHECK(messages_of(filter) == std::vector<std::string>{"telemetry arrives"});
  for (int i = 0; i < 3; ++i) {
    filter.receive(cruising(990).number(12, 5.0f).bytes, 1, 0.01);
    filter.receive(cruising(1010).number(12, 6.0f).bytes, 2, 0.01);
    filter.receive(std::vector<std::uint8_t>(50), 1, 0.01);
    filter.receive(cruising(1010).number(12, NAN).bytes, 1, 0.01);
    CHECK(filter.at(0.02).car.speed == 20.0);
  }
  const std::vector<std::string> told = messages_of(filter);
  REQUIRE(told.size() == 3);
  CHECK(told[0] == "a telemetry packet that arrived late was ignored");
  CHECK(told[1] == "telemetry of a second sender was ignored; only one program may send it");
  CHECK(told[2] == "a packet of 50 bytes was ignored; OutGauge packets have 92 or 96");
}

TEST_CASE("telemetry that stops is unknown after half a second, and may come back from elsewhere, told once") {
  TelemetryFilter filter;
  CHECK_FALSE(filter.at(0.0).is_live);
  CHECK(messages_of(filter).empty());
  double now = 10.0;
  for (int i = 0; i < 3; ++i) {
    filter.receive(cruising(5000).bytes, 10u + static_cast<unsigned>(i), now);
    CHECK(filter.at(now + 0.49).is_live);
    CHECK_FALSE(filter.at(now + 0.51).is_live);
    now += 1.0;
  }
  CHECK(messages_of(filter) == std::vector<std::string>{"telemetry arrives",
                                                        "the telemetry stopped; the gate continues without it",
                                                        "telemetry arrives again"});
}

TEST_CASE("a sender without a clock, one that starts anew, and a clock that wraps are not late") {
  const auto follows = [](std::uint32_t before, std::uint32_t after) {
    TelemetryFilter filter;
    filter.receive(cruising(before).bytes, 1, 0.0);
    filter.receive(cruising(after).number(12, 9.0f).bytes, 1, 0.1);
    return filter.at(0.1).car.speed == 9.0;
  };
  CHECK(follows(0, 0));
  CHECK(follows(100, 100));
  CHECK(follows(500000, 20));
  CHECK(follows(0xffffffffu, 5));
  CHECK_FALSE(follows(500000, 499990));
}

TEST_CASE("a port on loopback receives what is sent to it") {
  TelemetryPort port("127.0.0.1:46234");
  const int sender = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(46234);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const Packet packet = cruising(1);
  REQUIRE(sendto(sender, packet.bytes.data(), packet.bytes.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to) ==
          92);
  close(sender);
  TelemetryFilter filter;
  for (int i = 0; i < 1000 && !filter.at(0.0).is_live; ++i) {
    port.read_into(filter, 0.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(filter.at(0.0).car.speed == 20.0);
  CHECK_THROWS_WITH_AS(TelemetryPort("127.0.0.1:46234"),
                       "telemetry cannot be received at 127.0.0.1:46234: Address already in use", std::runtime_error);
  CHECK_THROWS_WITH_AS(TelemetryPort("4444"),
                       "telemetry cannot be received at 4444: it must be HOST:PORT, for example 127.0.0.1:4444",
                       std::runtime_error);
}
