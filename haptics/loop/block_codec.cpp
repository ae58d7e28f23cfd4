// This work is based on:
// P. Ratanaworabhan, J. Ke, M. Burtscher. Fast Lossless Compression of Scientific Floating-Point Data. 2006
// (predict, XOR, and store only the bytes that remain)
#include "haptics/loop/block_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace gearshift::haptics {
namespace {

using Word = std::uint64_t;

template <class T>
constexpr bool find_field(const T& value, std::string_view path, std::size_t& at) {
  bool found = false;
  each_field(value, [&](const char* field, const auto& member) {
    using Member = std::remove_cvref_t<decltype(member)>;
    const std::string_view name = field;
    if (found) return;
    found = path == name;
    if (found) return;
    if constexpr (!LeafField<Member>) {
      const bool inside = path.starts_with(name) && path.substr(name.size()).starts_with('.');
      found = inside && find_field(member, path.substr(name.size() + 1), at);
      if (inside) return;
    }
    at += encoded_size<Member>();
  });
  return found;
}

// Offset [bytes] of a field in an encoded sample. An unknown name does not compile.
consteval std::size_t resolve_path(std::string_view path) {
  std::size_t at = 0;
  if (!find_field(TraceSample{}, path, at)) throw std::invalid_argument("no field of that name");
  return at;
}

enum class Rule {
  extrapolated,  // linear extrapolation from the two previous samples
  previous,      // another field of the previous sample
  same,          // another field of this sample
  negated,       // another field of this sample, negated
  difference,    // difference of two fields of this sample
  sum            // sum of three fields of this sample
};

// Prediction of one 8-byte word. All other bytes are predicted by the previous sample.
struct Guess {
  Rule rule = Rule::same;
  std::size_t at = 0;
  std::size_t from = 0, and_from = 0, and_also = 0;
};

// In sample order; each refers only to fields of its own sample that come before it.
constexpr std::array kGuesses = {
    Guess{Rule::extrapolated, resolve_path("deadline_ns")},
    Guess{Rule::extrapolated, resolve_path("reading.sequence")},
    Guess{Rule::extrapolated, resolve_path("reading.time_ns")},
    Guess{Rule::previous, resolve_path("reading.actuator_force.x"), resolve_path("out.commanded.x")},
    Guess{Rule::previous, resolve_path("reading.actuator_force.y"), resolve_path("out.commanded.y")},
    Guess{Rule::extrapolated, resolve_path("out.cycle")},
    Guess{Rule::same, resolve_path("out.time_ns"), resolve_path("deadline_ns")},
    Guess{Rule::same, resolve_path("out.lever.x"), resolve_path("reading.position.x")},
    Guess{Rule::same, resolve_path("out.lever.y"), resolve_path("reading.position.y")},
    Guess{Rule::sum, resolve_path("out.commanded.x"), resolve_path("out.wall_force.x"),
          resolve_path("out.feel_force.x"), resolve_path("out.world_force.x")},
    Guess{Rule::sum, resolve_path("out.commanded.y"), resolve_path("out.wall_force.y"),
          resolve_path("out.feel_force.y"), resolve_path("out.world_force.y")},
    Guess{Rule::same, resolve_path("out.f_h.x"), resolve_path("reading.hand_force.x")},
    Guess{Rule::same, resolve_path("out.f_h.y"), resolve_path("reading.hand_force.y")},
    Guess{Rule::negated, resolve_path("out.f_a.x"), resolve_path("reading.actuator_force.x")},
    Guess{Rule::negated, resolve_path("out.f_a.y"), resolve_path("reading.actuator_force.y")},
    Guess{Rule::difference, resolve_path("out.f_j.x"), resolve_path("out.f_h.x"), resolve_path("out.f_a.x")},
    Guess{Rule::difference, resolve_path("out.f_j.y"), resolve_path("out.f_h.y"), resolve_path("out.f_a.y")},
};

constexpr bool refers_to_known(const Guess& guess) {
  const bool uses_none =
      guess.rule == Rule::extrapolated || guess.rule == Rule::previous;  // uses no field of its own sample
  const std::size_t last = std::max({guess.from, guess.and_from, guess.and_also});
  return uses_none || last + sizeof(Word) <= guess.at;
}
constexpr bool in_order(const Guess& a, const Guess& b) {
  return a.at + sizeof(Word) <= b.at;
}
static_assert(std::all_of(kGuesses.begin(), kGuesses.end(), refers_to_known));
static_assert(std::is_sorted(kGuesses.begin(), kGuesses.end(), [](auto& a, auto& b) { return in_order(a, b); }));

constexpr Word kSign = Word{1} << 63;
constexpr EncodedSample kZeroSample{};

Word word_at(const std::byte* sample, std::size_t at) noexcept {
  Word word = 0;
  std::memcpy(&word, sample + at, sizeof word);
  return word;
}

double number_at(const std::byte* sample, std::size_t at) noexcept {
  return std::bit_cast<double>(word_at(sample, at));
}

// Processors differ in the bits of NaN and infinity results, so those are predicted as 0.
Word bits_of(double sum) noexcept {
  return std::isfinite(sum) ? std::bit_cast<Word>(sum) : 0;
}

// The two previous samples, and the current one as far as it is decoded.
struct SampleContext {
  const std::byte* older = kZeroSample.data();
  const std::byte* before = kZeroSample.data();
  const std::byte* now = nullptr;
};

Word expected(const Guess& guess, const SampleContext& context) noexcept {
  switch (guess.rule) {
    case Rule::extrapolated:
      return 2 * word_at(context.before, guess.at) - word_at(context.older, guess.at);
    case Rule::previous:
      return word_at(context.before, guess.from);
    case Rule::same:
      return word_at(context.now, guess.from);
    case Rule::negated:
      return word_at(context.now, guess.from) ^ kSign;
    case Rule::difference:
      return bits_of(number_at(context.now, guess.from) - number_at(context.now, guess.and_from));
    case Rule::sum:
      return bits_of(number_at(context.now, guess.from) + number_at(context.now, guess.and_from) +
                     number_at(context.now, guess.and_also));
  }
  return 0;
}

// XORs a sample with its prediction; encoding and decoding are the same operation. In both directions `context.now` is
// the plain sample, and no prediction reads a part of it that is not decoded yet.
void apply_guesses(const SampleContext& context, const std::byte* from, std::byte* to) noexcept {
  std::size_t at = 0;
  const auto previous = [&](std::size_t end) {
    for (; at < end; ++at) to[at] = from[at] ^ context.before[at];
  };
  for (const Guess& guess : kGuesses) {
    previous(guess.at);
    const Word word = word_at(from, at) ^ expected(guess, context);
    std::memcpy(to + at, &word, sizeof word);
    at += sizeof word;
  }
  previous(kSampleBytes);
}

// Makes `sample` the previous sample of the next one.
void advance_to(SampleContext& context, const std::byte* sample) noexcept {
  context.older = context.before == kZeroSample.data() ? sample : context.before;
  context.before = sample;
}

constexpr std::size_t kMinRun = 3;  // [zeros] because a run costs two numbers

std::size_t zeros_at(std::span<const std::byte> bytes) noexcept {
  std::size_t zeros = 0;
  while (zeros < bytes.size() && bytes[zeros] == std::byte{0}) ++zeros;
  return zeros;
}

// Number of bytes before the next run of zeros, or before the trailing zeros.
std::size_t others_at(std::span<const std::byte> bytes) noexcept {
  std::size_t others = 0;
  while (others < bytes.size()) {
    const std::size_t zeros = zeros_at(bytes.subspan(others));
    if (zeros >= kMinRun || others + zeros == bytes.size()) break;
    others += zeros + 1;
  }
  return others;
}

void put_number(std::size_t number, std::vector<std::byte>& bytes) {
  for (; number >= 128; number >>= 7) bytes.push_back(static_cast<std::byte>(number | 128));
  bytes.push_back(static_cast<std::byte>(number));
}

void put_runs(std::span<const std::byte> planes, std::vector<std::byte>& coded) {
  coded.clear();
  while (!planes.empty()) {
    const std::size_t zeros = zeros_at(planes);
    planes = planes.subspan(zeros);
    const std::size_t others = others_at(planes);
    put_number(zeros, coded);
    put_number(others, coded);
    coded.insert(coded.end(), planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(others));
    planes = planes.subspan(others);
  }
}

// Empty if the number is cut off or larger than any block.
std::optional<std::size_t> read_number(std::span<const std::byte>& bytes) noexcept {
  std::size_t number = 0;
  for (unsigned shift = 0; shift < 21 && !bytes.empty(); shift += 7) {
    const auto group = std::to_integer<std::size_t>(bytes[0]);
    bytes = bytes.subspan(1);
    number |= (group & 127) << shift;
    if (group < 128) return number;
  }
  return std::nullopt;
}

bool read_runs(std::span<const std::byte> coded, std::span<std::byte> planes) noexcept {
  while (!planes.empty()) {
    const std::optional<std::size_t> zeros = read_number(coded);
    if (!zeros || *zeros > planes.size()) return false;
    std::fill_n(planes.begin(), *zeros, std::byte{0});
    planes = planes.subspan(*zeros);
    const std::optional<std::size_t> others = read_number(coded);
    if (!others || *others > planes.size() || *others > coded.size()) return false;
    std::copy_n(coded.begin(), *others, planes.begin());
    planes = planes.subspan(*others);
    coded = coded.subspan(*others);
  }
  return coded.empty();
}

}  // namespace

