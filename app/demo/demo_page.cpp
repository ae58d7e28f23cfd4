#include "app/demo/demo_page.h"

#include <sstream>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/base/program_name.h"
#include "haptics/files/atomic_file.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::demo {
namespace {

// Additions to the common page style: a grid with as many pictures per row as fit on the screen, or two per row on
// paper.
constexpr const char* kStyle = R"css(
.sentences { margin: 0 0 1rem; padding: 0; list-style: none; max-width: 52rem; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(18rem, 1fr)); gap: 1.4rem 1.2rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(26rem, 1fr)); gap: 1.2rem 2rem;
         align-items: start; }
.pictures figure, .plots figure { margin: 0; }
.pictures img, .plots img { display: block; width: 100%; border-radius: 4px; }
.pictures figcaption, .plots figcaption { margin-top: 0.4rem; line-height: 1.35; }
audio { width: 100%; max-width: 32rem; vertical-align: middle; }
@media print {
  .pictures, .plots { grid-template-columns: 1fr 1fr; gap: 5mm; }
  .sound { display: none; }
  .sentences { max-width: none; break-after: avoid; }
}
)css";

std::string figure(const std::string& file, const std::string& caption) {
  return fmt::format(
      "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>\n<figcaption>{1}</figcaption></figure>\n",
      base::html_text(file), base::html_text(caption));
}

std::string facts(const DemoSetup& setup, const DemoResult& result) {
  const auto row = [](std::string_view label, const std::string& value) {
    return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", label, base::html_text(value));
  };
  const lab::TourResult& tour = result.tour;
  std::string table = "<table class=\"facts\">\n";
  table += row("Gate", setup.tour.layout.name);
  table += row("Drive", fmt::format("{:.2f} s at {:g} Hz, {} cycles, hash {:016x}", tour.duration,
                                    setup.tour.haptics.rate, tour.cycles, tour.hash));
  table += row("In contact", fmt::format("{:.0f} % of the cycles", 100.0 * tour.contact_fraction()));
  table += row("Deepest wall penetration", fmt::format("{:.2f} mm", 1e3 * tour.deepest));
  table += row("Strongest push", fmt::format("{:.1f} N", tour.strongest));
  for (const haptics::TuningLimit& limit : tour.limits) table += row("Limited", haptics::describe(limit));
  table += row("Rendered by", result.device);
  return table + "</table>\n";
}

std::string gear_table(const lab::TourResult& tour, const haptics::Gate& gate) {
  std::string table = "<table>\n<tr><th>Gear</th><th>Engaged at</th></tr>\n";
  for (const lab::GearTime& gear : tour.engaged)
    table += fmt::format("<tr><td>{}</td><td>{:.3f} s</td></tr>\n",
                         base::html_text(haptics::gear_label(gate, gear.gear)), gear.time);
  return table + "</table>\n";
}

std::string chapter_html(const DemoChapter& chapter) {
  std::string html = fmt::format("<section>\n<h2>{}</h2>\n<ul class=\"sentences\">\n", base::html_text(chapter.title));
  for (const std::string& sentence : chapter.text) html += fmt::format("<li>{}</li>\n", base::html_text(sentence));
  if (!chapter.trace.empty())
    html += fmt::format("<li><a href=\"{}\">Trace</a></li>\n", base::html_text(chapter.trace));
  html += "</ul>\n<div class=\"pictures\">\n";
  for (const DemoPicture& picture : chapter.pictures) html += figure(picture.file, picture.caption);
  return html + "</div>\n</section>\n";
}

constexpr const char* kDriven =
    "A simulated driver shifts through every gear of the gate and then drives two lessons in a car with a full "
    "driveline. ";
constexpr const char* kIntroduction =
    "The drawn lever always stays inside the gate. At the end, a scripted hand shifts through the same gate without a "
    "car and pushes against the walls; the plots show the force that pushes it back. Everything on this page is "
    "deterministic: the traces replay bit for bit.";

}  // namespace

void write_demo_page(const DemoSetup& setup, const DemoResult& result) {
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>gearshift demo</title>\n"
         "<style>"
      << base::html_style() << kStyle
      << "</style>\n</head>\n<body>\n<h1>Demo: " << base::html_text(setup.tour.layout.name) << "</h1>\n<p>"
      << (result.has_report ? kDriven : "") << kIntroduction
      << "</p>\n<p class=\"sound\">Sound of the drive through every gear:<br><audio controls "
         "src=\"demo.wav\"></audio></p>\n";
  if (result.has_report) {
    out << "<p>The simulated driver took each lesson several times with increasing skill, although the grade may not "
           "rise every time. The last attempt is shown here; all attempts are in <a href=\"report.html\">the "
           "report</a>.</p>\n";
  }
  for (const DemoChapter& chapter : result.chapters) out << chapter_html(chapter);
  out << "<section>\n<h2>Lever and force, by a scripted hand</h2>\n<div class=\"plots\">\n"
      << facts(setup, result) << gear_table(result.tour, setup.tour.gate) << "</div>\n<div class=\"plots\">\n"
      << figure("trajectory.svg", "Paths of the real lever and the drawn lever in the gate (Fig. 9 a of the paper)")
      << figure("force.svg", "Position and force against time (Fig. 9 b of the paper)")
      << "</div>\n<p><a href=\"tour.csv\">Table</a>, <a href=\"tour.trace\">trace</a>, "
         "<a href=\"contact_sheet.png\">contact sheet</a></p>\n</section>\n<p>"
      << base::program_name() << "</p>\n</body>\n</html>\n";
  haptics::write_text_file(setup.tour.folder / "index.html", out.str());
}

}  // namespace gearshift::demo
