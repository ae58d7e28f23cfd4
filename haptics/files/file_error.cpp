#include "haptics/files/file_error.h"

#include "haptics/files/printable.h"

namespace gearshift::haptics {
namespace {

// File name and reason are untrusted text: file names come from the command line or a trace, and reasons quote values
// from the file.
std::string sentence(const std::string& file, int line, const std::string& reason) {
  return printable(line > 0 ? file + ":" + std::to_string(line) + ": " + reason : file + ": " + reason);
}

}  // namespace

FileError::FileError(const std::string& file, int line, const std::string& reason)
    : std::runtime_error(sentence(file, line, reason)) {}

}  // namespace gearshift::haptics
