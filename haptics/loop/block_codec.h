// Lossless compression of trace samples to about a sixth of their size, with zstd. Each block is coded independently.
//
//   derive  commanded and f_j follow from other forces: store the XOR with what follows, which is usually 0
//   change  XOR each sample with the previous one: equal high bytes become zeros
//   planes  byte 0 of all samples, then byte 1 of all, and so on: this groups similar bytes for zstd
//
// Without these steps, zstd needs twice the bytes (110 instead of 62 per cycle of the paper's tour).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "haptics/loop/trace_format.h"

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace gearshift::haptics {

// [bytes] upper bound for any block; incompressible noise hardly grows.
inline constexpr std::size_t kMaxCodedBytes = kSamplesPerBlock * kSampleBytes * 257 / 256 + 64;

class BlockCodec {
 public:
  BlockCodec();

  // samples: 1 to kSamplesPerBlock encoded samples, concatenated. Replaces the content of `coded`; allocates nothing if
  // `coded` has capacity for kMaxCodedBytes and the block before was a full one. Throws std::bad_alloc.
  void encode(std::span<const std::byte> samples, std::vector<std::byte>& coded);

  // Replaces the content of `samples` with `count` decoded samples. Returns false if `count` is not 1 to
  // kSamplesPerBlock, or if `coded` does not hold exactly `count` samples; size and frame header are checked before
  // decoding. The values of the fields are not checked.
  bool decode(std::span<const std::byte> coded, std::size_t count, std::vector<std::byte>& samples);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* compressor) const noexcept;
    void operator()(ZSTD_DCtx_s* decompressor) const noexcept;
  };

  std::unique_ptr<ZSTD_CCtx_s, Free> compressor_;
  std::unique_ptr<ZSTD_DCtx_s, Free> decompressor_;
  std::vector<std::byte> derived_;
  std::vector<std::byte> planes_;
};

}  // namespace gearshift::haptics
