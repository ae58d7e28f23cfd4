// An error in a file, described in one sentence.
#pragma once

#include <stdexcept>
#include <string>

namespace gearshift::haptics {

// what() is one printable line: "FILE:LINE: ...", or "FILE: ..." if line is 0.
class FileError : public std::runtime_error {
 public:
  FileError(const std::string& file, int line, const std::string& reason);
};

}  // namespace gearshift::haptics
