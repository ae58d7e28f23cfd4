// Draws figures with gnuplot. One script, saved next to the data, produces both SVG and PNG.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gearshift::lab {

struct Figure {
  std::string name;      // file name without extension
  int width = 900;       // [px]
  int height = 600;      // [px]
  std::string commands;  // all commands except terminal and output; paths are relative to the folder
};

// Writes NAME.gp, NAME.svg and NAME.png to the folder. Calls `waiting` every few milliseconds while gnuplot works.
// Throws std::runtime_error with one sentence if gnuplot is missing or fails.
void draw_figure(const std::filesystem::path& folder, const Figure& figure, const std::function<void()>& waiting);

}  // namespace gearshift::lab
