// Lossless compression of trace samples to about a fifth of their size. Each block is coded independently, so that it
// can be read even if earlier blocks are lost.
//
//   predict XOR each sample with its prediction. This is the previous sample, except for fields that follow from others
//           (f_j = f_h - f_a, the cycle counter): they are predicted by their derived value. A good prediction leaves
//           zeros, at least in the high bytes
//   planes  byte 0 of all samples, then byte 1 of all, and so on: this groups the zeros
//   runs    number of zeros, number of other bytes, those bytes; repeated until the planes are full. Both numbers are
//           in groups of seven bits, low group first, with the top bit set in all groups but the last
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "haptics/loop/trace_format.h"

namespace gearshift::haptics {

// [bytes] upper bound for any block. Incompressible noise hardly grows, because fewer than three zeros do not count as
// a run.
inline constexpr std::size_t kMaxCodedBytes = kSamplesPerBlock * kSampleBytes + 16;

class BlockCodec {
 public:
  BlockCodec();

  // samples: 1 to kSamplesPerBlock encoded samples, concatenated. Replaces the content of `coded`; allocates nothing if
  // `coded` has capacity for kMaxCodedBytes.
  void encode(std::span<const std::byte> samples, std::vector<std::byte>& coded);

  // Replaces the content of `samples` with `count` decoded samples. Returns false if `count` is not 1 to
  // kSamplesPerBlock, or if `coded` does not hold exactly `count` samples. The values of the fields are not checked.
  bool decode(std::span<const std::byte> coded, std::size_t count, std::vector<std::byte>& samples);

 private:
  std::vector<std::byte> planes_;
};

}  // namespace gearshift::haptics
