// Writes a section's files: data as CSV with units in the header, and figures.
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
  // NAME.csv in the study's folder. header: "time_s,depth_mm".
  CsvFile(const Study& study, std::string_view name, std::string_view header);

  void row(std::initializer_list<double> cells);
  void line(std::string_view cells);  // written verbatim, for text cells; an empty line makes gnuplot start a new curve
  void finish();                      // writes the file. Throws FileError

 private:
  std::filesystem::path file_;
  std::string text_;
};

// Writes NAME.gp, NAME.svg and NAME.png, and reports progress meanwhile. Before the figure's commands it writes a
// prelude that sets up CSV input and a pale grid.
void draw(const Study& study, Figure figure);

void report_progress(const Study& study, std::string_view what);

// Deviation of our value from the paper's: "+1.3 %", "-0.02 %".
std::string relative(double value, double paper);

}  // namespace gearshift::lab
