#include "haptics/files/printable.h"

namespace gearshift::haptics {
namespace {

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

// True if the text starts with a C1 control character (U+0080 to U+009F), which UTF-8 encodes as C2 80 to C2 9F. On a
// terminal, U+009B starts an escape sequence.
bool starts_c1(std::string_view text) {
  if (text.size() < 2 || text[0] != '\xc2') return false;
  const auto second = static_cast<unsigned char>(text[1]);
  return second >= 0x80 && second <= 0x9f;
}

bool is_space(char c) {
  return c >= '\t' && c <= '\r';
}

}  // namespace

std::string printable(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const bool c1 = starts_c1(text);
    if (c1 || is_control(text[0])) {
      safe += is_space(text[0]) ? ' ' : '?';
    } else {
      safe += text[0];
    }
    text.remove_prefix(c1 ? 2 : 1);
  }
  return safe;
}

bool is_printable(std::string_view text) {
  return printable(text) == text;
}

}  // namespace gearshift::haptics
