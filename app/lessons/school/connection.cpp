#include "app/lessons/school/connection.h"

#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPollInterval{100};  // longest time until `stop` is seen

using Options = std::unique_ptr<PQconninfoOption, void (*)(PQconninfoOption*)>;
using Result = std::unique_ptr<PGresult, void (*)(PGresult*)>;

std::string part(const Options& parts, std::string_view keyword) {
  for (const PQconninfoOption* each = parts.get(); each != nullptr && each->keyword != nullptr; ++each)
    if (each->keyword == keyword && each->val != nullptr) return each->val;
  return {};
}

// The parts of the address; null if libpq cannot read it. Its message would repeat parts of a password.
Options parts_of(const std::string& address) {
  char* problem = nullptr;
  Options parts(PQconninfoParse(address.c_str(), &problem), PQconninfoFree);
  if (problem != nullptr) PQfreemem(problem);
  // libpq takes what follows an @ in a password for the host, and would name it in a message.
  if (part(parts, "host").find('@') != std::string::npos) parts.reset();
  return parts;
}

}  // namespace

bool is_server_address(const std::string& text) {
  return text.starts_with("postgresql://") || text.starts_with("postgres://");
}

std::string printable_address(const std::string& address) {
  const Options parts = parts_of(address);
  if (!parts) return "the server's address";
  const std::string host = part(parts, "host"), port = part(parts, "port"), name = part(parts, "dbname");
  return haptics::printable(fmt::format("{}{}{}{}{}", host.empty() ? "the local server" : host, port.empty() ? "" : ":",
                                        port, name.empty() ? "" : "/", name));
}

Connection::Connection(const std::string& address, const std::atomic<bool>& stop, std::chrono::milliseconds limit)
    : stop_(stop), limit_(limit), handle_(nullptr, PQfinish) {
  const Options parts = parts_of(address);
  if (!parts)
    throw ServerRefusal(
        "the server's address is none that libpq can read; special characters of a password must be percent-encoded");
  password_ = part(parts, "password");
  connect(address);
}

void Connection::connect(const std::string& address) {
  // Values before the address can be replaced by it, later ones cannot.
  const std::array keys{"fallback_application_name", "tcp_user_timeout", "dbname", "client_encoding",
                        static_cast<const char*>(nullptr)};
  const std::array values{"gearshift", "20000", address.c_str(), "UTF8", static_cast<const char*>(nullptr)};
  handle_.reset(PQconnectStartParams(keys.data(), values.data(), 1));
  if (!handle_) throw std::bad_alloc();
  password_ = password_.empty() && PQpass(handle_.get()) != nullptr ? PQpass(handle_.get()) : password_;
  const Moment until = steady_clock::now() + limit_;
  for (PostgresPollingStatusType status = PGRES_POLLING_WRITING; status != PGRES_POLLING_OK;
       status = PQconnectPoll(handle_.get())) {
    if (status == PGRES_POLLING_FAILED || PQstatus(handle_.get()) == CONNECTION_BAD)
      fail("", PQerrorMessage(handle_.get()));
    wait_for_socket(status == PGRES_POLLING_WRITING, until);
  }
  if (PQsetnonblocking(handle_.get(), 1) != 0) fail("", PQerrorMessage(handle_.get()));
  PQsetNoticeProcessor(
      handle_.get(), [](void*, const char*) {}, nullptr);
}

void Connection::wait_for_socket(bool to_write, Moment until) {
  pollfd socket{PQsocket(handle_.get()), static_cast<short>(to_write ? POLLIN | POLLOUT : POLLIN), 0};
  while (!stop_) {
    if (steady_clock::now() >= until) throw ServerError("the server cannot be used because it does not answer");
    if (poll(&socket, 1, static_cast<int>(kPollInterval.count())) > 0) return;
  }
  throw ServerError("the server was not waited for");
}

std::optional<std::string> Connection::value(const char* statement, std::initializer_list<std::string> parameters) {
  std::vector<const char*> values;
  for (const std::string& parameter : parameters) values.push_back(parameter.c_str());
  if (PQsendQueryParams(handle_.get(), statement, static_cast<int>(values.size()), nullptr, values.data(), nullptr,
                        nullptr, 0) == 0)
    fail("", PQerrorMessage(handle_.get()));
  return finish_statement();
}

void Connection::run_script(const std::string& statements) {
  if (PQsendQuery(handle_.get(), statements.c_str()) == 0) fail("", PQerrorMessage(handle_.get()));
  finish_statement();
}

// Sends what is left to send, and reads all results. Returns the first value of the last one.
std::optional<std::string> Connection::finish_statement() {
  const Moment until = steady_clock::now() + limit_;
  std::optional<std::string> value;
  for (;;) {
    int unsent = 0;
    while ((unsent = PQflush(handle_.get())) == 1 || PQisBusy(handle_.get()) == 1) {
      wait_for_socket(unsent == 1, until);
      if (PQconsumeInput(handle_.get()) == 0) fail("", PQerrorMessage(handle_.get()));
    }
    if (unsent < 0) fail("", PQerrorMessage(handle_.get()));
    const Result result(PQgetResult(handle_.get()), PQclear);
    if (!result) return value;
    const ExecStatusType status = PQresultStatus(result.get());
    if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK) {
      const char* state = PQresultErrorField(result.get(), PG_DIAG_SQLSTATE);
      const char* message = PQresultErrorField(result.get(), PG_DIAG_MESSAGE_PRIMARY);
      fail(state != nullptr ? state : "", message != nullptr ? message : PQresultErrorMessage(result.get()));
    }
    value.reset();
    if (PQntuples(result.get()) > 0 && PQnfields(result.get()) > 0 && PQgetisnull(result.get(), 0, 0) == 0)
      value = std::string(PQgetvalue(result.get(), 0, 0), static_cast<std::size_t>(PQgetlength(result.get(), 0, 0)));
  }
}

// `state`: SQLSTATE (PostgreSQL, appendix A), or empty. GS...: raised by server_schema.cpp.
void Connection::fail(const char* state, const std::string& message) const {
  std::string reason = message.substr(0, message.find('\n'));
  for (std::size_t at = 0; !password_.empty() && (at = reason.find(password_, at)) != std::string::npos;)
    reason.replace(at, password_.size(), "***");
  reason = haptics::printable(reason);
  const std::string_view code = state;
  if (code == "GS002") throw ServerRefusal(reason);
  if (code == "3F000" || code == "42883" || code == "42P01")
    throw ServerError("the server's database has no school yet; create it with gearshift school --make");
  throw ServerError("the server cannot be used because of this error: " + reason);
}

}  // namespace gearshift::lessons
