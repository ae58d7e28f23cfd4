// Writes a section's files: figures, and data as CSV with units in the header.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "app/lab/plot/gnuplot.h"
#include "app/lab/reproduce/section.h"

namespace gearshift::lab {

class CsvFile {
 public:
  // NAME.csv in the study's folder. `header`: column names with units, such as "time_s,depth_mm".
  CsvFile(const Study& study, std::string_view name, std::string_view header);

  void row(std::initializer_list<double> cells);
  void line(std::string_view cells);  // written unchanged, for text cells; an empty line interrupts gnuplot's curve
  void finish();                      // writes the file to disk. Throws FileError

 private:
  std::filesystem::path file_;
  std::string text_;
};

// Writes NAME.gp, NAME.svg and NAME.png, and reports progress. Adds gnuplot commands for CSV input and a pale grid
// before the figure's own commands.
void draw(const Study& study, Figure figure);

void report_progress(const Study& study, std::string_view what);

// Formats the relative difference of `value` from the paper's value: "+1.3 %", "-0.02 %".
std::string relative(double value, double paper);

}  // namespace gearshift::lab
