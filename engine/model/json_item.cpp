#include "engine/model/json_item.h"

#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "engine/model/gltf.h"
#include "engine/model/gltf_bytes.h"

namespace gearshift::engine {

using nlohmann::json;

namespace {

std::uint64_t integer_of(const json& value, const std::string& place, std::uint64_t low, std::uint64_t high) {
  const bool whole = value.is_number_unsigned();
  if (!whole || value.get<std::uint64_t>() < low || value.get<std::uint64_t>() > high) {
    throw GltfError(fmt::format("{} is not an integer from {} to {}", place, low, high));
  }
  return value.get<std::uint64_t>();
}

std::size_t index_of(const json& value, const std::string& place, std::size_t count) {
  if (!value.is_number_unsigned()) throw GltfError(fmt::format("{} is not an index", place));
  if (value.get<std::uint64_t>() >= count) {
    throw GltfError(fmt::format("{} is {}, but there are only {}", place, value.get<std::uint64_t>(), count));
  }
  return value.get<std::size_t>();
}

double number_of(const json& value, const std::string& place) {
  constexpr double most = std::numeric_limits<float>::max();
  if (!value.is_number() || !(std::abs(value.get<double>()) <= most)) {
    throw GltfError(fmt::format("{} is not a number in range", place));
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
  if (value != nullptr && !value->is_array()) throw GltfError(fmt::format("{} is not a list", place(key)));
  return value;
}

std::string JsonItem::place(std::string_view key) const {
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
  return integer_of(*value, place(key), low, high);
}

std::optional<std::size_t> JsonItem::index(const char* key, std::size_t count) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return index_of(*value, place(key), count);
}

std::optional<double> JsonItem::number(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return number_of(*value, place(key));
}

std::optional<std::string> JsonItem::text(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_string()) throw GltfError(fmt::format("{} is not a string", place(key)));
  return value->get<std::string>();
}

std::optional<JsonItem> JsonItem::item(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return JsonItem(*value, place(key));
}

bool JsonItem::flag(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) return false;
  if (!value->is_boolean()) throw GltfError(fmt::format("{} is neither true nor false", place(key)));
  return value->get<bool>();
}

void JsonItem::numbers(const char* key, std::size_t count) const {
  const json* value = list(key);
  if (value == nullptr) return;
  if (value->size() != count) throw GltfError(fmt::format("{} is not a list of {} numbers", place(key), count));
  for (const json& number : *value) number_of(number, place(key));
}

template <typename T>
T JsonItem::required(std::optional<T> value, const char* key) const {
  if (!value) throw GltfError(fmt::format("{} is missing", place(key)));
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
    found.emplace_back((*value)[i], fmt::format("{}[{}]", place(key), i));
  }
  return found;
}

std::vector<std::size_t> JsonItem::indices(const char* key, std::size_t count) const {
  std::vector<std::size_t> found;
  const json* value = list(key);
  for (std::size_t i = 0; value != nullptr && i < value->size(); ++i) {
    found.push_back(index_of((*value)[i], fmt::format("{}[{}]", place(key), i), count));
  }
  return found;
}

std::vector<std::string> JsonItem::texts(const char* key) const {
  std::vector<std::string> found;
  const json* value = list(key);
  for (std::size_t i = 0; value != nullptr && i < value->size(); ++i) {
    if (!(*value)[i].is_string()) throw GltfError(fmt::format("{}[{}] is not a string", place(key), i));
    found.push_back((*value)[i].get<std::string>());
  }
  return found;
}

std::vector<std::pair<std::string, std::size_t>> JsonItem::named_indices(const char* key, std::size_t count) const {
  const JsonItem object = required_item(key);
  std::vector<std::pair<std::string, std::size_t>> found;
  for (const auto& [name, value] : object.value_->items()) {
    found.emplace_back(name, index_of(value, object.place(printable_name(name)), count));
  }
  return found;
}

}  // namespace gearshift::engine
