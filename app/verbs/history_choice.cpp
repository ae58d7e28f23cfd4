#include "app/verbs/history_choice.h"

#include <chrono>
#include <optional>

#include "app/base/console.h"

namespace gearshift::verbs {
namespace {

constexpr std::chrono::seconds kServerLimit{5};

}  // namespace

HistoryChoice choose_history(const std::string& database) {
  if (lessons::is_server_address(database)) return {base::history_location(""), database};
  HistoryChoice choice{base::history_location(database), ""};
  choice.server = lessons::server_of(choice.place.file);
  return choice;
}

void finish_exchange(lessons::ServerLink& server) {
  server.finish(kServerLimit);
  while (const std::optional<std::string> message = server.take_message()) base::print_message("{}", *message);
}

}  // namespace gearshift::verbs
