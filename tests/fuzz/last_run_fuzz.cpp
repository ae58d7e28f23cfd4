// Fuzzes the file with the bench's last run. The file must be read, or be rejected in one sentence and set aside.
// Results that were read must be the same after saving and reading them again.
#include "app/lab/bench/last_run.h"
#include "tests/fuzz/fuzz_checks.h"

using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

bool same(const LastFigure& a, const LastFigure& b) {
  return a.value == b.value && a.spread.has_value() == b.spread.has_value() &&
         (!a.spread || (a.spread->low == b.spread->low && a.spread->high == b.spread->high));
}

bool same(const LastRun& a, const LastRun& b) {
  const auto families = [](const auto& left, const auto& right) {
    return left.first == right.first && left.second.date == right.second.date &&
           left.second.program == right.second.program && left.second.contention == right.second.contention &&
           std::equal(left.second.figures.begin(), left.second.figures.end(), right.second.figures.begin(),
                      right.second.figures.end(),
                      [](const auto& x, const auto& y) { return x.first == y.first && same(x.second, y.second); });
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), families);
}

// Checks that an unreadable file was renamed and not changed, because the user may want to look at it.
void check_set_aside(const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::path aside = file;
  aside += ".unreadable";
  std::ifstream in(aside, std::ios::binary);
  const std::string saved{std::istreambuf_iterator<char>(in), {}};
  check_invariant(in && saved == bytes && !std::filesystem::exists(file),
                  "an unreadable file is set aside, byte for byte");
  std::filesystem::remove(aside);
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static FuzzedFile file("machine.json");
  int warnings = 0;
  const auto report = [&warnings](const std::string& problem) {
    check_sentence(std::runtime_error(problem), file.path().string() + ":");
    ++warnings;
  };
  const LastRun last = read_last_run(file.put(text_of(data, size)), report);
  check_invariant(warnings <= 1 && (warnings == 0 || last.empty()), "an unreadable file is reported once");
  if (warnings > 0) return check_set_aside(file.path(), text_of(data, size)), 0;
  ++accepted_inputs;
  save_run(file.path(), last, {});
  check_invariant(same(read_last_run(file.path(), report), last) && warnings == 0,
                  "a run is saved and read back the same");
  return 0;
}
