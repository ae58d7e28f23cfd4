#include "haptics/files/part_file.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include "haptics/files/file_error.h"

namespace gearshift {

PartFile::PartFile(const std::filesystem::path& file) : file_(file), part_(file) {
  part_ += ".part" + std::to_string(getpid());
}

PartFile::~PartFile() {
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void PartFile::write(std::string_view text) {
  std::ofstream out(part_, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw FileError(file_.string(), 0, "cannot be written");
}

void PartFile::keep() {
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) throw FileError(file_.string(), 0, "cannot be written: " + error.message());
}

void write_text_file(const std::filesystem::path& file, std::string_view text) {
  PartFile part(file);
  part.write(text);
  part.keep();
}

}  // namespace gearshift
