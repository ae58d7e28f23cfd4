// Many pictures on one.
#pragma once

#include <span>

#include "engine/image/image.h"

namespace gearshift {

// Same-sized pictures in rows of `columns`, each shrunk by a whole factor (the mean of its pixels), with a margin [px].
// Throws std::invalid_argument where they differ in size or there is none.
Image contact_sheet(std::span<const Image> pictures, int columns, int shrink, int margin = 8);

}  // namespace gearshift
