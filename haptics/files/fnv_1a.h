// This work is based on:
// Glenn Fowler, Landon Curt Noll, Kiem-Phong Vo, Donald Eastlake. The FNV Non-Cryptographic Hash Algorithm. 2019
//
// A hash for data that is stored. Unlike std::hash, it gives the same value on every machine. Detects accidental
// changes, not deliberate ones.
#pragma once

#include <cstdint>
#include <string_view>

namespace gearshift::haptics {

// so_far: hash of the preceding text.
constexpr std::uint64_t fnv_1a(std::string_view text, std::uint64_t so_far = 0xcbf29ce484222325u) noexcept {
  std::uint64_t hash = so_far;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

static_assert(fnv_1a("") == 0xcbf29ce484222325u && fnv_1a("foobar") == 0x85944171f73967e8u);  // published vectors
static_assert(fnv_1a("bar", fnv_1a("foo")) == fnv_1a("foobar"));

}  // namespace gearshift::haptics
