// Samples of a trace in a fifth of their room, to the bit. A block is coded by itself: those before it may be lost.
//
//   guess   a sample is XORed with what is expected of it: the sample before, and where a field follows from others
//           (f_j = f_h - f_a, the cycle counts on) what follows; a good guess leaves zeros, at least in the high bytes
//   planes  byte 0 of all samples, then byte 1 of all, and so on: zeros come to stand beside zeros
//   runs    how many zeros, how many other bytes, those bytes; again, until the planes are full. Both numbers in groups
//           of seven bits, the low ones first, the top bit set in all groups but the last
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "haptics/loop/trace_format.h"

namespace gearshift {

// [bytes] of any block: noise does not shrink, and hardly grows, as fewer than three zeros are no run.
inline constexpr std::size_t kMostCodedBytes = kSamplesPerBlock * kSampleBytes + 16;

class BlockCodec {
 public:
  BlockCodec();

  // samples: 1 to kSamplesPerBlock, encoded one after another. Replaces `coded`, without allocation where that has
  // room for kMostCodedBytes.
  void encode(std::span<const std::byte> samples, std::vector<std::byte>& coded);

  // Replaces `samples` by `count` of them. False where that is not 1 to kSamplesPerBlock, or where `coded` holds
  // anything else: less, more, or no runs at all. What the samples' fields hold is for who reads them to judge.
  bool decode(std::span<const std::byte> coded, std::size_t count, std::vector<std::byte>& samples);

 private:
  std::vector<std::byte> planes_;
};

}  // namespace gearshift
