#include "haptics/files/toml_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <toml++/toml.h>

#include "haptics/files/number_text.h"
#include "haptics/files/printable.h"
#include "haptics/files/text_file.h"

namespace gearshift::haptics {
namespace {

constexpr std::size_t kMaxTextLength = 200;  // [bytes] longest text value accepted; enough for names and sentences
constexpr int kMaxKeyParts = 8;              // maximum number of parts of a dotted key such as "a.b.c"

int line_of(const toml::node& node) {
  return static_cast<int>(node.source().begin.line);
}

std::string join(const std::vector<std::string>& items) {
  std::string list;
  for (const auto& item : items) list += (list.empty() ? "" : ", ") + item;
  return list;
}

// Truncates long text, but never inside a UTF-8 character.
std::string shortened(std::string_view text) {
  constexpr std::size_t kShown = 40;
  if (text.size() <= kShown) return std::string(text);
  std::size_t end = kShown;
  while ((static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "...";
}

// Text of a value, for messages. A table is shown as "(a table)", a list as "(a list)".
std::string value_text(const toml::node& node) {
  if (const auto* text = node.as_string()) return '"' + shortened(text->get()) + '"';
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* number = node.as_floating_point()) return number_text(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (node.is_table()) return "(a table)";
  return node.is_array() ? "(a list)" : "(a date or time)";
}

// Index of the first character after the string literal that starts at `at`. Parses the literal like toml++.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool is_long = text.substr(at).starts_with(std::string(3, quote));
  const std::string closing(is_long ? 3 : 1, quote);
  for (at += closing.size(); at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (!is_long && text[at] == '\n') {
      return at;
    } else if (text.substr(at).starts_with(closing)) {
      at += closing.size();
      for (int more = 0; is_long && more < 2 && at < text.size() && text[at] == quote; ++more)
        ++at;  // up to two quotes of the text may precede the three that close it
      return at;
    }
  }
  return text.size();
}

// Rejects keys with too many parts. toml++ accepts even a million parts, but destroying such deeply nested tables
// overflows the stack.
void reject_long_keys(std::string_view text, const std::string& file) {
  const auto fail_at = [&](std::size_t at) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw FileError(file, static_cast<int>(line), "a key must have at most " + std::to_string(kMaxKeyParts) + " parts");
  };
  int dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots >= kMaxKeyParts) fail_at(at);
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
    } else {
      at = c == '#' ? std::min(text.find('\n', at), text.size()) : at + 1;
    }
  }
}

toml::table parse_toml(std::string_view text, const std::string& file) {
  reject_long_keys(text, file);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const int line = static_cast<int>(error.source().begin.line);
    throw FileError(file, line, "not valid TOML: " + std::string(error.description()));
  }
}

std::string between(Range range) {
  return "between " + number_text(range.min) + " and " + number_text(range.max);
}

}  // namespace

struct TomlTable::Node {
  std::shared_ptr<const toml::table> root;  // keeps `table` alive
  const toml::table* table = nullptr;
  std::string file;
  std::vector<std::string> known_keys;  // all keys the caller has asked for so far

  // Looks up a key and marks it as known, even if the file does not contain it.
  const toml::node* find(std::string_view key) {
    if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) known_keys.emplace_back(key);
    return table->get(key);
  }
};

TomlTable::TomlTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}

TomlTable TomlTable::parse(std::string_view text, const std::string& file_name) {
  if (text.size() > kMaxTextFile) throw FileError(file_name, 0, "the file is larger than 1 MiB");
  auto root = std::make_shared<const toml::table>(parse_toml(text, file_name));
  const toml::table* table = root.get();
  return TomlTable(std::make_shared<Node>(Node{std::move(root), table, file_name, {}}));
}

bool TomlTable::has(std::string_view key) const {
  return node_->find(key) != nullptr;
}