BlockCodec::BlockCodec() : planes_(kSamplesPerBlock * kSampleBytes) {}

void BlockCodec::encode(std::span<const std::byte> samples, std::vector<std::byte>& coded) {
  const std::size_t count = samples.size() / kSampleBytes;
  SampleContext context;
  for (std::size_t i = 0; i < count; ++i) {
    EncodedSample rest;
    context.now = samples.data() + i * kSampleBytes;
    apply_guesses(context, context.now, rest.data());
    advance_to(context, context.now);
    for (std::size_t plane = 0; plane < kSampleBytes; ++plane) planes_[plane * count + i] = rest[plane];
  }
  put_runs(std::span(planes_).first(count * kSampleBytes), coded);
}

bool BlockCodec::decode(std::span<const std::byte> coded, std::size_t count, std::vector<std::byte>& samples) {
  if (count == 0 || count > kSamplesPerBlock) return false;
  samples.resize(count * kSampleBytes);
  if (!read_runs(coded, std::span(planes_).first(samples.size()))) return false;
  SampleContext context;
  for (std::size_t i = 0; i < count; ++i) {
    EncodedSample rest;
    for (std::size_t plane = 0; plane < kSampleBytes; ++plane) rest[plane] = planes_[plane * count + i];
    std::byte* const sample = samples.data() + i * kSampleBytes;
    context.now = sample;
    apply_guesses(context, rest.data(), sample);
    advance_to(context, sample);
  }
  return true;
}

}  // namespace gearshift::haptics
