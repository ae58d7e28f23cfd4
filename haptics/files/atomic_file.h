// Replaces a file atomically: the content is written to a temporary file in the same folder, which is then renamed. If
// the file is a symbolic link, its target is replaced and the link stays. A device or pipe (/dev/null, /dev/stdout) is
// written directly. A write-protected file is not replaced.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gearshift::haptics {

class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& file);
  ~AtomicFile();  // removes the temporary file if it was not committed
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const noexcept { return temporary_; }  // the temporary file
  void prepare();                     // call before long work: throws FileError if the file cannot be written
  void write(std::string_view text);  // writes the whole content; throws FileError
  void commit();                      // renames the temporary file to the final name; throws FileError

 private:
  void check_writable() const;

  std::filesystem::path file_, target_, temporary_;
};

// Replaces the content of a file atomically. If it throws FileError, the previous content is unchanged.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace gearshift::haptics
