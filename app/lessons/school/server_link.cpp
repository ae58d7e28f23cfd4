#include "app/lessons/school/server_link.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kInterval{5'000};  // between exchanges, for what other seats did
constexpr milliseconds kFirstRetry{500};  // after a failure; doubles with each further one
constexpr milliseconds kLongestWait{60'000};

std::string counted_runs(std::size_t runs) {
  return fmt::format("{} {}", runs, runs == 1 ? "run" : "runs");
}

}  // namespace

std::string server_of(const std::filesystem::path& history) {
  const std::filesystem::path file = history.string() + "-server";
  std::error_code problem;
  if (history.empty() || (!std::filesystem::exists(file, problem) && !problem)) return {};
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line))
    throw HistoryError(haptics::printable(file.string()) + ": the server's address cannot be read");
  return line;
}

ServerLink::ServerLink(const std::filesystem::path& history, const std::string& address)
    : file_(history), address_(address), thread_([this] { run(); }) {}

ServerLink::~ServerLink() {
  stop_ = true;
  {
    const std::lock_guard lock(mutex_);
    is_asked_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<std::string> ServerLink::take_message() {
  const std::lock_guard lock(mutex_);
  if (messages_.empty()) return {};
  std::string message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

void ServerLink::report(const std::string& message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(message);
}

void ServerLink::finish(std::chrono::seconds limit) {
  {
    std::unique_lock lock(mutex_);
    // An exchange that is going on may have begun before the last run was saved, so wait for the one after it.
    const int enough = rounds_ + 2;
    for (const auto until = std::chrono::steady_clock::now() + limit; rounds_ < enough;) {
      is_asked_ = true;
      changed_.notify_all();
      if (changed_.wait_until(lock, until) == std::cv_status::timeout) break;
    }
  }
  stop_ = true;
  changed_.notify_all();
  try {
    const std::size_t left = Exchange(file_, HistoryUse::read).unsent_runs();
    if (left > 0)
      report(fmt::format("{} {} not on the server yet, but kept here, and sent when it can be reached",
                         counted_runs(left), left == 1 ? "is" : "are"));
  } catch (const HistoryError& problem) {
    report(problem.what());
  }
}

void ServerLink::run() {
  while (!stop_) {
    wait_ = kInterval;
    if (!is_refused_) try_exchange();
    std::unique_lock lock(mutex_);
    ++rounds_;
    changed_.notify_all();
    changed_.wait_for(lock, wait_, [this] { return is_asked_ || stop_; });
    is_asked_ = false;
  }
  server_.reset();
  history_.reset();
}

void ServerLink::report_outage(const std::string& reason, const std::string& message) {
  server_.reset();
  wait_ = retry_ = outage_.empty() ? kFirstRetry : std::min(2 * retry_, kLongestWait);
  if (stop_ || !outage_.empty()) return;
  outage_ = reason;
  report(message);
}

void ServerLink::try_exchange() {
  Exchanged done;
  try {
    if (!history_) history_.emplace(file_);
    if (!history_->reserve()) return;  // another program of this seat does it
    if (!server_) {
      server_.emplace(address_, stop_);
      greet(*server_, *history_);
    }
    exchange(*server_, *history_, done);
    if (!std::exchange(outage_, "").empty())
      report(fmt::format("{} can be used again; {} {} sent", printable_address(address_), counted_runs(done.runs),
                         done.runs == 1 ? "was" : "were"));
  } catch (const ServerRefusal& problem) {
    is_refused_ = true;
    report(fmt::format("{}: {}; results are kept only here", printable_address(address_), problem.what()));
  } catch (const ServerError& problem) {
    report_outage(problem.what(), fmt::format("{}: {}; results are kept here and sent later",
                                              printable_address(address_), problem.what()));
  } catch (const HistoryBusy&) {  // try again later
  } catch (const std::exception& problem) {
    report_outage(problem.what(), problem.what());
  }
  for (const std::string& message : done.messages) report(message);
}

}  // namespace gearshift::lessons
