// The results of the last full run are saved, loaded again, and compared with a tolerance for noise.
#include "app/lab/bench/last_run.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "tests/app/lab/bench/constructed_run.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using doctest::Approx;

namespace {

namespace fs = std::filesystem;

void fail_on_warning(const std::string& problem) {
  FAIL(problem);
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

BenchRow timed_row(double value, double low, double high) {
  BenchRow row = plain_row("walk", "timed", value);
  row.spread = Quartiles{low, high};
  return row;
}

SinceLast since(const BenchRow& then, const BenchRow& now) {
  const TempFolder folder;
  save_run(folder / "last.json", {}, make_run({then}));
  const auto found = since_last(read_last_run(folder / "last.json", fail_on_warning), now);
  REQUIRE(found);
  return *found;
}

}  // namespace

TEST_CASE("the first run has nothing to compare with") {
  const TempFolder folder;
  CHECK(read_last_run(folder / "none.json", fail_on_warning).empty());
  CHECK_FALSE(since_last({}, plain_row("walk", "a", 1.0)));
}

TEST_CASE("the next run shows the program of the last run, and how much CPU time others used during it") {
  const TempFolder folder;
  const BenchRow row = plain_row("walk", "a", 1.0);
  BenchRun run = make_run({row});
  run.contention = CpuContention{0.25, 0.5};
  save_run(folder / "last.json", {}, run);
  const auto found = since_last(read_last_run(folder / "last.json", fail_on_warning), row);
  REQUIRE(found);
  CHECK(found->program == "gearshift 9.9");
  CHECK(found->contention == "25 % by the host, 50 % by other programs");
}

TEST_CASE("the next run has the ratio to the last and its date") {
  const SinceLast found = since(plain_row("walk", "a", 4.0), plain_row("walk", "a", 3.0));
  CHECK(found.value == 4.0);
  CHECK(found.ratio == Approx(0.75));
  CHECK(found.date == "2026-01-02T03:04:05Z");
  CHECK(found.changed);
}

TEST_CASE("a value has changed if the quartiles do not overlap, or without quartiles if it prints differently") {
  CHECK_FALSE(since(timed_row(100, 90, 110), timed_row(115, 108, 130)).changed);
  CHECK(since(timed_row(100, 90, 110), timed_row(125, 111, 130)).changed);
  CHECK(since(timed_row(100, 90, 110), timed_row(80, 70, 89)).changed);
  CHECK_FALSE(since(plain_row("walk", "a", 1.00001), plain_row("walk", "a", 1.00002)).changed);
  CHECK(since(plain_row("walk", "a", 1.001), plain_row("walk", "a", 1.002)).changed);
}

TEST_CASE("from zero to something there is no ratio, from zero to zero there is no change") {
  const SinceLast grown = since(plain_row("walk", "a", 0.0), plain_row("walk", "a", 2.0));
  CHECK_FALSE(std::isfinite(grown.ratio));
  CHECK(grown.changed);
  CHECK(format_change(grown) == "was 0 *");
  const SinceLast same = since(plain_row("walk", "a", 0.0), plain_row("walk", "a", 0.0));
  CHECK(same.ratio == 1.0);
  CHECK_FALSE(same.changed);
}

TEST_CASE("a method's cost is compared separately: the same error, for twice the time") {
  const TempFolder folder;
  const fs::path file = folder / "last.json";
  save_run(file, {}, make_run({trade_row("a", 10.0, 1.0), plain_row("walk", "b", 1.0)}));
  BenchRun next = make_run({trade_row("a", 20.0, 1.0), plain_row("walk", "b", 1.0)});
  compare(next, read_last_run(file, fail_on_warning));
  CHECK_FALSE(next.rows[0].since->changed);
  REQUIRE(next.rows[0].cost_since);
  CHECK(next.rows[0].cost_since->changed);
  CHECK(format_change(next.rows[0]) == "1 x, cost 2 x *");
  CHECK_FALSE(next.rows[1].cost_since);
}

TEST_CASE("a run of some families keeps the results of the others") {
  const TempFolder folder;
  const fs::path file = folder / "deep" / "last.json";
  save_run(file, {},
           make_run({plain_row("walk", "a", 1.0), plain_row("swim", "a", 2.0), plain_row("walk", "gone", 3.0)}));
  BenchRow not_measured = plain_row("swim", "a", 9.0);
  not_measured.measured = false;
  save_run(file, read_last_run(file, fail_on_warning), make_run({plain_row("walk", "a", 5.0), not_measured}));
  const LastRun last = read_last_run(file, fail_on_warning);
  CHECK(since_last(last, plain_row("walk", "a", 5.0))->value == 5.0);
  CHECK(since_last(last, plain_row("swim", "a", 2.0))->value == 2.0);
  CHECK_FALSE(since_last(last, plain_row("walk", "gone", 3.0)));
  CHECK_FALSE(since_last(last, not_measured));
}

TEST_CASE("an unreadable file is reported in one sentence and set aside, and the next run can save its results") {
  for (const char* text :
       {"", "no JSON", "[]", "{\"families\": 3}", "{\"families\": {\"walk\": {\"date\": 1}}}",
        "{\"families\": {\"walk\": {\"date\": \"d\", \"figures\": {\"a\": {\"value\": null}}}}}",
        "{\"families\": {\"walk\": {\"date\": \"x\\u0001\\u001b[31m\", \"figures\": {}}}}",
        "{\"families\": {\"walk\": {\"date\": \"2026-01-02T03:04:05Z\\uffff\", \"figures\": {}}}}"}) {
    CAPTURE(text);
    const TempFolder folder;
    const fs::path file = folder / "last.json";
    std::ofstream(file) << text;
    std::vector<std::string> warnings;
    CHECK(read_last_run(file, [&](const std::string& problem) { warnings.push_back(problem); }).empty());
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find(file.string()) == 0);
    CHECK(warnings[0].find('\n') == std::string::npos);
    CHECK(text_of(folder / "last.json.unreadable") == text);
    save_run(file, {}, make_run({plain_row("walk", "a", 1.0)}));
    CHECK(read_last_run(file, fail_on_warning).size() == 1);
  }
}

