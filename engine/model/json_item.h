// Access to an untrusted JSON object. Each accessor checks the type and the range of the value; its error message
// states the value's path and allowed range.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace gearshift::engine {

class JsonItem {
 public:
  // Throws GltfError if `value` is not an object. `path`: place of the object in the file, for example "accessors[3]";
  // empty for the root.
  JsonItem(const nlohmann::json& value, std::string path);

  bool has(const char* key) const;
  const std::string& path() const { return path_; }
  // Throws GltfError with the path followed by `what`.
  [[noreturn]] void reject(std::string_view what) const;

  // These functions return an empty value if the key is missing, and throw if the value has the wrong type or is out of
  // range.
  std::optional<std::uint64_t> integer(const char* key, std::uint64_t low, std::uint64_t high) const;
  std::optional<std::size_t> index(const char* key, std::size_t count) const;  // index into a list of `count` items
  std::optional<double> number(const char* key) const;                         // finite, also when converted to float
  std::optional<std::string> text(const char* key) const;
  std::optional<JsonItem> item(const char* key) const;
  bool flag(const char* key) const;  // false if the key is missing
  void numbers(const char* key, std::size_t count) const;

  // These functions also throw if the key is missing.
  std::uint64_t required_integer(const char* key, std::uint64_t low, std::uint64_t high) const;
  std::size_t required_index(const char* key, std::size_t count) const;
  std::string required_text(const char* key) const;
  JsonItem required_item(const char* key) const;

  // These functions return empty lists if the key is missing.
  std::vector<JsonItem> items(const char* key) const;
  std::vector<std::size_t> indices(const char* key, std::size_t count) const;
  std::vector<std::string> texts(const char* key) const;
  // Names and values of the members of the object at `key`; each value must be an index.
  std::vector<std::pair<std::string, std::size_t>> named_indices(const char* key, std::size_t count) const;

 private:
  const nlohmann::json* find(const char* key) const;
  const nlohmann::json* list(const char* key) const;
  std::string path_of(std::string_view key) const;
  template <typename T>
  T required(std::optional<T> value, const char* key) const;

  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace gearshift::engine
