// Tests of the check that a table of parameters has every member of its struct exactly once.
#include "haptics/files/parameter.h"

#include <string>

#include <doctest/doctest.h>

namespace gearshift::test {

template <int>
struct Spring {
  double stiffness = 0.0;
  double damping = 0.0;
  std::string text;
};
using Complete = Spring<0>;
using MemberTwice = Spring<1>;
using KeyTwice = Spring<2>;
using NameTwice = Spring<3>;

}  // namespace gearshift::test

namespace gearshift::haptics {

using test::Complete, test::MemberTwice, test::KeyTwice, test::NameTwice;

template <>
inline constexpr Parameter<Complete> kParameters<Complete>[] = {
    {&Complete::stiffness, "stiffness", "stiffness_n_per_m", FileRange{0.0, 1.0}, ""},
    {&Complete::damping, "damping", "damping_n_s_per_m", FileRange{0.0, 1.0}, ""}};
template <>
inline constexpr Parameter<MemberTwice> kParameters<MemberTwice>[] = {
    {&MemberTwice::stiffness, "stiffness", "stiffness_n_per_m", FileRange{0.0, 1.0}, ""},
    {&MemberTwice::stiffness, "damping", "damping_n_s_per_m", FileRange{0.0, 1.0}, ""}};
template <>
inline constexpr Parameter<KeyTwice> kParameters<KeyTwice>[] = {
    {&KeyTwice::stiffness, "stiffness", "stiffness_n_per_m", FileRange{0.0, 1.0}, ""},
    {&KeyTwice::damping, "damping", "stiffness_n_per_m", FileRange{0.0, 1.0}, ""}};
template <>
inline constexpr Parameter<NameTwice> kParameters<NameTwice>[] = {
    {&NameTwice::stiffness, "stiffness", "stiffness_n_per_m", FileRange{0.0, 1.0}, ""},
    {&NameTwice::damping, "stiffness", "damping_n_s_per_m", FileRange{0.0, 1.0}, ""}};

TEST_CASE("a table of parameters is complete only if it has each member, key and name once") {
  CHECK(describes_all(&Complete::text));
  CHECK_FALSE(describes_all(&MemberTwice::text));
  CHECK_FALSE(describes_all(&KeyTwice::text));
  CHECK_FALSE(describes_all(&NameTwice::text));
}

TEST_CASE("members that are no parameters must be listed, each once, and not be in the table") {
  CHECK_FALSE(DescribesAll<Complete>);
  CHECK_FALSE(describes_all(&Complete::text, &Complete::text));
  CHECK_FALSE(describes_all(&Complete::damping));
}

}  // namespace gearshift::haptics
