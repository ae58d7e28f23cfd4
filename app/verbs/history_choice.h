// The history that --database means: a file, or the user's own history together with a school's server.
#pragma once

#include <string>

#include "app/base/user_folders.h"
#include "app/lessons/school/server_link.h"

namespace gearshift::verbs {

struct HistoryChoice {
  base::HistoryLocation place;
  std::string server;  // address; empty: none
};

// `database`: file, address of a server, or empty. A history has a server if it is given, or by lessons::server_of().
HistoryChoice choose_history(const std::string& database);

// Waits a few seconds until the server has everything, and prints the link's messages to stderr.
void finish_exchange(lessons::ServerLink& server);

}  // namespace gearshift::verbs
