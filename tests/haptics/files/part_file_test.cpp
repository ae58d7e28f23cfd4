#include "haptics/files/part_file.h"

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

using namespace gearshift;
namespace fs = std::filesystem;

namespace {

std::ptrdiff_t files_in(const TempFolder& folder) {
  return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
}

}  // namespace

TEST_CASE("a text is written whole, over what was there, and nothing else stays in the folder") {
  const TempFolder folder;
  write_text_file(folder / "page.html", "a long first text");
  write_text_file(folder / "page.html", "second\n");
  CHECK(read_text_file(folder / "page.html") == "second\n");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("where the disk fills up, what was there before is still there, and the half is gone") {
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

TEST_CASE("a folder that is not there, and a name that is a folder, are refused") {
  const TempFolder folder;
  CHECK_THROWS_AS(write_text_file(folder / "none" / "page.html", "x"), FileError);
  fs::create_directory(folder / "page.html");
  CHECK_THROWS_AS(write_text_file(folder / "page.html", "x"), FileError);
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a link stays one, whether what it leads to is there or not") {
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

TEST_CASE("a pipe is written to, once, and stays one") {
  const TempFolder folder;
  const fs::path pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  {
    PartFile part(pipe);
    part.prepare();
    part.write("whole");
    part.keep();
  }
  char got[16];
  CHECK(std::string(got, static_cast<std::size_t>(std::max<ssize_t>(0, read(reader, got, sizeof got)))) == "whole");
  CHECK(fs::is_fifo(pipe));
  CHECK(files_in(folder) == 1);
  close(reader);
}

TEST_CASE("what cannot be written is refused before the work, with the reason, and costs nothing") {
  const TempFolder folder;
  CHECK_THROWS_WITH_AS(PartFile(folder / "none" / "page.html").prepare(), doctest::Contains("No such file"), FileError);
  write_text_file(folder / "page.html", "first");
  PartFile(folder / "page.html").prepare();
  CHECK(read_text_file(folder / "page.html") == "first");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a file that may not be written is refused before the work, and when it is locked meanwhile") {
  if (geteuid() == 0) return;  // root may write everything
  const TempFolder folder;
  write_text_file(folder / "page.html", "first");
  PartFile begun(folder / "page.html");
  begun.write("second");
  fs::permissions(folder / "page.html", fs::perms::owner_read);
  const auto refusal = doctest::Contains("page.html: cannot be written: Permission denied");
  CHECK_THROWS_WITH_AS(begun.keep(), refusal, FileError);
  CHECK_THROWS_WITH_AS(PartFile(folder / "page.html").prepare(), refusal, FileError);
  CHECK_THROWS_WITH_AS(write_text_file(folder / "page.html", "third"), refusal, FileError);
  CHECK(read_text_file(folder / "page.html") == "first");
}

TEST_CASE("what is not kept is gone") {
  const TempFolder folder;
  {
    PartFile part(folder / "page.html");
    part.write("x");
    CHECK(files_in(folder) == 1);
  }
  CHECK(files_in(folder) == 0);
}
