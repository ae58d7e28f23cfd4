#include "app/lessons/school/exchange_with_server.h"

#include <unistd.h>

#include <array>
#include <random>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/lessons/report/delete_learner.h"
#include "app/lessons/school/server_schema.h"
#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

using Json = nlohmann::json;

std::string random_mark() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

template <class Read>
auto read_answer(const Read& read) {
  try {
    return read();
  } catch (const Json::exception&) {
    throw ServerError("the server's answer is not valid");
  }
}

void check_version(Connection& server) {
  const int version = std::stoi(server.value("SELECT gearshift.schema_version()").value_or("0"));
  if (version > kServerVersion)
    throw ServerRefusal(fmt::format(
        "the server's school has version {}, but this program knows only version {}; install a newer gearshift",
        version, kServerVersion));
  if (version < kServerVersion)
    throw ServerError(
        fmt::format("the server's school has version {}, but this program needs version {}; renew it with "
                    "gearshift school --make",
                    version, kServerVersion));
}

void send(Connection& server, Exchange& history, SeatState& seat, const Parcel& parcel) {
  seat.next_mark = random_mark();
  history.set_seat(seat);
  const std::string sends = std::to_string(seat.sends);
  if (parcel.kind == Parcel::Kind::rows)
    server.value("SELECT gearshift.send_rows($1, $2::bigint, $3, $4::jsonb)",
                 {seat.token, sends, seat.next_mark, parcel.document});
  else
    server.value(parcel.kind == Parcel::Kind::erased_learner
                     ? "SELECT gearshift.erase_learner($1, $2::bigint, $3, $4::bigint)"
                     : "SELECT gearshift.delete_comment($1, $2::bigint, $3, $4::bigint)",
                 {seat.token, sends, seat.next_mark, std::to_string(parcel.row)});
  ++seat.sends;
  seat.mark = seat.next_mark;
  history.set_seat(seat);
  history.mark_sent(parcel);
}

std::string erase_here(Exchange& history, std::int64_t number) {
  for (const LearnerRow& learner : history.history().learners()) {
    if (learner.id != number) continue;
    const DeletionReport deleted = delete_learner(history.history(), learner);
    std::string message =
        fmt::format("{} was deleted on another seat, so {} {} and {} {} were deleted here, too",
                    haptics::printable(learner.name), deleted.runs, deleted.runs == 1 ? "run" : "runs",
                    deleted.recordings.size(), deleted.recordings.size() == 1 ? "recording" : "recordings");
    if (!deleted.remaining_data.empty()) message += "; " + deleted.remaining_data;
    for (const std::string& file : deleted.not_deleted)
      message += "; could not be deleted: " + haptics::printable(file);
    return message;
  }
  return {};
}

// Fetches the first of these learners who has changed at the server. Returns false if none has.
bool fetch_next(Connection& server, Exchange& history, const std::vector<KnownLearner>& known, Exchanged& done) {
  Json wanted = Json::array();
  for (const KnownLearner& learner : known) wanted.push_back({{"learner", learner.id}, {"version", learner.version}});
  const std::optional<std::string> answer =
      server.value("SELECT gearshift.fetch_learner($1, $2::jsonb)::text", {history.seat().token, wanted.dump()});
  if (!answer) return false;
  const auto [asked, is_erased] = read_answer([&] {
    const Json document = Json::parse(*answer);
    return std::pair(document.at("asked").get<std::int64_t>(), document.at("erased").get<bool>());
  });
  if (!is_erased) {
    history.receive(*answer, asked);
    return true;
  }
  const std::string message = erase_here(history, history.own_number(asked));
  if (!message.empty()) done.messages.push_back(message);
  return !message.empty();
}

}  // namespace

void greet(Connection& server, Exchange& history) {
  check_version(server);
  SeatState seat = history.seat();
  const std::string hello =
      server.value("SELECT gearshift.hello($1, $2)::text", {seat.token, host_name()}).value_or("");
  read_answer([&] {
    const Json answer = Json::parse(hello);
    const auto school = answer.at("school").get<std::string>(), mark = answer.at("mark").get<std::string>();
    const auto sends = answer.at("sends").get<std::int64_t>();
    const std::string file = haptics::printable(history.history().file().string());
    if (!seat.school.empty() && seat.school != school)
      throw ServerRefusal(fmt::format("{}: this history belongs to another school's server", file));
    const bool is_confirmed =
        (sends == seat.sends && mark == seat.mark) || (sends == seat.sends + 1 && mark == seat.next_mark);
    if (!is_confirmed && sends >= seat.sends)
      throw ServerRefusal(fmt::format(
          "{}: this history is a copy or an older state of the one that seat {} has sent; move it away to start a new "
          "one, which gets each learner's results from the server",
          file, answer.at("seat").get<std::int64_t>()));
    if (!is_confirmed) history.forget_sent();  // the server was restored from a backup
    history.set_seat({seat.token, school, answer.at("seat").get<std::int64_t>(), sends, mark, ""});
  });
}

void exchange(Connection& server, Exchange& history, Exchanged& done) {
  SeatState seat = history.seat();
  const std::string host = host_name() + ":";
  while (const std::optional<Parcel> parcel = history.next_parcel(host)) {
    send(server, history, seat, *parcel);
    done.runs += parcel->runs;
  }
  while (fetch_next(server, history, history.known_learners(), done)) {
  }
}

void fetch_all(Connection& server, Exchange& history) {
  check_version(server);
  const std::string all = server.value("SELECT gearshift.learners()::text").value_or("[]");
  for (const auto& learner : read_answer([&] { return Json::parse(all).get<std::vector<std::int64_t>>(); })) {
    const Json wanted = Json::array({{{"learner", learner}, {"version", 0}}});
    const auto answer = server.value("SELECT gearshift.fetch_learner('', $1::jsonb)::text", {wanted.dump()});
    if (answer && !read_answer([&] { return Json::parse(*answer).at("erased").get<bool>(); }))
      history.receive(*answer, {});
  }
}

}  // namespace gearshift::lessons
