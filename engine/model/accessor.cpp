#include "engine/model/accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/model/gltf.h"

namespace gearshift::engine {

namespace {

template <typename T>
T load(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);  // data in a file need not be aligned
  return value;
}

// Converts a number to float. A normalised integer c becomes c / 255, max(c / 127, -1), ... depending on its type (glTF
// 2.0, section 3.6.2.2).
float as_float(const std::uint8_t* at, ComponentType type, bool normalized) {
  switch (type) {
    case ComponentType::i8: {
      const auto c = static_cast<float>(load<std::int8_t>(at));
      return normalized ? std::max(c / 127.0f, -1.0f) : c;
    }
    case ComponentType::u8:
      return static_cast<float>(*at) / (normalized ? 255.0f : 1.0f);
    case ComponentType::i16: {
      const auto c = static_cast<float>(load<std::int16_t>(at));
      return normalized ? std::max(c / 32767.0f, -1.0f) : c;
    }
    case ComponentType::u16:
      return static_cast<float>(load<std::uint16_t>(at)) / (normalized ? 65535.0f : 1.0f);
    case ComponentType::u32:
      return static_cast<float>(load<std::uint32_t>(at));
    case ComponentType::f32:
      break;
  }
  const auto value = load<float>(at);
  if (!std::isfinite(value)) throw GltfError("the file contains a number that is not finite");
  return value;
}

std::uint32_t as_integer(const std::uint8_t* at, ComponentType type) {
  if (type == ComponentType::u8) return *at;
  return type == ComponentType::u16 ? load<std::uint16_t>(at) : load<std::uint32_t>(at);
}

template <typename T, typename Convert>
void read_element(const AccessorData& data, const std::uint8_t* at, T* out, Convert convert) {
  for (std::size_t c = 0; c < data.components; ++c) out[c] = convert(at + c * byte_size(data.type));
}

template <typename T, typename Convert>
std::vector<T> read(const AccessorData& data, Convert convert) {
  std::vector<T> out(data.count * data.components);
  for (std::size_t i = 0; data.elements.first != nullptr && i < data.count; ++i) {
    read_element(data, data.elements.first + i * data.elements.stride, &out[i * data.components], convert);
  }
  std::uint64_t next = 0;  // lowest valid value of the next sparse index: indices must increase
  for (std::size_t i = 0; i < data.sparse_count; ++i) {
    const std::uint8_t* at = data.sparse_indices.first + i * data.sparse_indices.stride;
    const std::uint64_t index = as_integer(at, data.sparse_type);
    if (index < next || index >= data.count) throw GltfError("the file has a sparse accessor with invalid indices");
    next = index + 1;
    read_element(data, data.sparse_values.first + i * data.sparse_values.stride, &out[index * data.components],
                 convert);
  }
  return out;
}

}  // namespace

std::size_t byte_size(ComponentType type) {
  if (type == ComponentType::i8 || type == ComponentType::u8) return 1;
  return type == ComponentType::i16 || type == ComponentType::u16 ? 2 : 4;
}

std::vector<float> read_floats(const AccessorData& data) {
  return read<float>(data, [&](const std::uint8_t* at) { return as_float(at, data.type, data.normalized); });
}

std::vector<std::uint32_t> read_integers(const AccessorData& data) {
  return read<std::uint32_t>(data, [&](const std::uint8_t* at) { return as_integer(at, data.type); });
}

}  // namespace gearshift::engine
