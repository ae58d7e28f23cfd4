// This work is based on:
// P. Ratanaworabhan, J. Ke, M. Burtscher. Fast Lossless Compression of Scientific Floating-Point Data. 2006
// (a guess, an XOR, and only the bytes that are left)
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

namespace gearshift {
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

// [bytes] from the start of an encoded sample. A name that is none does not compile.
consteval std::size_t place_of(std::string_view path) {
  std::size_t at = 0;
  if (!find_field(TraceSample{}, path, at)) throw std::invalid_argument("no field of that name");
  return at;
}

enum class Law {
  steps,       // as far from the sample before as that was from its own
  as_before,   // another field of the sample before
  same,        // another field, further up
  opposite,    // of that sign
  difference,  // of two
  sum          // of three
};

// What a word of eight bytes is expected to be. All others: as in the sample before.
struct Guess {
  Law law = Law::same;
  std::size_t at = 0;
  std::size_t from = 0, and_from = 0, and_also = 0;
};

// In the order of the sample; each looks at nothing of its own sample that stands behind it.
constexpr std::array kGuesses = {
    Guess{Law::steps, place_of("deadline_ns")},
    Guess{Law::steps, place_of("reading.sequence")},
    Guess{Law::steps, place_of("reading.time_ns")},
    Guess{Law::as_before, place_of("reading.actuator_force.x"), place_of("out.commanded.x")},
    Guess{Law::as_before, place_of("reading.actuator_force.y"), place_of("out.commanded.y")},
    Guess{Law::steps, place_of("out.cycle")},
    Guess{Law::same, place_of("out.time_ns"), place_of("deadline_ns")},
    Guess{Law::same, place_of("out.lever.x"), place_of("reading.position.x")},
    Guess{Law::same, place_of("out.lever.y"), place_of("reading.position.y")},
    Guess{Law::sum, place_of("out.commanded.x"), place_of("out.wall_force.x"), place_of("out.feel_force.x"),
          place_of("out.world_force.x")},
    Guess{Law::sum, place_of("out.commanded.y"), place_of("out.wall_force.y"), place_of("out.feel_force.y"),
          place_of("out.world_force.y")},
    Guess{Law::same, place_of("out.f_h.x"), place_of("reading.hand_force.x")},
    Guess{Law::same, place_of("out.f_h.y"), place_of("reading.hand_force.y")},
    Guess{Law::opposite, place_of("out.f_a.x"), place_of("reading.actuator_force.x")},
    Guess{Law::opposite, place_of("out.f_a.y"), place_of("reading.actuator_force.y")},
    Guess{Law::difference, place_of("out.f_j.x"), place_of("out.f_h.x"), place_of("out.f_a.x")},
    Guess{Law::difference, place_of("out.f_j.y"), place_of("out.f_h.y"), place_of("out.f_a.y")},
};

constexpr bool looks_back(const Guess& guess) {
  const bool uses_none = guess.law == Law::steps || guess.law == Law::as_before;  // of its own sample
  const std::size_t last = std::max({guess.from, guess.and_from, guess.and_also});
  return uses_none || last + sizeof(Word) <= guess.at;
}
constexpr bool in_order(const Guess& a, const Guess& b) {
  return a.at + sizeof(Word) <= b.at;
}
static_assert(std::all_of(kGuesses.begin(), kGuesses.end(), looks_back));
static_assert(std::is_sorted(kGuesses.begin(), kGuesses.end(), [](auto& a, auto& b) { return in_order(a, b); }));

constexpr Word kSign = Word{1} << 63;
constexpr EncodedSample kNothing{};

Word word_at(const std::byte* sample, std::size_t at) noexcept {
  Word word = 0;
  std::memcpy(&word, sample + at, sizeof word);
  return word;
}

double number_at(const std::byte* sample, std::size_t at) noexcept {
  return std::bit_cast<double>(word_at(sample, at));
}

// Machines do not agree on the bits of what is no number.
Word bits_of(double sum) noexcept {
  return std::isfinite(sum) ? std::bit_cast<Word>(sum) : 0;
}

// The sample's neighbours and itself, as far as it is known.
struct Seen {
  const std::byte* older = kNothing.data();
  const std::byte* before = kNothing.data();
  const std::byte* now = nullptr;
};

Word expected(const Guess& guess, const Seen& seen) noexcept {
  switch (guess.law) {
    case Law::steps:
      return 2 * word_at(seen.before, guess.at) - word_at(seen.older, guess.at);
    case Law::as_before:
      return word_at(seen.before, guess.from);
    case Law::same:
      return word_at(seen.now, guess.from);
    case Law::opposite:
      return word_at(seen.now, guess.from) ^ kSign;
    case Law::difference:
      return bits_of(number_at(seen.now, guess.from) - number_at(seen.now, guess.and_from));
    case Law::sum:
      return bits_of(number_at(seen.now, guess.from) + number_at(seen.now, guess.and_from) +
                     number_at(seen.now, guess.and_also));
  }
  return 0;
}

// Sample to what is unexpected of it, and back: `seen.now` is the sample, either way. No guess looks at what is not
// known yet.
void exchange(const Seen& seen, const std::byte* from, std::byte* to) noexcept {
  std::size_t at = 0;
  const auto as_before = [&](std::size_t end) {
    for (; at < end; ++at) to[at] = from[at] ^ seen.before[at];
  };
  for (const Guess& guess : kGuesses) {
    as_before(guess.at);
    const Word word = word_at(from, at) ^ expected(guess, seen);
    std::memcpy(to + at, &word, sizeof word);
    at += sizeof word;
  }
  as_before(kSampleBytes);
}

// Both neighbours of the sample that comes next.
void go_on(Seen& seen, const std::byte* sample) noexcept {
  seen.older = seen.before == kNothing.data() ? sample : seen.before;
  seen.before = sample;
}

constexpr std::size_t kLeastRun = 3;  // [zeros] a run costs two numbers

std::size_t zeros_at(std::span<const std::byte> bytes) noexcept {
  std::size_t zeros = 0;
  while (zeros < bytes.size() && bytes[zeros] == std::byte{0}) ++zeros;
  return zeros;
}

// Up to the next run of zeros, or the zeros that end it all.
std::size_t others_at(std::span<const std::byte> bytes) noexcept {
  std::size_t others = 0;
  while (others < bytes.size()) {
    const std::size_t zeros = zeros_at(bytes.subspan(others));
    if (zeros >= kLeastRun || others + zeros == bytes.size()) break;
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

// Nothing where the bytes end within it, or where it is larger than any block.
std::optional<std::size_t> take_number(std::span<const std::byte>& bytes) noexcept {
  std::size_t number = 0;
  for (unsigned shift = 0; shift < 21 && !bytes.empty(); shift += 7) {
    const auto group = std::to_integer<std::size_t>(bytes[0]);
    bytes = bytes.subspan(1);
    number |= (group & 127) << shift;
    if (group < 128) return number;
  }
  return std::nullopt;
}

bool take_runs(std::span<const std::byte> coded, std::span<std::byte> planes) noexcept {
  while (!planes.empty()) {
    const std::optional<std::size_t> zeros = take_number(coded);
    if (!zeros || *zeros > planes.size()) return false;
    std::fill_n(planes.begin(), *zeros, std::byte{0});
    planes = planes.subspan(*zeros);
    const std::optional<std::size_t> others = take_number(coded);
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
  Seen seen;
  for (std::size_t i = 0; i < count; ++i) {
    EncodedSample rest;
    seen.now = samples.data() + i * kSampleBytes;
    exchange(seen, seen.now, rest.data());
    go_on(seen, seen.now);
    for (std::size_t plane = 0; plane < kSampleBytes; ++plane) planes_[plane * count + i] = rest[plane];
  }
  put_runs(std::span(planes_).first(count * kSampleBytes), coded);
}

bool BlockCodec::decode(std::span<const std::byte> coded, std::size_t count, std::vector<std::byte>& samples) {
  if (count == 0 || count > kSamplesPerBlock) return false;
  samples.resize(count * kSampleBytes);
  if (!take_runs(coded, std::span(planes_).first(samples.size()))) return false;
  Seen seen;
  for (std::size_t i = 0; i < count; ++i) {
    EncodedSample rest;
    for (std::size_t plane = 0; plane < kSampleBytes; ++plane) rest[plane] = planes_[plane * count + i];
    std::byte* const sample = samples.data() + i * kSampleBytes;
    seen.now = sample;
    exchange(seen, rest.data(), sample);
    go_on(seen, sample);
  }
  return true;
}

}  // namespace gearshift
