// Atomic file replacement: the file is written to a temporary file in the same folder, then renamed. For a symbolic
// link the target is replaced and the link stays. A device or pipe (/dev/null, /dev/stdout) is written directly. A
// write-protected file is not replaced.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gearshift::haptics {

class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& file);
  ~AtomicFile();  // removes the temporary file unless it was committed
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const noexcept { return temporary_; }  // the file being written
  void prepare();                     // checks before long work that the file can be written. Throws FileError
  void write(std::string_view text);  // writes the whole content. Throws FileError
  void commit();                      // gives the file its final name. Throws FileError

 private:
  void check_writable() const;

  std::filesystem::path file_, target_, temporary_;
};

// Replaces the file atomically. On FileError its previous content is unchanged.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace gearshift::haptics
