#include "app/demo/contact_sheet.h"

#include <cstddef>
#include <stdexcept>

namespace gearshift::demo {
namespace {

void paste_shrunk(engine::Image& sheet, const engine::Image& picture, int left, int top, int shrink) {
  const int width = picture.width / shrink, height = picture.height / shrink;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int channel = 0; channel < 4; ++channel) {
        int sum = 0;
        for (int dy = 0; dy < shrink; ++dy) {
          for (int dx = 0; dx < shrink; ++dx) sum += picture.pixel(x * shrink + dx, y * shrink + dy)[channel];
        }
        const int count = shrink * shrink;
        sheet.pixel(left + x, top + y)[channel] = static_cast<std::uint8_t>((sum + count / 2) / count);
      }
    }
  }
}

}  // namespace

engine::Image contact_sheet(std::span<const engine::Image> pictures, int columns, int shrink, int margin) {
  if (pictures.empty() || columns < 1 || shrink < 1)
    throw std::invalid_argument("a contact sheet needs at least one picture");
  const int width = pictures[0].width / shrink, height = pictures[0].height / shrink;
  const int count = static_cast<int>(pictures.size());
  const int rows = (count + columns - 1) / columns;
  engine::Image sheet;
  sheet.width = margin + columns * (width + margin);
  sheet.height = margin + rows * (height + margin);
  sheet.rgba.assign(4 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), 255);
  for (int i = 0; i < count; ++i) {
    const engine::Image& picture = pictures[static_cast<std::size_t>(i)];
    if (picture.width != pictures[0].width || picture.height != pictures[0].height)
      throw std::invalid_argument("all pictures on a contact sheet must have the same size");
    paste_shrunk(sheet, picture, margin + (i % columns) * (width + margin), margin + (i / columns) * (height + margin),
                 shrink);
  }
  return sheet;
}

}  // namespace gearshift::demo
