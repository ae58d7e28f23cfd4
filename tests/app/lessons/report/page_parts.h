// Reads parts of a report page: table cells, and text without markup. Supports only the HTML that report pages contain.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gearshift::test {

inline std::string without_markup(std::string_view html) {
  std::string text;
  bool in_tag = false;
  for (const char c : html) {
    if (c == '<') {
      in_tag = true;
      text += ' ';
    } else if (c == '>') {
      in_tag = false;
    } else if (!in_tag) {
      text += c;
    }
  }
  const std::pair<const char*, char> entities[] = {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&amp;", '&'}};
  for (const auto& [entity, character] : entities) {
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at)
      text.replace(at, std::string_view(entity).size(), 1, character);
  }
  const std::size_t first = text.find_first_not_of(" \n"), last = text.find_last_not_of(" \n");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

// The text between the first `begin` at or after position `from` and the next `end`. Sets `from` to the position behind
// that `end`, or to npos if nothing was found.
inline std::string_view between(std::string_view page, std::string_view begin, std::string_view end,
                                std::size_t& from) {
  const std::size_t a = page.find(begin, from);
  if (a == std::string_view::npos) return from = std::string_view::npos, std::string_view();
  const std::size_t b = page.find(end, a + begin.size());
  from = b == std::string_view::npos ? b : b + end.size();
  return page.substr(a + begin.size(), b - a - begin.size());
}
inline std::string_view between(std::string_view page, std::string_view begin, std::string_view end) {
  std::size_t from = 0;
  return between(page, begin, end, from);
}

inline std::string_view section_of(std::string_view page, const std::string& id) {
  return between(page, "<section id=\"" + id + "\">", "</section>");
}

inline std::string text_of_id(std::string_view page, const std::string& id) {
  const std::string_view element = between(page, "id=\"" + id + "\"", "</");
  return without_markup(element.substr(element.find('>') + 1));
}

// The texts of the cells in each body row of the first table with the class `name`.
inline std::vector<std::vector<std::string>> table_of(std::string_view page, const std::string& name) {
  const std::string_view body =
      between(between(page, "<table class=\"" + name + "\">", "</table>"), "<tbody>", "</tbody>");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t at = 0;;) {
    const std::string_view row = between(body, "<tr", "</tr>", at);
    if (at == std::string_view::npos) return rows;
    rows.emplace_back();
    for (std::size_t cell = 0;;) {
      const std::string_view inner = between(row, "<td", "</td>", cell);
      if (cell == std::string_view::npos) break;
      rows.back().push_back(without_markup(inner.substr(inner.find('>') + 1)));
    }
  }
}

// The opening tags in order. They show the markup without the text.
inline std::vector<std::string> tags_of(std::string_view page) {
  std::vector<std::string> tags;
  for (std::size_t at = 0; (at = page.find('<', at)) != std::string_view::npos; ++at) {
    const std::size_t end = page.find_first_of(" >\n", at);
    tags.emplace_back(page.substr(at + 1, end - at - 1));
  }
  return tags;
}

}  // namespace gearshift::test
