#include "app/base/html.h"

#include "haptics/files/printable.h"

namespace gearshift::base {
namespace {

constexpr const char* kStyle = R"css(
body { font: 16px/1.5 "DejaVu Sans", "Segoe UI", sans-serif; color: #1f2933; background: #fff; max-width: 72rem;
       margin: 2rem auto; padding: 0 1.5rem; }
h1 { font-size: 1.7rem; line-height: 1.25; }
h2 { font-size: 1.3rem; margin-top: 3rem; border-top: 1px solid #d5dbe1; padding-top: 1.2rem; }
a { color: #1f5fa8; }
nav ol { columns: 2; }
table { border-collapse: collapse; width: 100%; margin: 1rem 0; font-size: 0.92rem; }
caption { text-align: left; color: #6b7785; padding-bottom: 0.4rem; }
th, td { text-align: left; vertical-align: top; padding: 0.45rem 0.8rem 0.45rem 0; border-bottom: 1px solid #d5dbe1; }
table.findings th, table.findings td { width: 33%; }
table.facts { width: auto; }
figure { margin: 1.6rem 0; }
img { max-width: 100%; height: auto; }
figcaption { color: #6b7785; font-size: 0.92rem; }
@media print {
  body { font-size: 10pt; max-width: none; margin: 0; }
  h2, figure, tr { break-inside: avoid; }
  h2 { break-after: avoid; }
}
)css";

}  // namespace

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : haptics::printable_lines(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string_view html_style() {
  return kStyle;
}

}  // namespace gearshift::base
