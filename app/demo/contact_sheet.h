// Combines several pictures into one.
#pragma once

#include <span>

#include "engine/image/image.h"

namespace gearshift::demo {

// Arranges pictures of equal size in rows with `columns` pictures each. `shrink`: integer factor by which each picture
// is reduced, by averaging pixels. `margin` [px]: gap around each picture. Throws std::invalid_argument if the sizes
// differ or there are no pictures.
engine::Image contact_sheet(std::span<const engine::Image> pictures, int columns, int shrink, int margin = 8);

}  // namespace gearshift::demo
