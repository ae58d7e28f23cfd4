#include "haptics/files/part_file.h"

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

TEST_CASE("what is not kept is gone") {
  const TempFolder folder;
  {
    PartFile part(folder / "page.html");
    part.write("x");
    CHECK(files_in(folder) == 1);
  }
  CHECK(files_in(folder) == 0);
}
