// The XDG base directory specification, variable by variable.
#include "app/base/user_folders.h"

#include <string>

#include <doctest/doctest.h>

#include "tests/support/variable.h"

using namespace gearshift::base;
using namespace gearshift::test;

TEST_CASE("the variables name the base folders") {
  const Variable config("XDG_CONFIG_HOME", "/c"), data("XDG_DATA_HOME", "/d"), home("HOME", "/h");
  CHECK(user_config_folder() == "/c/gearshift");
  CHECK(user_data_folder() == "/d/gearshift");
  CHECK(user_presets_folder() == "/c/gearshift/presets");
}

TEST_CASE("without them, or if they are empty or relative, the defaults below the home folder") {
  for (const char* value : {static_cast<const char*>(nullptr), "", "relative/path"}) {
    const Variable config("XDG_CONFIG_HOME", value), data("XDG_DATA_HOME", value), home("HOME", "/h");
    CHECK(user_config_folder() == "/h/.config/gearshift");
    CHECK(user_data_folder() == "/h/.local/share/gearshift");
  }
}

TEST_CASE("without HOME the system's home folder of this user, or one sentence") {
  const Variable config("XDG_CONFIG_HOME", nullptr), home("HOME", nullptr);
  try {
    CHECK(user_config_folder().is_absolute());
  } catch (const std::runtime_error& error) {
    CHECK(std::string(error.what()).find("XDG_CONFIG_HOME nor HOME") != std::string::npos);
  }
}