TEST_CASE("other unusable files are set aside, too: one too large, a link to a pipe, a folder, a dangling link") {
  const auto make_large_file = [](const fs::path& file) { std::ofstream(file) << std::string(2'700'000, ' '); };
  const auto make_pipe_link = [](const fs::path& file) {
    REQUIRE(mkfifo((file.parent_path() / "pipe").c_str(), 0600) == 0);
    fs::create_symlink("pipe", file);
  };
  const auto make_folder = [](const fs::path& file) { fs::create_directories(file / "with"); };
  const auto make_dangling_link = [](const fs::path& file) { fs::create_symlink("nothing", file); };
  for (const std::function<void(const fs::path&)>& make : std::vector<std::function<void(const fs::path&)>>{
           make_large_file, make_pipe_link, make_folder, make_dangling_link}) {
    const TempFolder folder;
    const fs::path file = folder / "last.json";
    make(file);
    const fs::file_type kind = fs::symlink_status(file).type();
    std::vector<std::string> warnings;
    CHECK(read_last_run(file, [&](const std::string& problem) { warnings.push_back(problem); }).empty());
    REQUIRE(warnings.size() == 1);
    CAPTURE(warnings[0]);
    CHECK(warnings[0].find((folder / "last.json.unreadable").string()) != std::string::npos);
    CHECK(fs::symlink_status(folder / "last.json.unreadable").type() == kind);
    save_run(file, {}, make_run({plain_row("walk", "a", 1.0)}));
    CHECK(read_last_run(file, fail_on_warning).size() == 1);
  }
}

TEST_CASE("a second unreadable file does not overwrite the first one set aside") {
  const TempFolder folder;
  for (const char* text : {"first", "second", "third"}) {
    std::ofstream(folder / "last.json") << text;
    read_last_run(folder / "last.json", [](const std::string&) {});
  }
  CHECK(text_of(folder / "last.json.unreadable") == "first");
  CHECK(text_of(folder / "last.json.unreadable2") == "second");
  CHECK(text_of(folder / "last.json.unreadable3") == "third");
}

TEST_CASE("an infinite spread is dropped, and the file stays readable") {
  const SinceLast found = since(timed_row(1.0, 0.5, INFINITY), plain_row("walk", "timed", 1.0));
  CHECK(found.ratio == 1.0);
}

TEST_CASE("if nothing can be written, that is reported, and the old file stays") {
  const TempFolder folder;
  std::ofstream(folder / "a file") << "x";
  CHECK_THROWS_AS(save_run(folder / "a file" / "bench" / "last.json", {}, make_run({plain_row("walk", "a", 1.0)})),
                  FileError);
  CHECK(text_of(folder / "a file") == "x");
  if (geteuid() == 0) return;  // root may write to read-only folders, so the rest cannot be tested
  const fs::path file = folder / "shut" / "last.json";
  save_run(file, {}, make_run({plain_row("walk", "a", 1.0)}));
  REQUIRE(chmod(file.parent_path().c_str(), 0500) == 0);
  CHECK_THROWS_AS(save_run(file, {}, make_run({plain_row("walk", "a", 2.0)})), FileError);
  REQUIRE(chmod(file.parent_path().c_str(), 0700) == 0);
  CHECK(since_last(read_last_run(file, fail_on_warning), plain_row("walk", "a", 1.0))->value == 1.0);
}

TEST_CASE("another processor, core count, GPU, host, build or compiler is another machine; another kernel is not") {
  const Machine machine = make_run({}).machine;
  const std::string key = machine_key(machine);
  CHECK(key.size() == 16);
  CHECK(key.find_first_not_of("0123456789abcdef") == std::string::npos);
  for (std::string Machine::*part :
       {&Machine::cpu, &Machine::gpu, &Machine::host, &Machine::build, &Machine::compiler}) {
    Machine other = machine;
    other.*part += "x";
    CHECK(machine_key(other) != key);
  }
  Machine more = machine;
  more.cores = 3;
  CHECK(machine_key(more) != key);
  Machine same = machine;
  same.system += "x";
  CHECK(machine_key(same) == key);
}

TEST_CASE("the processor's model as reported by the kernel") {
  CHECK(cpu_model("processor\t: 0\nmodel name\t: Abacus 3000 @ 1 Hz\nflags\t: fpu\nmodel name\t: other\n") ==
        "Abacus 3000 @ 1 Hz");
  CHECK(cpu_model("processor\t: 0\nCPU part\t: 0xd0c\n") == "unknown");
  CHECK(cpu_model("") == "unknown");
  CHECK(cpu_model("model name\t: last") == "last");
}
