// Fuzzes `cases.csv`, the results file of a campaign. If the file is rejected, the error message must be one sentence,
// and the file must stay unchanged. If it is accepted, its cases must be the same after they are written and read back.
#include <string>

#include "app/lab/campaign/case_file.h"
#include "tests/fuzz/fuzz_checks.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

constexpr const char* kCampaignName = "one campaign";

std::string text_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The header that a campaign writes first. Inputs without a header get this one, because nearly all of them would be
// rejected otherwise.
const std::string& head() {
  static const std::string text = [] {
    const FuzzedFile file("cases.csv");
    (void)CaseFile(file.path(), kCampaignName);
    return text_in(file.path());
  }();
  return text;
}

void check_case(std::uint64_t number, const CaseOutcome& out, std::size_t cases) {
  check_invariant(out.number == number && number < cases + kMaxThreads, "a case could have been run by a thread");
  check_invariant(out.shifts >= 0 && out.shifts <= (out.refused.empty() ? kCaseShifts : 0),
                  "a case has a valid number of shifts");
  check_invariant(out.clean >= 0 && out.clean <= out.shifts && out.reached >= 0 && out.reached <= out.shifts,
                  "of the shifts that were tried");
  check_invariant(is_printable(out.refused), "an error message is printable");
}

std::string rewritten_text(const CaseFile& cases, const std::filesystem::path& name) {
  {
    CaseFile file(name, kCampaignName);
    for (const auto& [number, outcome] : cases.cases()) file.add(outcome);
  }
  return text_in(name);
}

// Compares two rewritten files. The original may differ from them, because rewriting sorts the cases by number.
void check_round_trip(const CaseFile& cases) {
  const FuzzedFile first("first.csv"), second("second.csv");
  const std::string text = rewritten_text(cases, first.path());
  check_invariant(rewritten_text(CaseFile(first.path(), kCampaignName), second.path()) == text,
                  "cases are written and read back the same");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static FuzzedFile file("cases.csv");
  const std::string_view bytes = text_of(data, size);
  const std::string text = bytes.starts_with('#') ? std::string(bytes) : head() + std::string(bytes);
  file.put(text);
  try {
    const CaseFile cases(file.path(), kCampaignName);
    ++accepted_inputs;
    for (const auto& [number, outcome] : cases.cases()) check_case(number, outcome, cases.cases().size());
    check_round_trip(cases);
  } catch (const std::runtime_error& refusal) {
    check_sentence(refusal, file.path().string() + ":");
    check_invariant(text_in(file.path()) == text, "a rejected file stays unchanged, byte for byte");
  }
  return 0;
}
