#include "haptics/files/text_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
namespace fs = std::filesystem;

namespace {

fs::path write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

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
  const TempFolder scratch;
  const std::string text("one\r\ntwo\0three", 14);
  CHECK(read_text_file(write(scratch / "bytes", text)) == text);
  CHECK(read_text_file(write(scratch / "empty", "")).empty());
}

TEST_CASE("the largest file is 1 MiB, not a byte more") {
  const TempFolder scratch;
  CHECK(read_text_file(write(scratch / "most", std::string(1048576, 'x'))).size() == 1048576);
  const fs::path larger = write(scratch / "more", std::string(1048577, 'x'));
  CHECK(refusal(larger) == larger.string() + ": the file is larger than 1 MiB");
}

TEST_CASE("anything that is not a readable file is rejected in one sentence") {
  const TempFolder scratch;
  const fs::path missing = scratch / "missing.toml";
  CHECK(refusal(missing) == missing.string() + ": there is no such file");
  CHECK(refusal(scratch.path()) == scratch.path().string() + ": this is a folder, not a file");
  CHECK(refusal("/dev/zero") == "/dev/zero: this is not a regular file");

  const fs::path loop = scratch / "loop";  // a symbolic link to itself; not even root can open it
  fs::create_symlink(loop, loop);
  CHECK(refusal(loop) == loop.string() + ": cannot be read (Too many levels of symbolic links)");

  const fs::path secret = write(scratch / "secret", "x");
  fs::permissions(secret, fs::perms::none);
  if (geteuid() != 0) CHECK(refusal(secret) == secret.string() + ": cannot be read");  // root can read any file
}
