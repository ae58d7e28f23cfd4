#include "app/lessons/history/exchange.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/lessons/history/history_state.h"
#include "app/lessons/history/sql_binding.h"

namespace gearshift::lessons {
namespace {

using Json = nlohmann::json;

constexpr int kMaxRuns = 200;  // runs per document, to bound its size

std::string random_token() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", device(), device(), device(), device());
}

bool is_row_number(std::string_view column) {
  return column == "id" || column == "learner" || column == "session" || column == "run";
}

// A value as the column declares it, because a damaged file may hold any value in any column.
Json value_of(const SQLite::Statement& row, int index, const RowNumbering& numbering) {
  const SQLite::Column column = row.getColumn(index);
  if (column.isNull()) return nullptr;
  const std::string type = row.getColumnDeclaredType(index);
  if (type == "REAL") return stored_figure(column.getDouble());
  if (type == "INTEGER") {
    const std::int64_t number = column.getInt64();
    return is_row_number(row.getColumnName(index)) ? numbering.to_document(number) : number;
  }
  std::string text = column.getString();
  std::erase(text, '\0');
  return text;
}

void bind_json(SQLite::Statement& statement, int index, const Json& value) {
  if (value.is_number_float())
    statement.bind(index, value.get<double>());
  else if (value.is_number_integer())
    statement.bind(index, value.get<std::int64_t>());
  else if (value.is_string())
    statement.bind(index, value.get<std::string>());
  else
    statement.bind(index);
}

std::string to_text(const Json& document) {
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::int64_t one_number(SQLite::Database& database, const std::string& text, std::int64_t argument) {
  SQLite::Statement query(database, text);
  query.bind(1, argument);
  return query.executeStep() ? query.getColumn(0).getInt64() : 0;
}

}  // namespace

// The rows of a file in the form of documents, and back.
struct Exchange::Tables {
  History::State& state;
  SQLite::Database& database = *state.database;
  RowNumbering numbering{};
  std::int64_t last_change = 0;  // newest unsent change before this document was received

  // Rows of a query that has the parameters ?1 and, perhaps, ?2.
  Json rows(const std::string& text, std::int64_t first, std::optional<std::int64_t> second = {}) {
    SQLite::Statement query(database, text);
    query.bind(1, first);
    if (second) query.bind(2, *second);
    Json all = Json::array();
    while (query.executeStep()) {
      Json row = Json::object();
      for (int i = 0; i < query.getColumnCount(); ++i) row[query.getColumnName(i)] = value_of(query, i, numbering);
      all.push_back(std::move(row));
    }
    return all;
  }

  std::int64_t execute(const std::string& text, std::int64_t first, std::optional<std::int64_t> second = {}) {
    SQLite::Statement statement(database, text);
    statement.bind(1, first);
    if (second) statement.bind(2, *second);
    return statement.exec();
  }

  // `runs`, `comments`: the end of a query.
  Json document(std::int64_t learner, const std::string& sessions, const std::string& runs, const std::string& comments,
                const std::string& host) {
    Json all;
    all["learner"] = rows("SELECT id, name, made_at, next_lesson FROM learner WHERE id = ?1", learner).at(0);
    all["sessions"] = rows("SELECT * FROM session WHERE learner = ?1 " + sessions, learner);
    all["runs"] =
        rows("SELECT * FROM lesson_run WHERE session IN (SELECT id FROM session WHERE learner = ?1) " + runs, learner);
    all["shifts"] = all["errors"] = Json::array();
    for (Json& run : all["runs"]) {
      const std::int64_t id = numbering.to_file(run["id"].get<std::int64_t>());
      for (Json& shift : rows("SELECT * FROM shift WHERE run = ?1", id)) all["shifts"].push_back(std::move(shift));
      for (Json& error : rows("SELECT * FROM driving_error WHERE run = ?1", id))
        all["errors"].push_back(std::move(error));
      place_recording(run, host);
    }
    all["comments"] = rows(
        "SELECT * FROM comment WHERE run IN (SELECT r.id FROM lesson_run r JOIN session s ON "
        "s.id = r.session WHERE s.learner = ?1) " +
            comments,
        learner);
    return all;
  }

  // Elsewhere, a recording is not a file below the history's folder but a place to look.
  void place_recording(Json& run, const std::string& host) const {
    const auto recording = run["recording"].get<std::string>();
    if (!recording.empty()) run["kept_at"] = host + (history_folder(state.file) / recording).string();
    run["recording"] = "";
  }

