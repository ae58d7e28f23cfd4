// The variables of the XDG base directory specification and their defaults.
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

TEST_CASE("variables that are missing, empty or relative: the default folders below the home folder are used") {
  for (const char* value : {static_cast<const char*>(nullptr), "", "relative/path"}) {
    const Variable config("XDG_CONFIG_HOME", value), data("XDG_DATA_HOME", value), home("HOME", "/h");
    CHECK(user_config_folder() == "/h/.config/gearshift");
    CHECK(user_data_folder() == "/h/.local/share/gearshift");
  }
}

TEST_CASE("without HOME, the user's home folder comes from the system's user database, or the error is one sentence") {
  const Variable config("XDG_CONFIG_HOME", nullptr), home("HOME", nullptr);
  try {
    CHECK(user_config_folder().is_absolute());
  } catch (const std::runtime_error& error) {
    CHECK(std::string(error.what()).find("XDG_CONFIG_HOME nor HOME") != std::string::npos);
  }
}
