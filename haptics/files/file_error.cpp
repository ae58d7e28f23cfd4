#include "haptics/files/file_error.h"

namespace gearshift {
namespace {

std::string sentence(const std::string& file, int line, const std::string& reason) {
  return line > 0 ? file + ":" + std::to_string(line) + ": " + reason : file + ": " + reason;
}

}  // namespace

FileError::FileError(const std::string& file, int line, const std::string& reason)
    : std::runtime_error(sentence(file, line, reason)) {}

}  // namespace gearshift
