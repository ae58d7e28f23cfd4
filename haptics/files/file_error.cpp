#include "haptics/files/file_error.h"

#include "haptics/files/printable.h"

namespace gearshift {
namespace {

// Both come from outside: file names from the command line or a trace, reasons with values out of the file.
std::string sentence(const std::string& file, int line, const std::string& reason) {
  return printable(line > 0 ? file + ":" + std::to_string(line) + ": " + reason : file + ": " + reason);
}

}  // namespace

FileError::FileError(const std::string& file, int line, const std::string& reason)
    : std::runtime_error(sentence(file, line, reason)) {}

}  // namespace gearshift
