// Reads numbers from a buffer in any of glTF's layouts: interleaved, normalised, sparse. check_gltf() has already
// checked the ranges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gearshift::engine {

// glTF 2.0, 3.6.2.2
enum class ComponentType : int { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };
std::size_t byte_size(ComponentType type);

// Elements at regular distances, the first one at `first`. If `first` is null, all elements are zero.
struct StridedData {
  const std::uint8_t* first = nullptr;
  std::size_t stride = 0;  // [bytes] distance between the starts of elements
};

struct AccessorData {
  StridedData elements;
  std::size_t count = 0;
  std::size_t components = 1;  // per element
  ComponentType type = ComponentType::f32;
  bool normalized = false;
  // For a sparse accessor: the indices of the replaced elements, and their new values.
  std::size_t sparse_count = 0;
  ComponentType sparse_type = ComponentType::u32;
  StridedData sparse_indices, sparse_values;
};

// Both functions return count * components numbers. They throw GltfError if a sparse index is out of range or out of
// order, or if a number is not finite.
std::vector<float> read_floats(const AccessorData& data);
std::vector<std::uint32_t> read_integers(const AccessorData& data);  // unsigned types only

}  // namespace gearshift::engine
