// Checked reading of TOML files. Every value has a range, every key must be known, and every error message states file,
// line, key, value and allowed range. Only this reader uses toml++.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/files/file_error.h"
#include "haptics/files/parameter.h"

namespace gearshift::haptics {

// A table of the file. Keys carry their unit ("slot_width_mm"); values are returned in this unit, without conversion.
class TomlTable {
 public:
  static TomlTable parse(std::string_view text, const std::string& file_name);

  bool has(std::string_view key) const;
  bool is_text(std::string_view key) const;
  int line(std::string_view key = {}) const;  // line of the key, or of the table if the key is empty

  // These functions throw FileError if the value is missing, of the wrong type, not finite or out of range.
  double number(std::string_view key, Range range) const;
  std::string text(std::string_view key) const;
  std::string choice(std::string_view key, const std::vector<std::string>& allowed) const;
  // These functions return the fallback if the key is absent.
  bool flag_or(std::string_view key, bool fallback) const;
  double number_or(std::string_view key, double fallback, Range range) const;

  TomlTable table(std::string_view key) const;                // returns a sub-table, which must exist
  std::vector<TomlTable> tables(std::string_view key) const;  // returns an array of tables; empty if the key is absent

  // Call this after all other queries. Throws FileError for the first key in the file that was never queried; the
  // message lists the known keys.
  void reject_unknown_keys() const;

  // Throws a FileError with the text "FILE:LINE: key = value: reason". An empty key refers to the whole table.
  [[noreturn]] void fail(std::string_view key, const std::string& reason) const;

 private:
  struct Node;
  explicit TomlTable(std::shared_ptr<Node> node);

  std::shared_ptr<Node> node_;  // shared by all copies, so that they share one set of queried keys
};

}  // namespace gearshift::haptics
