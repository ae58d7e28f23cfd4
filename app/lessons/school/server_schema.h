// The school's tables and functions on a PostgreSQL server.
//
// Seats and instructors call functions that run with the owner's rights (SECURITY DEFINER); seats have no rights on the
// tables. A login is a member of the role gearshift_seat or gearshift_instructor:
//   seat          sends runs and comments of its own learners, and reads their rows, also those of other seats
//   instructor    reads, comments on and erases all learners
#pragma once

#include <string>

namespace gearshift::lessons {

inline constexpr int kServerVersion = 2;  // of tables and functions

// Creates what is missing: schema, roles, tables, functions and grants. One transaction. Must run as the future owner, who
// may create roles.
std::string server_script();

}  // namespace gearshift::lessons
