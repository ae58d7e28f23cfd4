#include "haptics/files/text_file.h"

#include <fstream>
#include <system_error>

#include "haptics/files/file_error.h"

namespace gearshift::haptics {

std::string read_text_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::none)
    throw FileError(name, 0, "cannot be read (" + error.message() + ")");
  if (!std::filesystem::exists(status)) throw FileError(name, 0, "there is no such file");
  if (std::filesystem::is_directory(status)) throw FileError(name, 0, "this is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw FileError(name, 0, "this is not a regular file");

  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(name, 0, "cannot be read");
  // Try to read one byte more than allowed, which detects an oversized file even if it grows in the meantime.
  std::string text(kMaxTextFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw FileError(name, 0, "cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMaxTextFile) throw FileError(name, 0, "the file is larger than 1 MiB");
  return text;
}

}  // namespace gearshift::haptics
