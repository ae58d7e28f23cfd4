// Exchange of rows between histories: of a seat with its school's server, or of several files.
//
// Rows travel as JSON documents of one learner each:
//   {"learner": {"id", "name", "made_at", "next_lesson"},
//    "sessions", "runs", "shifts", "errors", "comments": [rows with the columns of schema.h], "deleted_comments": [id]}
// A file numbers its own rows from 1. In a document, row r of seat s has the number s * kRowsPerSeat + r, so that rows
// of different seats never have the same number. Rows of other seats keep these numbers in the file.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/lessons/history/history.h"

namespace gearshift::lessons {

inline constexpr std::int64_t kRowsPerSeat = 10'000'000;

struct RowNumbering {
  std::int64_t seat = 0;

  std::int64_t to_document(std::int64_t number) const noexcept {
    return number < kRowsPerSeat ? seat * kRowsPerSeat + number : number;
  }
  std::int64_t to_file(std::int64_t number) const noexcept {
    return number / kRowsPerSeat == seat ? number % kRowsPerSeat : number;
  }
};

// A file's record of its server. The server counts the documents of each seat, and keeps the mark of the last one. A
// file with another count or mark is a copy or an older state of the seat's history, and must not send.
struct SeatState {
  std::string token;       // identifies this file to the server
  std::string school;      // identifies the server; empty: never connected
  std::int64_t seat = 0;   // number of the seat at the server; 0: none yet
  std::int64_t sends = 0;  // number of documents that the server has confirmed
  std::string mark;        // of the last confirmed document
  std::string next_mark;   // of a document that was sent, perhaps without confirmation
};

struct Parcel {
  enum class Kind { rows, erased_learner, deleted_comment };
  Kind kind = Kind::rows;
  std::string document;               // `rows`: JSON
  std::int64_t row = 0;               // otherwise the number of the deleted row
  std::size_t runs = 0;               // number of runs in the document
  std::vector<std::int64_t> changes;  // numbers in the list of unsent changes
};

struct KnownLearner {
  std::int64_t id = 0;       // number in documents
  std::int64_t version = 0;  // of the learner's data at the server, when it was last received; 0: never
};

// Writes are durable when a function returns, even if the power fails (PRAGMA synchronous = FULL). Functions throw
// HistoryError like those of History. Use from one thread.
class Exchange {
 public:
  explicit Exchange(const std::filesystem::path& file, HistoryUse use = HistoryUse::write);
  ~Exchange();
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  History& history() noexcept { return history_; }

  // Reserves the exchange with the server for this process, until the destructor. Returns false if another process has
  // reserved it.
  bool reserve();

  SeatState seat();  // with a new token if there is none yet
  void set_seat(const SeatState& state);
  void forget_sent();  // lists all rows of this file as unsent

  // Oldest unsent changes, those of one learner together. `host`: prefix of the place of recordings. Empty: none left.
  std::optional<Parcel> next_parcel(const std::string& host);
  void mark_sent(const Parcel& parcel);  // except rows that have changed again
  std::size_t unsent_runs();

  std::vector<KnownLearner> known_learners();

  // Stores a learner's document. `id`: KnownLearner::id of the learner of this file who is meant; empty: the learner with
  // the same name, who is added if missing. Rows with unsent changes stay as they are. Learners of this file who turn out
  // to be one at the server are joined.
  void receive(const std::string& document, std::optional<std::int64_t> id);
  std::string document_of(std::int64_t learner, std::int64_t seat);  // all rows, with this number of the seat
  // Gives the next rows of a history in memory the numbers that they have in documents, which its user will see.
  void number_as_in_documents();
  std::int64_t own_number(std::int64_t number);  // number in this file of a row with this number in documents

 private:
  struct Tables;
  RowNumbering own_numbering();

  History history_;
  bool has_document_numbers_ = false;
  int lock_ = -1;
};

// Copies all learners of the history `from`. `seat` numbers its rows if it belongs to no seat of a school.
void copy_learners(const std::filesystem::path& from, std::int64_t seat, Exchange& to);

}  // namespace gearshift::lessons
