#include "app/lab/campaign/case_file.h"

#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "haptics/files/printable.h"

namespace gearshift::lab {
namespace {

std::string column_line() {
  std::string line =
      "case,refused,shifts,clean,reached,cycles,seconds,stiffness_n_per_m,limited,promised,stopped,ripple_m,softened,"
      "fastest_m_per_s";
  for (std::size_t i = 0; i < kCampaignLaws; ++i) {
    std::string name(law_text(static_cast<CampaignLaw>(i)).name);
    for (char& c : name) c = c == ' ' ? '_' : c;
    line += fmt::format(",{0}_looks,{0}_worst,{0}_bound,{0}_at_s", name);
  }
  return line + "\n";
}

std::string case_line(const CaseOutcome& out) {
  std::string line = fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}", out.number, out.refused, out.shifts,
                                 out.clean, out.reached, out.cycles, out.seconds, out.stiffness, out.limited,
                                 out.promised ? 1 : 0, out.stopped, out.ripple, out.softened, out.fastest);
  for (std::size_t i = 0; i < kCampaignLaws; ++i) {
    const LawResult& result = out.laws.result(static_cast<CampaignLaw>(i));
    line += fmt::format(",{},{},{},{}", result.checks, result.value, result.bound, result.time);
  }
  return line + "\n";
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  return fields;
}

// Parses a line field by field. Throws std::runtime_error with column, value and allowed range.
class LineReader {
 public:
  LineReader(std::string_view line, const std::vector<std::string_view>& columns)
      : columns_(columns), fields_(fields_of(line)) {
    if (fields_.size() == columns.size()) return;
    throw std::runtime_error(fmt::format("the line has {} fields instead of {}", fields_.size(), columns.size()));
  }

  std::string_view text() {
    if (!haptics::is_printable(fields_[at_])) refuse("text without control characters");
    return fields_[at_++];
  }
  template <typename Number>
  void number(Number& value, Number min = 0, Number max = std::numeric_limits<Number>::max()) {
    if (!parse(value) || !(value >= min && value <= max)) refuse(fmt::format("a number from {} to {}", min, max));
    ++at_;
  }
  void any_number(double& value) {  // a diverged lever may have infinite or NaN values
    if (!parse(value)) refuse("a number");
    ++at_;
  }

 private:
  template <typename Number>
  bool parse(Number& value) const {
    const std::string_view field = fields_[at_];
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    return error == std::errc() && end == field.data() + field.size();
  }
  [[noreturn]] void refuse(const std::string& allowed) const {
    throw std::runtime_error(
        fmt::format("{} is \"{}\", not {}", columns_[at_], haptics::printable(fields_[at_].substr(0, 40)), allowed));
  }

  const std::vector<std::string_view>& columns_;
  std::vector<std::string_view> fields_;
  std::size_t at_ = 0;
};

// `end`: the case number is below it.
CaseOutcome read_case(std::string_view line, const std::vector<std::string_view>& columns, std::uint64_t end) {
  LineReader in(line, columns);
  CaseOutcome out;
  in.number(out.number, std::uint64_t{0}, end - 1);
  out.refused = in.text();
  in.number(out.shifts, 0, out.refused.empty() ? kCaseShifts : 0);
  in.number(out.clean, 0, out.shifts);
  in.number(out.reached, 0, out.shifts);
  in.number(out.cycles);
  in.number(out.seconds);
  in.number(out.stiffness);
  in.number(out.limited);
  int promised = 0;
  in.number(promised, 0, 1);
  out.promised = promised == 1;
  in.number(out.stopped);
  in.any_number(out.ripple);
  in.number(out.softened);
  in.any_number(out.fastest);
  for (std::size_t i = 0; i < kCampaignLaws; ++i) {
    LawResult& result = out.laws.result(static_cast<CampaignLaw>(i));
    in.number(result.checks);
    in.any_number(result.value);
    in.any_number(result.bound);
    in.number(result.time);
  }
  return out;
}

void check_plain(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const bool is_there = status.type() != std::filesystem::file_type::not_found;
  if (is_there && !std::filesystem::is_regular_file(status))
    throw std::runtime_error(file.string() + ": this is not a regular file");
}

std::string read_text(const std::filesystem::path& file) {
  std::string text(std::filesystem::file_size(file), '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw std::runtime_error(file.string() + ": cannot be read");
  return text;
}

std::string first_line_of(std::string_view text) {
  return haptics::printable(text.substr(0, std::min<std::size_t>(text.find('\n'), 200)));
}

}  // namespace

CaseFile::CaseFile(const std::filesystem::path& file, const std::string& of, int shards) : name_(file.string()) {
  const std::string head = "# " + of + "\n" + column_line();
  check_plain(file);
  file_.reset(std::fopen(name_.c_str(), "ab"));
  if (!file_) throw std::runtime_error(fmt::format("{}: cannot be written ({})", name_, std::strerror(errno)));
  if (flock(fileno(file_.get()), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw std::runtime_error(name_ + ": another campaign is writing to this file; choose another folder with --out");
  std::string text = read_text(file);
  const std::size_t old_size = text.size();
  // The program may have been stopped while it wrote the header.
  if (text.size() < head.size() && head.starts_with(text)) text.clear();
  if (!text.empty() && !text.starts_with(head)) {
    throw std::runtime_error(
        fmt::format("{}: the file belongs to another campaign (\"{}\" instead of \"# {}\"); choose another folder with "
                    "--out",
                    name_, first_line_of(text), of));
  }
  const std::size_t valid_size = text.empty() ? 0 : read_cases(text, head.size(), shards);
  std::error_code error;
  if (valid_size < old_size) std::filesystem::resize_file(file, valid_size, error);
  if (error) throw std::runtime_error(name_ + ": cannot be written (" + error.message() + ")");
  if (text.empty()) std::fputs(head.c_str(), file_.get());
}

// Reads the cases in the lines from `begin` into cases_. Returns the end position of the last complete line. Cases start
// in order and on at most kMaxThreads threads, which limits the case number.
std::size_t CaseFile::read_cases(std::string_view text, std::size_t begin, int shards) {
  const std::string line = column_line();
  const std::vector<std::string_view> columns = fields_of(std::string_view(line).substr(0, line.size() - 1));
  int number = 3;  // line number; lines 1 and 2 are the header
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1, ++number) {
    try {
      CaseOutcome out = read_case(text.substr(begin, end - begin), columns,
                                  (cases_.size() + kMaxThreads) * static_cast<std::uint64_t>(shards));
      const std::uint64_t of_case = out.number;
      if (!cases_.emplace(of_case, std::move(out)).second)
        throw std::runtime_error(fmt::format("case {} appears twice", of_case));
    } catch (const std::runtime_error& problem) {
      throw std::runtime_error(fmt::format("{}:{}: {}", name_, number, problem.what()));
    }
  }
  return begin;
}

void CaseFile::add(const CaseOutcome& outcome) {
  const std::string line = case_line(outcome);
  const bool is_written = file_ && std::fputs(line.c_str(), file_.get()) >= 0 && std::fflush(file_.get()) == 0;
  if (is_written) return;
  if (file_) why_ = std::strerror(errno);
  file_.reset();  // write no more lines, so that the truncated line stays the last line
  throw std::runtime_error(fmt::format("{}: cannot be written ({})", name_, why_));
}

}  // namespace gearshift::lab
