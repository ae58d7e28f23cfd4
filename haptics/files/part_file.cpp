#include "haptics/files/part_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "haptics/files/file_error.h"
#include "haptics/files/place_of.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

bool is_device_or_pipe(const fs::path& file) {
  std::error_code unknown;
  const fs::file_status found = fs::status(file, unknown);
  return fs::exists(found) && !fs::is_regular_file(found) && !fs::is_directory(found);
}

fs::path end_of_links(const fs::path& file) {
  std::error_code unknown;
  const fs::path end = fs::is_symlink(file, unknown) ? place_of(file) : file;
  return end.empty() ? file : end;
}

}  // namespace

PartFile::PartFile(const fs::path& file)
    : file_(file), place_(is_device_or_pipe(file) ? file : end_of_links(file)), part_(place_) {
  if (!is_device_or_pipe(file)) part_ += ".part" + std::to_string(getpid());
}

PartFile::~PartFile() {
  std::error_code ignored;
  if (part_ != place_) fs::remove(part_, ignored);
}

// A name can be taken from a file that may not be written; whoever locked it did not mean that.
void PartFile::refuse_locked() const {
  if (access(place_.c_str(), W_OK) == 0 || errno == ENOENT) return;
  throw FileError(file_.string(), 0, std::string("cannot be written: ") + std::strerror(errno));
}

// Who reads a pipe would take an empty text for the whole one.
void PartFile::prepare() {
  if (part_ != place_) write("");
}

void PartFile::write(std::string_view text) {
  refuse_locked();
  std::ofstream out(part_, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw FileError(file_.string(), 0, std::string("cannot be written: ") + std::strerror(errno));
}

void PartFile::keep() {
  if (part_ == place_) return;
  refuse_locked();
  std::error_code error;
  fs::rename(part_, place_, error);
  if (error) throw FileError(file_.string(), 0, "cannot be written: " + error.message());
}

void write_text_file(const fs::path& file, std::string_view text) {
  PartFile part(file);
  part.write(text);
  part.keep();
}

}  // namespace gearshift