  // Inserts the row, or replaces the row with the same number.
  void store(const char* table, const Json& row) {
    std::string names, marks, changes;
    std::vector<std::string> columns;
    SQLite::Statement all(database, "SELECT name FROM pragma_table_info(?)");
    all.bind(1, table);
    while (all.executeStep()) columns.push_back(all.getColumn(0).getString());
    for (const std::string& column : columns) {
      names += (names.empty() ? "" : ", ") + column;
      marks += marks.empty() ? "?" : ", ?";
      if (column != "id") changes += (changes.empty() ? "" : ", ") + column + " = excluded." + column;
    }
    const bool has_id = columns.front() == "id";
    SQLite::Statement insert(database, fmt::format("INSERT INTO {} ({}) VALUES ({}){}", table, names, marks,
                                                   has_id ? " ON CONFLICT (id) DO UPDATE SET " + changes : ""));
    for (int index = 0; const std::string& column : columns) {
      Json value = row.value(column, Json());
      if (is_row_number(column) && column != "learner") value = numbering.to_file(value.get<std::int64_t>());
      bind_json(insert, ++index, value);
    }
    insert.exec();
  }

  // The learner of this file whom a document means, see receive(); 0: deleted meanwhile.
  std::int64_t receiver(const Json& learner, std::optional<std::int64_t> id) {
    if (id) return one_number(database, "SELECT id FROM learner WHERE id = ?", numbering.to_file(*id));
    const std::string name = stored_name(learner.at("name").get<std::string>());
    for (const LearnerRow& row : state.learners())
      if (row.name == name) return row.id;
    store("learner", learner);
    return numbering.to_file(learner.at("id").get<std::int64_t>());
  }

  // Takes over name and next lesson, unless they are unsent or another learner of this file has the name.
  void rename(std::int64_t learner, const Json& row) {
    if (is_unsent("learner", learner)) return;
    SQLite::Statement update(
        database,
        "UPDATE learner SET next_lesson = ?2, name = CASE WHEN EXISTS (SELECT 1 FROM learner WHERE "
        "name = ?3 AND id != ?1) THEN name ELSE ?3 END WHERE id = ?1");
    update.bind(1, learner);
    update.bind(2, row.at("next_lesson").get<std::string>());
    update.bind(3, stored_name(row.at("name").get<std::string>()));
    update.exec();
  }

  // Joins the other learner of this file who is the same at the server, if there is one.
  void join_equal(std::int64_t learner, std::int64_t on_server) {
    for (;;) {
      SQLite::Statement other(database, "SELECT learner FROM server_learner WHERE on_server = ?2 AND learner != ?1");
      other.bind(1, learner);
      other.bind(2, on_server);
      if (!other.executeStep()) return;
      const std::int64_t joined = other.getColumn(0).getInt64();
      other.reset();
      state.join_learners(learner, joined);
    }
  }

  void take(const Json& document, std::optional<std::int64_t> id) {
    const Json& row = document.at("learner");
    const std::int64_t learner = receiver(row, id);
    if (learner == 0) return;
    if (row.contains("version")) {
      const auto on_server = row.at("id").get<std::int64_t>();
      join_equal(learner, on_server);
      execute("INSERT OR REPLACE INTO server_learner VALUES (?1, ?2, 0)", learner, on_server);
      execute("UPDATE server_learner SET version = ?2 WHERE learner = ?1", learner,
              row.at("version").get<std::int64_t>());
      rename(learner, row);
    }
    for (Json session : document.at("sessions")) {
      session["learner"] = learner;
      store("session", session);
    }
    take_runs(document);
    for (const Json& comment : document.at("comments"))
      if (!is_unsent("comment", numbering.to_file(comment.at("id").get<std::int64_t>()))) store("comment", comment);
    for (const Json& comment : document.value("deleted_comments", Json::array()))
      execute("DELETE FROM comment WHERE id = ?1", numbering.to_file(comment.get<std::int64_t>()));
  }

  void take_runs(const Json& document) {
    for (const Json& run : document.at("runs")) {
      store("lesson_run", run);
      for (const char* text : {"DELETE FROM shift WHERE run = ?1", "DELETE FROM driving_error WHERE run = ?1"})
        execute(text, numbering.to_file(run.at("id").get<std::int64_t>()));
    }
    for (const Json& shift : document.at("shifts")) store("shift", shift);
    for (const Json& error : document.at("errors")) store("driving_error", error);
  }

  // Number of the unsent change of this row; 0: none.
  std::int64_t change_of(const char* kind, std::int64_t row) {
    return one_number(database, fmt::format("SELECT number FROM unsent WHERE kind = '{}' AND row = ?", kind), row);
  }

