#include "haptics/files/number_text.h"

#include <limits>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

TEST_CASE("numbers are formatted as a person would write them") {
  CHECK(number_text(6.0) == "6");
  CHECK(number_text(0.0) == "0");
  CHECK(number_text(-0.0) == "0");
  CHECK(number_text(-30.5) == "-30.5");
  CHECK(number_text(0.012) == "0.012");
  CHECK(number_text(100.0) == "100");
  CHECK(number_text(1.23456789, 3) == "1.235");
  CHECK(number_text(1e300) == "1e+300");
  CHECK(number_text(1e-9) == "1e-09");
  CHECK(number_text(-1e-9) == "-1e-09");  // not "0": an error would read "= 0: must be between 0 and ..."
  CHECK(number_text(-4e-7) == "-4e-07");
  CHECK(number_text(std::numeric_limits<double>::quiet_NaN()) == "nan");
  CHECK(number_text(-std::numeric_limits<double>::infinity()) == "-inf");
}

TEST_CASE("lengths are formatted in tenths of a millimetre") {
  CHECK(millimetres_text(0.0199) == "19.9 mm");
  CHECK(millimetres_text(0.040) == "40 mm");
  CHECK(millimetres_text(-0.00004) == "0 mm");
}