bool TomlTable::is_text(std::string_view key) const {
  const toml::node* value = node_->find(key);
  return value != nullptr && value->is_string();
}

int TomlTable::line(std::string_view key) const {
  const toml::node* value = key.empty() ? nullptr : node_->table->get(key);
  return line_of(value != nullptr ? *value : *node_->table);
}

double TomlTable::number(std::string_view key, Range range) const {
  const toml::node* value = node_->find(key);
  const std::string limits = between(range);
  if (value == nullptr) fail(key, "is missing: it must be a number " + limits);
  if (!value->is_number()) fail(key, "must be a number " + limits);
  const double number = value->value<double>().value_or(NAN);
  // The condition is negated so that NaN is rejected too: comparisons with NaN are false.
  if (!(number >= range.min && number <= range.max)) fail(key, "must be " + limits);
  return number;
}

std::string TomlTable::text(std::string_view key) const {
  const toml::node* value = node_->find(key);
  if (value == nullptr) fail(key, "is missing: it must be text in quotes");
  if (!value->is_string()) fail(key, "must be text in quotes");
  const std::string& content = value->as_string()->get();
  if (content.empty()) fail(key, "must not be empty");
  if (content.size() > kMaxTextLength) fail(key, "must be at most " + std::to_string(kMaxTextLength) + " bytes long");
  if (!is_printable(content)) fail(key, "must be one line without control characters");
  return content;
}

std::string TomlTable::choice(std::string_view key, const std::vector<std::string>& allowed) const {
  if (node_->find(key) == nullptr) fail(key, "is missing: it must be one of " + join(allowed));
  std::string word = text(key);
  if (std::find(allowed.begin(), allowed.end(), word) == allowed.end()) {
    fail(key, "must be one of " + join(allowed));
  }
  return word;
}

bool TomlTable::flag_or(std::string_view key, bool fallback) const {
  const toml::node* value = node_->find(key);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) fail(key, "must be true or false");
  return value->as_boolean()->get();
}

double TomlTable::number_or(std::string_view key, double fallback, Range range) const {
  return has(key) ? number(key, range) : fallback;
}

TomlTable TomlTable::table(std::string_view key) const {
  const toml::node* value = node_->find(key);
  if (value == nullptr) fail(key, "is missing: it must be a table, [" + std::string(key) + "]");
  if (!value->is_table()) fail(key, "must be a table: write [" + std::string(key) + "]");
  return TomlTable(std::make_shared<Node>(Node{node_->root, value->as_table(), node_->file, {}}));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  std::vector<TomlTable> list;
  const toml::node* value = node_->find(key);
  if (value == nullptr) return list;
  const std::string must = "must be a list of tables: write each as [[" + std::string(key) + "]]";
  if (!value->is_array()) fail(key, must);
  for (const toml::node& item : *value->as_array()) {
    if (!item.is_table()) throw FileError(node_->file, line_of(item), std::string(key) + " " + must);
    list.push_back(TomlTable(std::make_shared<Node>(Node{node_->root, item.as_table(), node_->file, {}})));
  }
  return list;
}

void TomlTable::reject_unknown_keys() const {
  for (const auto& [key, value] : *node_->table) {
    const auto& known_keys = node_->known_keys;
    if (std::find(known_keys.begin(), known_keys.end(), key.str()) != known_keys.end()) continue;
    const std::string name = shortened(key.str());
    throw FileError(node_->file, line_of(value), name + " is not a known key; known keys: " + join(known_keys));
  }
}

void TomlTable::fail(std::string_view key, const std::string& reason) const {
  if (key.empty()) throw FileError(node_->file, line(), reason);
  const toml::node* value = node_->table->get(key);
  const std::string name(key);
  if (value == nullptr) throw FileError(node_->file, line(), name + " " + reason);
  throw FileError(node_->file, line_of(*value), name + " = " + value_text(*value) + ": " + reason);
}

}  // namespace gearshift::haptics
