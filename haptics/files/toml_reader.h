// Checked reading of TOML: every value has a range, every key must be known, every refusal names file, line,
// key, value and allowed range. The only place that sees toml++.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/files/file_error.h"

namespace gearshift {

struct Range {
  double min, max;
};

// A table of the file. Keys carry their unit ("slot_width_mm"); values are returned as written.
class TomlTable {
 public:
  static TomlTable parse(std::string_view text, const std::string& file_name);

  bool has(std::string_view key) const;
  int line(std::string_view key = {}) const;  // of the key, or of the table itself

  // Throw FileError when missing, of another type, not finite or out of range.
  double number(std::string_view key, Range range) const;
  std::string text(std::string_view key) const;
  std::string choice(std::string_view key, const std::vector<std::string>& allowed) const;
  // The fallback where the key is absent.
  bool flag_or(std::string_view key, bool fallback) const;
  double number_or(std::string_view key, double fallback, Range range) const;

  TomlTable table(std::string_view key) const;                // a sub-table; must exist
  std::vector<TomlTable> tables(std::string_view key) const;  // an array of tables; empty where absent

  // Call last: refuses the first key that nothing has asked for, naming the keys that are known.
  void refuse_unknown_keys() const;

  // "FILE:LINE: key = value: reason"; the table as a whole where key is empty.
  [[noreturn]] void fail(std::string_view key, const std::string& reason) const;

 private:
  struct Node;
  explicit TomlTable(std::shared_ptr<Node> node);

  std::shared_ptr<Node> node_;  // shared by copies, which so remember together what has been asked for
};

}  // namespace gearshift
