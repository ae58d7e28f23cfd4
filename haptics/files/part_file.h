// A file that is there whole or not at all: written beside its place, then renamed. A link stays one: what it leads to is
// written. A device or a pipe (/dev/null, /dev/stdout) is written to and stays what it is. What may not be written keeps
// its name, too.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gearshift {

class PartFile {
 public:
  explicit PartFile(const std::filesystem::path& file);
  ~PartFile();  // what was not kept is gone
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::filesystem::path& path() const noexcept { return part_; }  // where it is written
  void prepare();                     // before long work. Throws FileError where it cannot be written
  void write(std::string_view text);  // all of it. Throws FileError
  void keep();                        // under its name. Throws FileError

 private:
  void refuse_locked() const;

  std::filesystem::path file_, place_, part_;
};

// Throws FileError; then what was there before still is.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace gearshift
