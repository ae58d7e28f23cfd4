// An error in a file, described in one sentence.
#pragma once

#include <stdexcept>
#include <string>

namespace gearshift::haptics {

// The text of what() is one printable line: "FILE:LINE: reason", or "FILE: reason" if line is 0.
class FileError : public std::runtime_error {
 public:
  FileError(const std::string& file, int line, const std::string& reason);
};

}  // namespace gearshift::haptics
