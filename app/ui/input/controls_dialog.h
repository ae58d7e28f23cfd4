// Sets up the controls of controllers without force feedback in the terminal.
#pragma once

#include <filesystem>

#include "app/ui/input/bindings.h"

namespace gearshift::ui {

// Returns the bindings to start from: those in `file`, or those in `defaults` if `file` does not exist or `again` is
// true. Throws FileError.
Bindings starting_bindings(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again);

// Writes the bindings and creates their folder. Throws FileError.
void save_bindings(const Bindings& bindings, const std::filesystem::path& file);

// Implements `devices --controls`. `file` is replaced only at the end.
// `answers`: the file descriptor from which the user's answers are read. Returns the exit code. Throws FileError.
int calibrate_controllers(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again,
                          int answers);

}  // namespace gearshift::ui
