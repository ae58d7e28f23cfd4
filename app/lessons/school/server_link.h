// Keeps a seat's history and the school's server the same, in a thread of its own. Lessons never wait for it: they use
// the local history as if there were no server.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/lessons/history/exchange.h"
#include "app/lessons/school/connection.h"
#include "app/lessons/school/exchange_with_server.h"

namespace gearshift::lessons {

// Address of the server of this history: the first line of the file HISTORY-server beside it, for example
// history.db-server; empty if there is no such file. Throws HistoryError if the file cannot be read.
std::string server_of(const std::filesystem::path& history);

class ServerLink {
 public:
  ServerLink(const std::filesystem::path& history, const std::string& address);
  ~ServerLink();  // ends an exchange that is going on; what was not sent is sent by the next program
  ServerLink(const ServerLink&) = delete;
  ServerLink& operator=(const ServerLink&) = delete;

  // Next message for the user, as one sentence: an outage and its end are reported once each.
  std::optional<std::string> take_message();

  // Exchanges once more, for at most `limit`, and reports runs that are still unsent.
  void finish(std::chrono::seconds limit);

 private:
  using Duration = std::chrono::milliseconds;

  void run();
  void try_exchange();
  void report(const std::string& message);
  void report_outage(const std::string& reason, const std::string& message);

  const std::filesystem::path file_;
  const std::string address_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;  // guards the members up to messages_
  std::condition_variable changed_;
  bool is_asked_ = false;  // exchange now
  int rounds_ = 0;         // number of exchanges tried
  std::deque<std::string> messages_;

  // Used only by the thread.
  std::optional<Exchange> history_;
  std::optional<Connection> server_;
  bool is_refused_ = false;
  std::string outage_;  // reason of the outage that was reported; empty: none
  Duration wait_{};     // until the next exchange
  Duration retry_{};    // the same after the last failure
  std::thread thread_;
};

}  // namespace gearshift::lessons
