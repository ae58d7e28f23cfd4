#include "app/lab/reproduce/study_files.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/base/colours.h"
#include "haptics/files/atomic_file.h"

namespace gearshift::lab {

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
  haptics::write_text_file(file_, text_);
}

void draw(const Study& study, Figure figure) {
  figure.commands = fmt::format("set datafile separator comma\nset grid linetype 1 linewidth 0.6 linecolor \"{}\"\n",
                                base::kAisleShade) +
                    figure.commands;
  draw_figure(study.folder, figure, [&] { report_progress(study, "figures"); });
}

void report_progress(const Study& study, std::string_view what) {
  if (study.on_progress) study.on_progress(what);
}

std::string relative(double value, double paper) {
  const double percent = 100.0 * (value / paper - 1.0);
  const double size = std::abs(percent);
  if (size < 1e-9) return "0 %";
  return size < 1.0 ? fmt::format("{:+.1g} %", percent) : fmt::format("{:+.1f} %", percent);
}

}  // namespace gearshift::lab
