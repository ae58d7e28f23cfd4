// Figures by gnuplot: one script, written beside its data, makes the SVG and the PNG.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gearshift {

struct Figure {
  std::string name;      // file name without extension
  int width = 900;       // [px]
  int height = 600;      // [px]
  std::string commands;  // everything but terminal and output; paths relative to the folder
};

// Writes NAME.gp, NAME.svg and NAME.png into the folder. Calls `waiting` now and then while gnuplot works.
// Throws std::runtime_error with one sentence when gnuplot is missing or refuses the script.
void draw_figure(const std::filesystem::path& folder, const Figure& figure, const std::function<void()>& waiting);

}  // namespace gearshift
