// Encodes fields as bytes: little-endian, doubles by their exact bits (including signed zeros, infinities and NaN
// payloads), bool and enumerations as one byte.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "haptics/files/fnv_1a.h"
#include "haptics/loop/trace_fields.h"

namespace gearshift::haptics {

static_assert(std::endian::native == std::endian::little, "the trace is written by copying native bytes");

// The field's bits as stored in the trace file.
template <LeafField T>
auto leaf_bits(T value) noexcept {
  if constexpr (std::is_same_v<T, double>)
    return std::bit_cast<std::uint64_t>(value);
  else if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>)
    return static_cast<std::uint8_t>(value);
  else
    return static_cast<std::make_unsigned_t<T>>(value);
}

template <class T>
constexpr std::size_t encoded_size() {
  std::size_t bytes = 0;
  T value{};
  auto count = [&bytes](auto& self, auto& member) -> void {
    if constexpr (LeafField<std::remove_cvref_t<decltype(member)>>)
      bytes += sizeof(leaf_bits(member));
    else
      each_field(member, [&self](const char*, auto& inner) { self(self, inner); });
  };
  count(count, value);
  return bytes;
}

// One number for the names, types and order of all fields of these structs.
template <class... Structs>
constexpr std::uint64_t fields_hash() {
  std::uint64_t hash = fnv_1a("");
  const auto add = [&hash](const auto& self, std::string_view name, const auto& member) -> void {
    using Member = std::remove_cvref_t<decltype(member)>;
    hash = fnv_1a(name, hash);
    if constexpr (LeafField<Member>) {
      constexpr bool kIsBool = std::is_same_v<Member, bool>, kIsSigned = std::is_signed_v<Member>;
      constexpr char kKind = std::is_enum_v<Member> ? 'e' : kIsBool ? 'b' : kIsSigned ? 's' : 'u';
      constexpr char kType[] = {std::is_floating_point_v<Member> ? 'f' : kKind, '0' + sizeof(Member)};
      hash = fnv_1a({kType, 2}, hash);
    } else {
      each_field(member, [&self](const char* field, const auto& inner) { self(self, field, inner); });
    }
  };
  (add(add, "", Structs{}), ...);
  return hash;
}

// Writes fields one after another into a buffer, which must be large enough.
class FieldWriter {
 public:
  explicit FieldWriter(std::byte* to) noexcept : at_(to) {}

  template <class T>
  void put(const T& value) noexcept {
    if constexpr (LeafField<T>) {
      const auto bits = leaf_bits(value);
      std::memcpy(at_, &bits, sizeof bits);
      at_ += sizeof bits;
    } else {
      each_field(value, [this](const char*, const auto& member) { this->put(member); });
    }
  }

 private:
  std::byte* at_;
};

// Reads fields from bytes. ok() becomes false when bytes are missing or a value is outside its enumeration.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> from) noexcept : left_(from) {}

  template <class T>
  void take(T& value) noexcept {
    if constexpr (LeafField<T>)
      read_leaf(value);
    else
      each_field(value, [this](const char*, auto& member) { this->take(member); });
  }

  bool read_text(std::string& text) {
    std::uint32_t size = 0;
    take(size);
    if (!ok_ || size > left_.size()) return ok_ = false;
    text.assign(reinterpret_cast<const char*>(left_.data()), size);
    left_ = left_.subspan(size);
    return true;
  }

  bool ok() const noexcept { return ok_; }
  bool at_end() const noexcept { return left_.empty(); }

 private:
  template <LeafField T>
  void read_leaf(T& value) noexcept {
    decltype(leaf_bits(value)) bits{};
    if (left_.size() < sizeof bits) {
      ok_ = false;
      return;
    }
    std::memcpy(&bits, left_.data(), sizeof bits);
    left_ = left_.subspan(sizeof bits);
    if constexpr (std::is_same_v<T, double>) {
      value = std::bit_cast<double>(bits);
    } else if constexpr (std::is_same_v<T, bool>) {
      ok_ = ok_ && bits <= 1;
      value = bits == 1;
    } else if constexpr (std::is_enum_v<T>) {
      ok_ = ok_ && bits <= leaf_bits(last_value(T{}));
      value = static_cast<T>(bits);
    } else {
      value = static_cast<T>(bits);
    }
  }

  std::span<const std::byte> left_;
  bool ok_ = true;
};

}  // namespace gearshift::haptics
