#include "haptics/files/printable.h"

#include <algorithm>
#include <cstddef>

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

// True if the text starts with U+2028 to U+202E (separators, embeddings and overrides) or U+2066 to U+2069 (isolates).
bool starts_layout(std::string_view text) {
  if (text.size() < 3 || text[0] != '\xe2') return false;
  const auto second = static_cast<unsigned char>(text[1]), third = static_cast<unsigned char>(text[2]);
  return (second == 0x80 && third >= 0xa8 && third <= 0xae) || (second == 0x81 && third >= 0xa6 && third <= 0xa9);
}

bool is_separator(std::string_view character) {
  return character.size() == 1 ? character[0] >= '\t' && character[0] <= '\r'
                               : character == "\u2028" || character == "\u2029";
}

// Bytes of the control character that the text starts with; 0 if it starts with another character.
std::size_t control_size(std::string_view text) {
  return is_control(text[0]) ? 1 : starts_c1(text) ? 2 : starts_layout(text) ? 3 : 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const std::size_t size = control_size(text);
    safe += size == 0 ? text[0] : is_separator(text.substr(0, size)) ? ' ' : '?';
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return safe;
}

std::string printable_lines(std::string_view text) {
  std::string safe;
  for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
    safe += printable(text.substr(0, end)) + '\n';
  return safe + printable(text);
}

bool is_printable(std::string_view text) {
  return printable(text) == text;
}

}  // namespace gearshift::haptics
