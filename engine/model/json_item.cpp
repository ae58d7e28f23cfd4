#include "engine/model/json_item.h"

#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "engine/model/gltf.h"
#include "engine/model/gltf_bytes.h"

namespace gearshift::engine {

using nlohmann::json;

namespace {

std::uint64_t integer_of(const json& value, const std::string& path, std::uint64_t low, std::uint64_t high) {
  const bool is_integer = value.is_number_unsigned();
  if (!is_integer || value.get<std::uint64_t>() < low || value.get<std::uint64_t>() > high) {
    throw GltfError(fmt::format("{} is not an integer from {} to {}", path, low, high));
  }
  return value.get<std::uint64_t>();
}

std::size_t index_of(const json& value, const std::string& path, std::size_t count) {
  if (!value.is_number_unsigned()) throw GltfError(fmt::format("{} is not an index", path));
  if (value.get<std::uint64_t>() >= count) {
    throw GltfError(fmt::format("{} is {}, but there are only {}", path, value.get<std::uint64_t>(), count));
  }
  return value.get<std::size_t>();
}

double number_of(const json& value, const std::string& path) {
  constexpr double max = std::numeric_limits<float>::max();
  if (!value.is_number() || !(std::abs(value.get<double>()) <= max)) {
    throw GltfError(fmt::format("{} is not a number or is out of range", path));
  }
  return value.get<double>();
}

}  // namespace

JsonItem::JsonItem(const json& value, std::string path) : value_(&value), path_(std::move(path)) {
  if (!value.is_object()) throw GltfError(fmt::format("{} is not a JSON object", path_.empty() ? "it" : path_));
}

const json* JsonItem::find(const char* key) const {
  const auto found = value_->find(key);
  return found == value_->end() ? nullptr : &*found;
}

const json* JsonItem::list(const char* key) const {
  const json* value = find(key);
  if (value != nullptr && !value->is_array()) throw GltfError(fmt::format("{} is not a list", path_of(key)));
  return value;
}

std::string JsonItem::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

bool JsonItem::has(const char* key) const {
  return find(key) != nullptr;
}

void JsonItem::reject(std::string_view what) const {
  throw GltfError(fmt::format("{} {}", path_, what));
}

std::optional<std::uint64_t> JsonItem::integer(const char* key, std::uint64_t low, std::uint64_t high) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return integer_of(*value, path_of(key), low, high);
}

std::optional<std::size_t> JsonItem::index(const char* key, std::size_t count) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return index_of(*value, path_of(key), count);
}

std::optional<double> JsonItem::number(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return number_of(*value, path_of(key));
}

std::optional<std::string> JsonItem::text(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_string()) throw GltfError(fmt::format("{} is not a string", path_of(key)));
  return value->get<std::string>();
}

std::optional<JsonItem> JsonItem::item(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return JsonItem(*value, path_of(key));
}

bool JsonItem::flag(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) return false;
  if (!value->is_boolean()) throw GltfError(fmt::format("{} is neither true nor false", path_of(key)));
  return value->get<bool>();
}

void JsonItem::numbers(const char* key, std::size_t count) const {
  const json* value = list(key);
  if (value == nullptr) return;
  if (value->size() != count) throw GltfError(fmt::format("{} is not a list of {} numbers", path_of(key), count));
  for (const json& number : *value) number_of(number, path_of(key));
}

template <typename T>
T JsonItem::required(std::optional<T> value, const char* key) const {
  if (!value) throw GltfError(fmt::format("{} is missing", path_of(key)));
  return std::move(*value);
}

std::uint64_t JsonItem::required_integer(const char* key, std::uint64_t low, std::uint64_t high) const {
  return required(integer(key, low, high), key);
}
std::size_t JsonItem::required_index(const char* key, std::size_t count) const {
  return required(index(key, count), key);
}
std::string JsonItem::required_text(const char* key) const {
  return required(text(key), key);
}
JsonItem JsonItem::required_item(const char* key) const {
  return required(item(key), key);
}

std::vector<JsonItem> JsonItem::items(const char* key) const {
  std::vector<JsonItem> found;
  const json* value = list(key);
  for (std::size_t i = 0; value != nullptr && i < value->size(); ++i) {
    found.emplace_back((*value)[i], fmt::format("{}[{}]", path_of(key), i));
  }
  return found;
}

std::vector<std::size_t> JsonItem::indices(const char* key, std::size_t count) const {
  std::vector<std::size_t> found;
  const json* value = list(key);
  for (std::size_t i = 0; value != nullptr && i < value->size(); ++i) {
    found.push_back(index_of((*value)[i], fmt::format("{}[{}]", path_of(key), i), count));
  }
  return found;
}

std::vector<std::string> JsonItem::texts(const char* key) const {
  std::vector<std::string> found;
  const json* value = list(key);
  for (std::size_t i = 0; value != nullptr && i < value->size(); ++i) {
    if (!(*value)[i].is_string()) throw GltfError(fmt::format("{}[{}] is not a string", path_of(key), i));
    found.push_back((*value)[i].get<std::string>());
  }
  return found;
}

std::vector<std::pair<std::string, std::size_t>> JsonItem::named_indices(const char* key, std::size_t count) const {
  const JsonItem object = required_item(key);
  std::vector<std::pair<std::string, std::size_t>> found;
  for (const auto& [name, value] : object.value_->items()) {
    found.emplace_back(name, index_of(value, object.path_of(printable_name(name)), count));
  }
  return found;
}

}  // namespace gearshift::engine
