#include "tests/bench/campaign/case_file.h"

#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/core.h>

namespace gearshift {
namespace {

std::string first_line(std::uint64_t seed) {
  return fmt::format("# gearshift campaign, seed {}\n", seed);
}

std::string column_line() {
  std::string line =
      "case,refused,shifts,clean,reached,cycles,seconds,stiffness_n_per_m,limited,promised,stopped,ripple_m,softened,"
      "fastest_m_per_s";
  for (std::size_t i = 0; i < kCampaignLaws; ++i) {
    std::string name(law_words(static_cast<CampaignLaw>(i)).name);
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
    const LawSeen& seen = out.laws.seen(static_cast<CampaignLaw>(i));
    line += fmt::format(",{},{},{},{}", seen.looks, seen.value, seen.bound, seen.time);
  }
  return line + "\n";
}

// Field by field; what does not read is remembered.
class LineReader {
 public:
  explicit LineReader(std::string_view line) : rest_(line) {}

  std::string_view text() {
    good = good && !at_end_;
    const std::size_t comma = rest_.find(',');
    const std::string_view field = rest_.substr(0, comma);
    at_end_ = comma == std::string_view::npos;
    rest_ = at_end_ ? std::string_view() : rest_.substr(comma + 1);
    return field;
  }
  template <typename Number>
  void number(Number& value) {
    const std::string_view field = text();
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    good = good && error == std::errc() && end == field.data() + field.size();
  }
  bool is_whole() const { return good && at_end_; }

  bool good = true;

 private:
  std::string_view rest_;
  bool at_end_ = false;
};

std::optional<CaseOutcome> read_case(std::string_view line) {
  LineReader in(line);
  CaseOutcome out;
  in.number(out.number);
  out.refused = in.text();
  in.number(out.shifts);
  in.number(out.clean);
  in.number(out.reached);
  in.number(out.cycles);
  in.number(out.seconds);
  in.number(out.stiffness);
  in.number(out.limited);
  int promised = 0;
  in.number(promised);
  out.promised = promised == 1;
  in.number(out.stopped);
  in.number(out.ripple);
  in.number(out.softened);
  in.number(out.fastest);
  for (std::size_t i = 0; i < kCampaignLaws; ++i) {
    LawSeen& seen = out.laws.seen(static_cast<CampaignLaw>(i));
    in.number(seen.looks);
    in.number(seen.value);
    in.number(seen.bound);
    in.number(seen.time);
  }
  if (!in.is_whole()) return std::nullopt;
  return out;
}

std::string whole_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

CaseFile::CaseFile(const std::filesystem::path& file, std::uint64_t seed) : name_(file.string()) {
  const std::string head = first_line(seed) + column_line();
  std::string text = whole_text(file);
  if (text.size() < head.size() && head.starts_with(text)) text.clear();  // stopped in its first moment
  if (!text.empty() && !text.starts_with(head))
    throw std::runtime_error(name_ + ": of another campaign: another seed, or another program made it");
  std::size_t good = text.empty() ? 0 : head.size();
  for (std::size_t end = 0; good > 0 && (end = text.find('\n', good)) != std::string::npos; good = end + 1) {
    std::optional<CaseOutcome> out = read_case(std::string_view(text).substr(good, end - good));
    if (!out) throw std::runtime_error(fmt::format("{}: byte {}: a line that is no case", name_, good));
    cases_[out->number] = std::move(*out);
  }
  if (!text.empty()) std::filesystem::resize_file(file, good);
  file_.reset(std::fopen(name_.c_str(), text.empty() ? "wb" : "ab"));
  if (!file_) throw std::runtime_error(name_ + ": cannot be written");
  if (text.empty()) std::fputs(head.c_str(), file_.get());
}

void CaseFile::add(const CaseOutcome& outcome) {
  const std::string line = case_line(outcome);
  const bool is_written = std::fputs(line.c_str(), file_.get()) >= 0 && std::fflush(file_.get()) == 0;
  if (!is_written) throw std::runtime_error(name_ + ": cannot be written");
}

}  // namespace gearshift
