#include "app/reproduce/study_files.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/draw/gate_colours.h"
#include "haptics/files/part_file.h"

namespace gearshift {

CsvFile::CsvFile(const Study& study, std::string_view name, std::string_view header)
    : file_(study.folder / fmt::format("{}.csv", name)) {
  line(header);
}

void CsvFile::row(std::initializer_list<double> cells) {
  line(fmt::format("{:.9g}", fmt::join(cells, ",")));
}

void CsvFile::line(std::string_view cells) {
  text_ += cells;
  text_ += '\n';
}

void CsvFile::finish() {
  write_text_file(file_, text_);
}

void draw(const Study& study, Figure figure) {
  figure.commands =
      fmt::format("set datafile separator comma\nset grid linetype 1 linewidth 0.6 linecolor \"{}\"\n", kAisleShade) +
      figure.commands;
  draw_figure(study.folder, figure, [&] { tell(study, "figures"); });
}

void tell(const Study& study, std::string_view what) {
  if (study.doing) study.doing(what);
}

std::string relative(double ours, double paper) {
  const double percent = 100.0 * (ours / paper - 1.0);
  const double size = std::abs(percent);
  if (size < 1e-9) return "0 %";
  return size < 1.0 ? fmt::format("{:+.1g} %", percent) : fmt::format("{:+.1f} %", percent);
}

}  // namespace gearshift
