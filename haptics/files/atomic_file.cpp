#include "haptics/files/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "haptics/files/file_error.h"
#include "haptics/files/resolve_path.h"

namespace gearshift::haptics {
namespace {

namespace fs = std::filesystem;

bool is_device_or_pipe(const fs::path& file) {
  std::error_code unknown;
  const fs::file_status found = fs::status(file, unknown);
  return fs::exists(found) && !fs::is_regular_file(found) && !fs::is_directory(found);
}

fs::path end_of_links(const fs::path& file) {
  std::error_code unknown;
  const fs::path end = fs::is_symlink(file, unknown) ? resolve_path(file) : file;
  return end.empty() ? file : end;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& file)
    : file_(file), target_(is_device_or_pipe(file) ? file : end_of_links(file)), temporary_(target_) {
  if (!is_device_or_pipe(file)) temporary_ += ".part" + std::to_string(getpid());
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (temporary_ != target_) fs::remove(temporary_, ignored);
}

// Throws if the file is write-protected, because rename() would replace it anyway.
void AtomicFile::check_writable() const {
  if (access(target_.c_str(), W_OK) == 0 || errno == ENOENT) return;
  throw FileError(file_.string(), 0, std::string("cannot be written (") + std::strerror(errno) + ")");
}

// Writes an empty temporary file, to detect errors early. A device or pipe has no temporary file and is skipped,
// because the reader of a pipe would take the empty text for the whole content.
void AtomicFile::prepare() {
  if (temporary_ != target_) write("");
}

void AtomicFile::write(std::string_view text) {
  check_writable();
  std::ofstream out(temporary_, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw FileError(file_.string(), 0, std::string("cannot be written (") + std::strerror(errno) + ")");
}

void AtomicFile::commit() {
  if (temporary_ == target_) return;
  check_writable();
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) throw FileError(file_.string(), 0, "cannot be written (" + error.message() + ")");
}

void write_text_file(const fs::path& file, std::string_view text) {
  AtomicFile part(file);
  part.write(text);
  part.commit();
}

}  // namespace gearshift::haptics
