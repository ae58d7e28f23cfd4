// What a section leaves in the folder: its data with units in the header, and its figures.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "app/plot/gnuplot.h"
#include "app/reproduce/section.h"

namespace gearshift {

class CsvFile {
 public:
  // NAME.csv in the study's folder. header: "time_s,depth_mm".
  CsvFile(const Study& study, std::string_view name, std::string_view header);

  void row(std::initializer_list<double> cells);
  void line(std::string_view cells);  // as it is, for words; empty: gnuplot begins a new curve there
  void finish();                      // throws FileError where the disk did not take it

 private:
  std::filesystem::path file_;
  std::string text_;
};

// NAME.gp, NAME.svg and NAME.png, telling the study meanwhile. The commands follow a prelude that reads CSV files and
// draws a pale grid.
void draw(const Study& study, Figure figure);

void tell(const Study& study, std::string_view what);

// Ours against the paper's: "+1.3 %", "-0.02 %".
std::string relative(double ours, double paper);

}  // namespace gearshift
