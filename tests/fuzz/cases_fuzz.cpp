// Fuzzes a campaign's cases.csv: the file is either rejected in one sentence and left unchanged, or read without an
// unfinished last line, continued, and read back the same.
#include <string>

#include "app/lab/campaign/case_file.h"
#include "tests/fuzz/fuzz_checks.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

constexpr const char* kOf = "one campaign";

std::string text_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The header that a campaign writes first: without it nearly every input would be rejected there.
const std::string& head() {
  static const std::string text = [] {
    const FuzzedFile file("cases.csv");
    (void)CaseFile(file.path(), kOf);
    return text_in(file.path());
  }();
  return text;
}

void check_case(std::uint64_t number, const CaseOutcome& out, std::size_t cases) {
  hold(out.number == number && number < cases + kMaxThreads, "a case could have been run by a thread");
  hold(out.shifts >= 0 && out.shifts <= (out.refused.empty() ? kCaseShifts : 0), "a case has a valid number of shifts");
  hold(out.clean >= 0 && out.clean <= out.shifts && out.reached >= 0 && out.reached <= out.shifts,
       "of the shifts that were tried");
  hold(is_printable(out.refused), "an error message is printable");
}

std::string written(const CaseFile& cases, const std::filesystem::path& name) {
  {
    CaseFile file(name, kOf);
    for (const auto& [number, outcome] : cases.cases()) file.add(outcome);
  }
  return text_in(name);
}

// Ordered by number: a case that was far ahead of its line no longer is.
void check_kept(const CaseFile& cases) {
  const FuzzedFile first("first.csv"), second("second.csv");
  const std::string text = written(cases, first.path());
  hold(written(CaseFile(first.path(), kOf), second.path()) == text, "cases are written and read back the same");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer gives the name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static FuzzedFile file("cases.csv");
  const std::string_view bytes = text_of(data, size);
  const std::string text = bytes.starts_with('#') ? std::string(bytes) : head() + std::string(bytes);
  file.put(text);
  try {
    const CaseFile cases(file.path(), kOf);
    ++read_whole;
    for (const auto& [number, outcome] : cases.cases()) check_case(number, outcome, cases.cases().size());
    check_kept(cases);
  } catch (const std::runtime_error& refusal) {
    hold_sentence(refusal, file.path().string() + ":");
    hold(text_in(file.path()) == text, "a rejected file stays unchanged, byte for byte");
  }
  return 0;
}
