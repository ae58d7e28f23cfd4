// Whatever stands where the bench's last run was kept: it is read, or told in one sentence and kept aside; what is read is
// kept again and read back the same.
#include "app/bench/last_run.h"
#include "tests/fuzz/fuzz_laws.h"

using namespace gearshift;

namespace {

bool same(const LastFigure& a, const LastFigure& b) {
  return a.value == b.value && a.spread.has_value() == b.spread.has_value() &&
         (!a.spread || (a.spread->low == b.spread->low && a.spread->high == b.spread->high));
}

bool same(const LastRun& a, const LastRun& b) {
  const auto families = [](const auto& left, const auto& right) {
    return left.first == right.first && left.second.date == right.second.date &&
           left.second.program == right.second.program && left.second.taken == right.second.taken &&
           std::equal(left.second.figures.begin(), left.second.figures.end(), right.second.figures.begin(),
                      right.second.figures.end(),
                      [](const auto& x, const auto& y) { return x.first == y.first && same(x.second, y.second); });
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), families);
}

// What nobody can read is not lost: somebody may want to look at it.
void hold_aside(const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::path aside = file;
  aside += ".unreadable";
  std::ifstream in(aside, std::ios::binary);
  const std::string kept{std::istreambuf_iterator<char>(in), {}};
  hold(in && kept == bytes && !std::filesystem::exists(file), "what cannot be read is kept aside, byte for byte");
  std::filesystem::remove(aside);
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer gives the name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static FuzzedFile file("machine.json");
  int told = 0;
  const auto tell = [&told](const std::string& problem) {
    hold_sentence(std::runtime_error(problem), file.path().string() + ":");
    ++told;
  };
  const LastRun last = read_last_run(file.put(text_of(data, size)), tell);
  hold(told <= 1 && (told == 0 || last.empty()), "what cannot be read is told once");
  if (told > 0) return hold_aside(file.path(), text_of(data, size)), 0;
  ++read_whole;
  keep_run(file.path(), last, {});
  hold(same(read_last_run(file.path(), tell), last) && told == 0, "a run is kept and read back the same");
  return 0;
}
