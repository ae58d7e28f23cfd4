// Checked reading of TOML: every value has a range, every key must be known, and every error names file, line, key,
// value and allowed range. The only code that uses toml++.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/files/file_error.h"

namespace gearshift::haptics {

struct Range {
  double min, max;
};

// A table of the file. Keys carry their unit ("slot_width_mm"); values are returned as written.
class TomlTable {
 public:
  static TomlTable parse(std::string_view text, const std::string& file_name);

  bool has(std::string_view key) const;
  int line(std::string_view key = {}) const;  // line of the key, or of the table itself

  // These throw FileError if the value is missing, of the wrong type, not finite or out of range.
  double number(std::string_view key, Range range) const;
  std::string text(std::string_view key) const;
  std::string choice(std::string_view key, const std::vector<std::string>& allowed) const;
  // These return the fallback if the key is absent.
  bool flag_or(std::string_view key, bool fallback) const;
  double number_or(std::string_view key, double fallback, Range range) const;

  TomlTable table(std::string_view key) const;                // a sub-table; must exist
  std::vector<TomlTable> tables(std::string_view key) const;  // an array of tables; empty if absent

  // Call last: throws FileError for the first key that was never queried, listing the known keys.
  void reject_unknown_keys() const;

  // Throws FileError "FILE:LINE: key = value: reason"; an empty key means the whole table.
  [[noreturn]] void fail(std::string_view key, const std::string& reason) const;

 private:
  struct Node;
  explicit TomlTable(std::shared_ptr<Node> node);

  std::shared_ptr<Node> node_;  // shared by copies, so that all have the same set of queried keys
};

}  // namespace gearshift::haptics
