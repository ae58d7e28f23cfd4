// The lines of Table 2 in Lin and Young's paper that can be measured on our levers, with the printed values.
#pragma once

namespace gearshift::lab {

struct PrintedLine {
  const char *developed, *sidewinder, *immersion;
};
inline constexpr PrintedLine kPrintedRangeX{"70 ~ 80 deg", "45 ~ 55 deg", "65 deg"};
inline constexpr PrintedLine kPrintedRangeY{"80 ~ 90 deg", "35 ~ 50 deg", "65 deg"};
inline constexpr PrintedLine kPrintedTorque{"10.83 Nm", "small", "8.9 Nm"};
inline constexpr PrintedLine kPrintedPrecision{"2250/80", "low", "1100/65"};  // counts/deg
inline constexpr PrintedLine kPrintedBandwidth{"100 Hz", "low", "120 Hz"};

}  // namespace gearshift::lab
