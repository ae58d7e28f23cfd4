#include "haptics/files/text_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"

using namespace gearshift;
namespace fs = std::filesystem;

namespace {

// A folder of its own, gone with the test.
class Scratch {
 public:
  Scratch() : folder_(fs::temp_directory_path() / ("gearshift_text_file_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Scratch() { fs::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

std::string refusal(const fs::path& file) {
  try {
    read_text_file(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace

TEST_CASE("a file is read whole, byte for byte") {
  const Scratch scratch;
  const std::string text("one\r\ntwo\0three", 14);
  CHECK(read_text_file(scratch.write("bytes", text)) == text);
  CHECK(read_text_file(scratch.write("empty", "")).empty());
}

TEST_CASE("the largest file is 1 MiB, not a byte more") {
  const Scratch scratch;
  CHECK(read_text_file(scratch.write("most", std::string(1048576, 'x'))).size() == 1048576);
  const fs::path larger = scratch.write("more", std::string(1048577, 'x'));
  CHECK(refusal(larger) == larger.string() + ": is larger than 1 MiB");
}

TEST_CASE("what is not a readable file is refused in one sentence") {
  const Scratch scratch;
  const fs::path missing = scratch.folder() / "missing.toml";
  CHECK(refusal(missing) == missing.string() + ": there is no such file");
  CHECK(refusal(scratch.folder()) == scratch.folder().string() + ": is a folder, not a file");
  CHECK(refusal("/dev/zero") == "/dev/zero: is not a plain file");

  const fs::path secret = scratch.write("secret", "x");
  fs::permissions(secret, fs::perms::none);
  if (geteuid() != 0)
    CHECK(refusal(secret) == secret.string() + ": cannot be read");  // root reads everything
}
