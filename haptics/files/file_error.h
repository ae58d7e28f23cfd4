// One clear sentence about a bad file.
#pragma once

#include <stdexcept>
#include <string>

namespace gearshift {

// what() is one printable line: "FILE:LINE: ...". line 0 = the whole file.
class FileError : public std::runtime_error {
 public:
  FileError(const std::string& file, int line, const std::string& reason);
};

}  // namespace gearshift
