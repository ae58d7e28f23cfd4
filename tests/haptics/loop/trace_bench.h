// Traces for the trace tests: a header, and samples generated without a loop.
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "haptics/gate/gate_layout.h"
#include "haptics/loop/trace_reader.h"
#include "haptics/loop/trace_writer.h"
#include "tests/support/short_trace.h"
#include "tests/support/temp_folder.h"

namespace gearshift::test {

using Bytes = std::vector<unsigned char>;

inline Bytes file_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void put_file(const std::filesystem::path& file, const Bytes& bytes) {
  // Some file systems wait for the disk when a file is truncated and rewritten, so the old file is deleted first.
  std::filesystem::remove(file);
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// Doubles of all kinds: numbers, signed zeros, infinities, quiet and signalling NaNs with payloads.
inline double any_double(std::mt19937_64& random) {
  constexpr std::uint64_t kOdd[] = {0x8000000000000000, 0x7FF0000000000000, 0xFFF0000000000000, 0x7FF8000000000123,
                                    0x7FF0000000000456, 0xFFFFFFFFFFFFFFFF, 0x0000000000000001, 0x0000000000000000};
  if (random() % 4 == 0) return std::bit_cast<double>(kOdd[random() % 8]);
  return std::bit_cast<double>(random());
}

inline glm::dvec2 any_vector(std::mt19937_64& random) {
  return {any_double(random), any_double(random)};
}

// Every field gets different bits, so that a test notices swapped fields.
inline haptics::TraceSample any_sample(std::mt19937_64& random, std::uint64_t cycle) {
  haptics::TraceSample s;
  s.deadline_ns = static_cast<std::int64_t>(random());
  s.skipped = static_cast<std::int64_t>(random() >> 1);  // never negative
  s.reading = {random(),           static_cast<std::int64_t>(random()),
               any_vector(random), any_vector(random),
               any_vector(random), random() % 2 == 0,
               random() % 2 == 0,  random() % 2 == 0};
  s.controls = {{any_double(random), any_double(random), any_double(random), any_double(random)},
                random() % 2 == 0,
                random() % 2 == 0};
  s.tuning = {any_double(random), any_double(random), any_double(random),
              any_double(random), any_double(random), any_double(random)};
  s.command = static_cast<haptics::LoopCommand>(random() % 4);
  s.out.cycle = cycle;
  s.out.time_ns = static_cast<std::int64_t>(random());
  for (glm::dvec2* v : {&s.out.lever, &s.out.velocity, &s.out.proxy, &s.out.wall_force, &s.out.feel_force,
                        &s.out.load_force, &s.out.commanded, &s.out.f_h, &s.out.f_a, &s.out.f_j})
    *v = any_vector(random);
  s.out.road_speed = any_double(random);
  s.out.slot = static_cast<int>(random());
  s.out.gear = static_cast<int>(random());
  s.out.guard = static_cast<haptics::GuardState>(random() % 6);
  s.out.fault = static_cast<haptics::GuardFault>(random() % 6);
  s.out.flags = static_cast<std::uint32_t>(random());
  return s;
}

inline std::vector<haptics::TraceSample> any_samples(std::size_t count, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::vector<haptics::TraceSample> samples;
  for (std::size_t i = 0; i < count; ++i) samples.push_back(any_sample(random, i));
  return samples;
}

inline haptics::TraceHeader paper_header() {
  haptics::TraceHeader header;
  header.program = "1.2.3";
  header.device.workspace = {0.0771, 0.0688};  // [m] reach of the paper's joystick on each axis
  header.device.simulated = true;
  const haptics::GateLayout layout = haptics::read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  header.gate_file = "paper.toml";
  header.gate_text = layout.text;
  header.armed = true;
  return header;
}

inline std::filesystem::path put_trace(const std::filesystem::path& file, std::size_t cycles) {
  write_trace(file, paper_header(), any_samples(cycles));
  return file;
}

}  // namespace gearshift::test
