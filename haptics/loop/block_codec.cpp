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

// Offset [bytes] of a field in an encoded sample. An unknown field name is a compile error.
consteval std::size_t field_offset(std::string_view path) {
  std::size_t at = 0;
  if (!find_field(TraceSample{}, path, at)) throw std::invalid_argument("there is no field with that name");
  return at;
}

enum class Rule {
  extrapolated,  // linear extrapolation from the two previous samples
  previous,      // a different field of the previous sample
  same,          // a different field of this sample
  negated,       // a different field of this sample, negated
  difference,    // difference of two fields of this sample
  sum            // sum of three fields of this sample
};

// Prediction of one 8-byte word. Bytes without a prediction of their own are predicted to equal the previous sample's.
struct Prediction {
  Rule rule = Rule::same;
  std::size_t at = 0;
  std::size_t from = 0, and_from = 0, and_also = 0;
};

// Sorted by position in the sample. A prediction from the current sample reads only earlier fields.
constexpr std::array kPredictions = {
    Prediction{Rule::extrapolated, field_offset("deadline_ns")},
    Prediction{Rule::extrapolated, field_offset("reading.sequence")},
    Prediction{Rule::extrapolated, field_offset("reading.time_ns")},
    Prediction{Rule::previous, field_offset("reading.actuator_force.x"), field_offset("out.commanded.x")},
    Prediction{Rule::previous, field_offset("reading.actuator_force.y"), field_offset("out.commanded.y")},
    Prediction{Rule::extrapolated, field_offset("out.cycle")},
    Prediction{Rule::same, field_offset("out.time_ns"), field_offset("deadline_ns")},
    Prediction{Rule::same, field_offset("out.lever.x"), field_offset("reading.position.x")},
    Prediction{Rule::same, field_offset("out.lever.y"), field_offset("reading.position.y")},
    Prediction{Rule::sum, field_offset("out.commanded.x"), field_offset("out.wall_force.x"),
               field_offset("out.feel_force.x"), field_offset("out.world_force.x")},
    Prediction{Rule::sum, field_offset("out.commanded.y"), field_offset("out.wall_force.y"),
               field_offset("out.feel_force.y"), field_offset("out.world_force.y")},
    Prediction{Rule::same, field_offset("out.f_h.x"), field_offset("reading.hand_force.x")},
    Prediction{Rule::same, field_offset("out.f_h.y"), field_offset("reading.hand_force.y")},
    Prediction{Rule::negated, field_offset("out.f_a.x"), field_offset("reading.actuator_force.x")},
    Prediction{Rule::negated, field_offset("out.f_a.y"), field_offset("reading.actuator_force.y")},
    Prediction{Rule::difference, field_offset("out.f_j.x"), field_offset("out.f_h.x"), field_offset("out.f_a.x")},
    Prediction{Rule::difference, field_offset("out.f_j.y"), field_offset("out.f_h.y"), field_offset("out.f_a.y")},
};

constexpr bool refers_to_known(const Prediction& prediction) {
  // These rules read only previous samples.
  const bool uses_none = prediction.rule == Rule::extrapolated || prediction.rule == Rule::previous;
  const std::size_t last = std::max({prediction.from, prediction.and_from, prediction.and_also});
  return uses_none || last + sizeof(Word) <= prediction.at;
}
constexpr bool in_order(const Prediction& a, const Prediction& b) {
  return a.at + sizeof(Word) <= b.at;
}
static_assert(std::all_of(kPredictions.begin(), kPredictions.end(), refers_to_known));
static_assert(std::is_sorted(kPredictions.begin(), kPredictions.end(),
                             [](auto& a, auto& b) { return in_order(a, b); }));

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

// Returns the bits of a predicted number; 0 if it is NaN or infinite, because a NaN's bits depend on the processor.
Word bits_of(double sum) noexcept {
  return std::isfinite(sum) ? std::bit_cast<Word>(sum) : 0;
}

// The two previous samples, and the current sample as far as it is decoded.
struct SampleContext {
  const std::byte* older = kZeroSample.data();
  const std::byte* before = kZeroSample.data();
  const std::byte* now = nullptr;
};

Word predicted_word(const Prediction& prediction, const SampleContext& context) noexcept {
  switch (prediction.rule) {
    case Rule::extrapolated:
      return 2 * word_at(context.before, prediction.at) - word_at(context.older, prediction.at);
    case Rule::previous:
      return word_at(context.before, prediction.from);
    case Rule::same:
      return word_at(context.now, prediction.from);
    case Rule::negated:
      return word_at(context.now, prediction.from) ^ kSign;
    case Rule::difference:
      return bits_of(number_at(context.now, prediction.from) - number_at(context.now, prediction.and_from));
    case Rule::sum:
      return bits_of(number_at(context.now, prediction.from) + number_at(context.now, prediction.and_from) +
                     number_at(context.now, prediction.and_also));
  }
  return 0;
}

// XORs a sample with its prediction; encoding and decoding are the same operation. `context.now` is the decoded sample;
// predictions read only those parts of it that are already decoded.
void apply_predictions(const SampleContext& context, const std::byte* from, std::byte* to) noexcept {
  std::size_t at = 0;
  const auto previous = [&](std::size_t end) {
    for (; at < end; ++at) to[at] = from[at] ^ context.before[at];
  };
  for (const Prediction& prediction : kPredictions) {
    previous(prediction.at);
    const Word word = word_at(from, at) ^ predicted_word(prediction, context);
    std::memcpy(to + at, &word, sizeof word);
    at += sizeof word;
  }
  previous(kSampleBytes);
}

// Makes `sample` the previous sample for the next prediction.
void advance_to(SampleContext& context, const std::byte* sample) noexcept {
  context.older = context.before == kZeroSample.data() ? sample : context.before;
  context.before = sample;
}

constexpr std::size_t kMinRun = 3;  // [zeros] shortest encoded run, because each run needs two numbers

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

// Reads a number from the front; empty if it is cut off or larger than any block.
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
    EncodedSample residual;
    context.now = samples.data() + i * kSampleBytes;
    apply_predictions(context, context.now, residual.data());
    advance_to(context, context.now);
    for (std::size_t plane = 0; plane < kSampleBytes; ++plane) planes_[plane * count + i] = residual[plane];
  }
  put_runs(std::span(planes_).first(count * kSampleBytes), coded);
}

bool BlockCodec::decode(std::span<const std::byte> coded, std::size_t count, std::vector<std::byte>& samples) {
  if (count == 0 || count > kSamplesPerBlock) return false;
  samples.resize(count * kSampleBytes);
  if (!read_runs(coded, std::span(planes_).first(samples.size()))) return false;
  SampleContext context;
  for (std::size_t i = 0; i < count; ++i) {
    EncodedSample residual;
    for (std::size_t plane = 0; plane < kSampleBytes; ++plane) residual[plane] = planes_[plane * count + i];
    std::byte* const sample = samples.data() + i * kSampleBytes;
    context.now = sample;
    apply_predictions(context, residual.data(), sample);
    advance_to(context, sample);
  }
  return true;
}

}  // namespace gearshift::haptics
