// A JSON object that is believed nothing: every look at it names the place and the range, and refuses in one sentence.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace gearshift {

class JsonItem {
 public:
  // Throws GltfError where `value` is no object. path: "accessors[3]"; empty for the root.
  JsonItem(const nlohmann::json& value, std::string path);

  bool has(const char* key) const;
  const std::string& path() const { return path_; }
  // Throws GltfError: the place, then `what`.
  [[noreturn]] void refuse(std::string_view what) const;

  // Nothing where the key is missing; refused where the value is no such thing.
  std::optional<std::uint64_t> integer(const char* key, std::uint64_t low, std::uint64_t high) const;
  std::optional<std::size_t> index(const char* key, std::size_t count) const;  // into a list of `count`
  std::optional<double> number(const char* key) const;                         // finite as float
  std::optional<std::string> text(const char* key) const;
  std::optional<JsonItem> item(const char* key) const;
  bool flag(const char* key) const;  // false where the key is missing
  void numbers(const char* key, std::size_t count) const;

  // Refused where the key is missing.
  std::uint64_t needed_integer(const char* key, std::uint64_t low, std::uint64_t high) const;
  std::size_t needed_index(const char* key, std::size_t count) const;
  std::string needed_text(const char* key) const;
  JsonItem needed_item(const char* key) const;

  // Empty where the key is missing.
  std::vector<JsonItem> items(const char* key) const;
  std::vector<std::size_t> indices(const char* key, std::size_t count) const;
  std::vector<std::string> texts(const char* key) const;
  // The members of an object, each an index.
  std::vector<std::pair<std::string, std::size_t>> named_indices(const char* key, std::size_t count) const;

 private:
  const nlohmann::json* find(const char* key) const;
  const nlohmann::json* list(const char* key) const;
  std::string place(std::string_view key) const;
  template <typename T>
  T needed(std::optional<T> value, const char* key) const;

  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace gearshift
