#include "haptics/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/files/text_file.h"
#include "tests/support/small_files.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
namespace fs = std::filesystem;

namespace {

std::ptrdiff_t files_in(const TempFolder& folder) {
  return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
}

}  // namespace

TEST_CASE("a text replaces the previous content, and no other file remains in the folder") {
  const TempFolder folder;
  write_text_file(folder / "page.html", "a long first text");
  write_text_file(folder / "page.html", "second\n");
  CHECK(read_text_file(folder / "page.html") == "second\n");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("if the disk is full, the previous content is unchanged and the partial file is removed") {
  const TempFolder folder;
  write_text_file(folder / "page.html", "first");
  bool refused = false;
  try {
    const SmallFiles small(1000);  // [bytes]
    write_text_file(folder / "page.html", std::string(100'000, 'x'));
  } catch (const FileError& error) {
    refused = std::string(error.what()).find("page.html") != std::string::npos;
  }
  CHECK(refused);
  CHECK(read_text_file(folder / "page.html") == "first");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a missing folder and the name of a folder are rejected") {
  const TempFolder folder;
  CHECK_THROWS_AS(write_text_file(folder / "none" / "page.html", "x"), FileError);
  fs::create_directory(folder / "page.html");
  CHECK_THROWS_AS(write_text_file(folder / "page.html", "x"), FileError);
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a symbolic link is preserved, whether or not its target exists") {
  const TempFolder folder;
  fs::create_directory(folder / "elsewhere");
  fs::create_symlink("elsewhere/page.html", folder / "link.html");
  for (const std::string text : {"first", "second"}) {
    write_text_file(folder / "link.html", text);
    CHECK(fs::is_symlink(folder / "link.html"));
    CHECK(read_text_file(folder / "elsewhere" / "page.html") == text);
  }
  CHECK(files_in(folder) == 2);
}

TEST_CASE("a pipe is written to once and stays a pipe") {
  const TempFolder folder;
  const fs::path pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  {
    AtomicFile part(pipe);
    part.prepare();
    part.write("whole");
    part.commit();
  }
  char buffer[16];
  CHECK(std::string(buffer, static_cast<std::size_t>(std::max<ssize_t>(0, read(reader, buffer, sizeof buffer)))) ==
        "whole");
  CHECK(fs::is_fifo(pipe));
  CHECK(files_in(folder) == 1);
  close(reader);
}

TEST_CASE("prepare() rejects a file that cannot be written, with the reason, and leaves nothing behind") {
  const TempFolder folder;
  CHECK_THROWS_WITH_AS(AtomicFile(folder / "none" / "page.html").prepare(), doctest::Contains("No such file"),
                       FileError);
  write_text_file(folder / "page.html", "first");
  AtomicFile(folder / "page.html").prepare();
  CHECK(read_text_file(folder / "page.html") == "first");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a write-protected file is rejected by prepare(), and by commit() if it became so meanwhile") {
  if (geteuid() == 0) return;  // root can write any file
  const TempFolder folder;
  write_text_file(folder / "page.html", "first");
  AtomicFile part(folder / "page.html");
  part.write("second");
  fs::permissions(folder / "page.html", fs::perms::owner_read);
  const auto refusal = doctest::Contains("page.html: cannot be written (Permission denied)");
  CHECK_THROWS_WITH_AS(part.commit(), refusal, FileError);
  CHECK_THROWS_WITH_AS(AtomicFile(folder / "page.html").prepare(), refusal, FileError);
  CHECK_THROWS_WITH_AS(write_text_file(folder / "page.html", "third"), refusal, FileError);
  CHECK(read_text_file(folder / "page.html") == "first");
}

TEST_CASE("a file that is not committed is removed") {
  const TempFolder folder;
  {
    AtomicFile part(folder / "page.html");
    part.write("x");
    CHECK(files_in(folder) == 1);
  }
  CHECK(files_in(folder) == 0);
}