  bool is_unsent(const char* kind, std::int64_t row) {
    const std::int64_t number = change_of(kind, row);
    return number > 0 && number <= last_change;
  }
};

Exchange::Exchange(const std::filesystem::path& file, HistoryUse use)
    : history_(file, system_seconds, kHistoryLockTimeout, use) {
  history_.state_->translating_errors([&] { history_.state_->database->exec("PRAGMA synchronous = FULL"); });
}

Exchange::~Exchange() {
  if (lock_ >= 0) close(lock_);
}

bool Exchange::reserve() {
  if (lock_ >= 0) return true;
  const std::string file = history_.file().string() + "-seat";
  lock_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_ < 0) history_.state_->refuse(fmt::format("{} cannot be created", file));
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return true;
  close(std::exchange(lock_, -1));
  return false;
}

SeatState Exchange::seat() {
  History::State& state = *history_.state_;
  const auto read = [&]() -> std::optional<SeatState> {
    SQLite::Statement row = state.query("SELECT token, school, seat, sends, mark, next_mark FROM server");
    if (!row.executeStep()) return {};
    return SeatState{row.getColumn(0).getString(), row.getColumn(1).getString(), row.getColumn(2).getInt64(),
                     row.getColumn(3).getInt64(),  row.getColumn(4).getString(), row.getColumn(5).getString()};
  };
  return state.translating_errors(read).value_or(SeatState{random_token(), "", 0, 0, "", ""});
}

void Exchange::set_seat(const SeatState& seat) {
  History::State& state = *history_.state_;
  state.write([&] {
    state.database->exec("DELETE FROM server");
    SQLite::Statement insert = state.query("INSERT INTO server VALUES (?, ?, ?, ?, ?, ?)");
    insert.bind(1, seat.token);
    insert.bind(2, seat.school);
    insert.bind(3, seat.seat);
    insert.bind(4, seat.sends);
    insert.bind(5, seat.mark);
    insert.bind(6, seat.next_mark);
    insert.exec();
  });
}

void Exchange::forget_sent() {
  History::State& state = *history_.state_;
  state.write([&] {
    for (const char* kind : {"learner", "session", "lesson_run", "comment"})
      state.database->exec(
          fmt::format("INSERT INTO unsent (kind, row) SELECT '{0}', id FROM {0} WHERE id < {1} AND id "
                      "NOT IN (SELECT row FROM unsent WHERE kind = '{0}')",
                      kind, kRowsPerSeat));
    state.database->exec("DELETE FROM server_learner");
  });
}

std::optional<Parcel> Exchange::next_parcel(const std::string& host) {
  const RowNumbering numbering = own_numbering();
  History::State& state = *history_.state_;
  return state.write([&]() -> std::optional<Parcel> {
    Tables tables{state};
    tables.numbering = numbering;
    // Rows that were deleted with their learner.
    for (const char* kind : {"learner", "session", "lesson_run", "comment"})
      state.database->exec(
          fmt::format("DELETE FROM unsent WHERE kind = '{0}' AND gone = 0 AND row NOT IN (SELECT id FROM {0})", kind));
    SQLite::Statement oldest = state.query("SELECT number, kind, row, gone FROM unsent ORDER BY number LIMIT 1");
    if (!oldest.executeStep()) return {};
    const std::int64_t number = oldest.getColumn(0).getInt64();
    const std::string kind = oldest.getColumn(1).getString();
    const std::int64_t row = oldest.getColumn(2).getInt64();
    Parcel parcel;
    if (oldest.getColumn(3).getInt() != 0) {
      parcel.kind = kind == "learner" ? Parcel::Kind::erased_learner : Parcel::Kind::deleted_comment;
      parcel.row = tables.numbering.to_document(row);
      parcel.changes = {number};
      return parcel;
    }
    const std::int64_t learner =
        kind == "learner" ? row
        : kind == "session"
            ? one_number(*state.database, "SELECT learner FROM session WHERE id = ?", row)
            : one_number(*state.database,
                         kind == "lesson_run"
                             ? "SELECT learner FROM session WHERE id = (SELECT session FROM lesson_run WHERE id = ?)"
                             : "SELECT learner FROM session WHERE id = (SELECT session FROM lesson_run WHERE id = "
                               "(SELECT run FROM comment WHERE id = ?))",
                         row);
    // Comments wait until their run has been sent.
    const std::string sessions = "AND id IN (SELECT row FROM unsent WHERE kind = 'session')";
    const std::string runs =
        fmt::format("AND id IN (SELECT row FROM unsent WHERE kind = 'lesson_run') ORDER BY id LIMIT {}", kMaxRuns);
    const std::string comments =
        "AND id IN (SELECT row FROM unsent WHERE kind = 'comment') AND run NOT IN (SELECT row FROM (SELECT row FROM "
        "unsent JOIN lesson_run r ON r.id = row JOIN session s ON s.id = r.session WHERE kind = 'lesson_run' AND "
        "s.learner = ?1 ORDER BY row LIMIT -1 OFFSET " +
        std::to_string(kMaxRuns) + "))";
    Json document = tables.document(learner, sessions, runs, comments, host);
    document["learner"]["changed"] = tables.change_of("learner", learner) > 0;
    parcel.runs = document["runs"].size();
    const auto note = [&](const char* of, const Json& rows) {
      for (const Json& each : rows)
        parcel.changes.push_back(tables.change_of(of, numbering.to_file(each["id"].get<std::int64_t>())));
    };
    note("learner", Json::array({document["learner"]}));
    note("session", document["sessions"]);
    note("lesson_run", document["runs"]);
    note("comment", document["comments"]);
    std::erase(parcel.changes, 0);  // a learner who has not changed
    if (std::find(parcel.changes.begin(), parcel.changes.end(), number) == parcel.changes.end())
      state.refuse("its list of unsent changes is damaged");
    parcel.document = to_text(document);
    return parcel;
  });
}

