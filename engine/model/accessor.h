// Numbers in a buffer as glTF lays them out: interleaved, normalised, sparse. The ranges were checked by gltf_check.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gearshift {

// glTF 2.0, 3.6.2.2
enum class ComponentType : int { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };
std::size_t byte_size(ComponentType type);

// `count` elements of some components each, the first at `first`. No bytes: all zero.
struct StridedData {
  const std::uint8_t* first = nullptr;
  std::size_t stride = 0;  // [bytes] from element to element
};

struct AccessorData {
  StridedData elements;
  std::size_t count = 0;
  std::size_t components = 1;  // of an element
  ComponentType type = ComponentType::f32;
  bool normalized = false;
  // Sparse: the elements that differ.
  std::size_t sparse_count = 0;
  ComponentType sparse_type = ComponentType::u32;
  StridedData sparse_indices, sparse_values;
};

// count * components of them. Throws GltfError where a sparse index is out of range or out of order, and where a number
// is not finite.
std::vector<float> read_floats(const AccessorData& data);
std::vector<std::uint32_t> read_integers(const AccessorData& data);  // of an unsigned type

}  // namespace gearshift
