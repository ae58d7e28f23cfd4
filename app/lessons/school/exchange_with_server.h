// One exchange of a seat's history with the school's server. Every document is one transaction at the server, and is
// marked as sent only after that has committed. A document that arrives twice changes nothing.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/lessons/history/exchange.h"
#include "app/lessons/school/connection.h"

namespace gearshift::lessons {

struct Exchanged {
  std::size_t runs = 0;               // number of runs sent
  std::vector<std::string> messages;  // one sentence per learner who was erased on another seat
};

// Checks the server's version and that this history may send. Call once per connection. Throws ServerRefusal.
void greet(Connection& server, Exchange& history);

// Sends what the server does not have, then fetches what other seats did with the learners of this history. Erases
// learners who were erased elsewhere. Adds to `done` while it goes on. Throws ServerError and HistoryError.
void exchange(Connection& server, Exchange& history, Exchanged& done);

// For an instructor: fetches all learners into a history in memory.
void fetch_all(Connection& server, Exchange& history);

}  // namespace gearshift::lessons