void Exchange::mark_sent(const Parcel& parcel) {
  History::State& state = *history_.state_;
  state.write([&] {
    Tables tables{state};
    for (const std::int64_t change : parcel.changes) tables.execute("DELETE FROM unsent WHERE number = ?1", change);
  });
}

std::size_t Exchange::unsent_runs() {
  History::State& state = *history_.state_;
  return state.translating_errors([&] {
    return static_cast<std::size_t>(
        state.database->execAndGet("SELECT count(*) FROM unsent WHERE kind = 'lesson_run'").getInt64());
  });
}

std::vector<KnownLearner> Exchange::known_learners() {
  const RowNumbering numbering = own_numbering();
  History::State& state = *history_.state_;
  return state.translating_errors([&] {
    std::vector<KnownLearner> all;
    SQLite::Statement rows = state.query(
        "SELECT id, coalesce((SELECT version FROM server_learner WHERE learner = id), 0) FROM learner WHERE id NOT IN "
        "(SELECT row FROM unsent WHERE kind = 'learner')");
    while (rows.executeStep())
      all.push_back({numbering.to_document(rows.getColumn(0).getInt64()), rows.getColumn(1).getInt64()});
    return all;
  });
}

// With a seat that no row has, no number is changed.
RowNumbering Exchange::own_numbering() {
  return {has_document_numbers_ ? -1 : seat().seat};
}

void Exchange::number_as_in_documents() {
  const std::int64_t first = own_numbering().to_document(0);
  has_document_numbers_ = true;
  history_.state_->write(
      [&] { Tables{*history_.state_}.execute("UPDATE last_number SET number = number + ?1", first); });
}

std::int64_t Exchange::own_number(std::int64_t number) {
  return own_numbering().to_file(number);
}

void Exchange::receive(const std::string& text, std::optional<std::int64_t> id) {
  const RowNumbering numbering = own_numbering();
  History::State& state = *history_.state_;
  state.write([&] {
    try {
      const Json document = Json::parse(text);
      Tables tables{state};
      tables.numbering = numbering;
      tables.last_change = state.database->execAndGet("SELECT coalesce(max(number), 0) FROM unsent").getInt64();
      tables.take(document, id);
      tables.execute("DELETE FROM unsent WHERE number > ?1", tables.last_change);
    } catch (const Json::exception&) {
      state.refuse("what another history sent is not valid");
    }
  });
}

std::string Exchange::document_of(std::int64_t learner, std::int64_t seat_number) {
  History::State& state = *history_.state_;
  return state.translating_errors([&] {
    Tables tables{state};
    tables.numbering.seat = seat_number;
    return to_text(tables.document(learner, "", "ORDER BY id", "", ""));
  });
}

void copy_learners(const std::filesystem::path& from, std::int64_t seat, Exchange& to) {
  Exchange source(from, HistoryUse::read);
  if (const SeatState known = source.seat(); known.seat > 0) seat = known.seat;
  for (const LearnerRow& learner : source.history().learners()) to.receive(source.document_of(learner.id, seat), {});
}

}  // namespace gearshift::lessons
