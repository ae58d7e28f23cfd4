#include "haptics/files/verified_file.h"

#include <string>

#include "haptics/files/atomic_file.h"
#include "haptics/files/file_error.h"

namespace gearshift::haptics {

void write_verified_file(const std::filesystem::path& file, std::string_view text,
                         const std::function<void(const std::filesystem::path&)>& read) {
  AtomicFile part(file);
  part.write(text);
  try {
    read(part.path());
  } catch (const FileError& error) {
    std::string reason = error.what();
    const std::size_t at = reason.find(part.path().string());
    if (at != std::string::npos) reason = reason.substr(reason.find(": ", at) + 2);
    throw FileError(file.string(), 0, "not written, because it could not be read back: " + reason);
  }
  part.commit();
}

}  // namespace gearshift::haptics
