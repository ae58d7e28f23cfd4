// A connection to a PostgreSQL server (libpq). libpq's own settings apply: TLS by sslmode and sslrootcert, passwords from
// ~/.pgpass or PGPASSWORD.
#pragma once

#include <atomic>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

struct pg_conn;

namespace gearshift::lessons {

// what() is one sentence without a password.
struct ServerError : std::runtime_error {  // may pass: no network, server down or its disk full, no permission yet
  using std::runtime_error::runtime_error;
};
struct ServerRefusal : ServerError {  // stays: a newer schema, another school, a copied history
  using ServerError::ServerError;
};

// True for "postgresql://..." and "postgres://...".
bool is_server_address(const std::string& text);

// The address without its password, for messages. An address that libpq cannot read: only a note that it is none.
std::string printable_address(const std::string& address);

class Connection {
 public:
  // Connects to `address`: a URL or a connection string of libpq. While it waits, the constructor and all functions
  // throw ServerError once `stop` is true, or after `limit`.
  Connection(const std::string& address, const std::atomic<bool>& stop,
             std::chrono::milliseconds limit = std::chrono::seconds(30));

  // Runs one statement with the parameters $1, $2, ... Returns the first value of its first row; empty: NULL, or no row.
  std::optional<std::string> value(const char* statement, std::initializer_list<std::string> parameters = {});
  void run_script(const std::string& statements);  // without parameters, in one transaction

 private:
  using Moment = std::chrono::steady_clock::time_point;

  void connect(const std::string& address);
  void wait_for_socket(bool to_write, Moment until);
  std::optional<std::string> finish_statement();
  [[noreturn]] void fail(const char* state, const std::string& message) const;

  const std::atomic<bool>& stop_;
  std::chrono::milliseconds limit_;
  std::string password_;  // never in a message
  std::unique_ptr<pg_conn, void (*)(pg_conn*)> handle_;
};

}  // namespace gearshift::lessons
