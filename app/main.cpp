// gearshift: one program, plain verbs.
#include <csignal>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/verbs/verbs.h"
#include "app/version/version_text.h"
#include "haptics/files/printable.h"

namespace {

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

int run(int argc, char** argv) {
  CLI::App app{"gearshift: a trainer for manual shifting"};
  app.set_version_flag("--version", gearshift::version_text());
  try {
    const gearshift::VerbAction action = gearshift::parse_command_line(app, argc, argv);
    return action();
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "gearshift: {}\n", gearshift::usage_sentence(error));
    return kBadUsage;
  }
}

// What was printed has arrived: a script must not take a cut table for a whole one.
int with_output(int code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  fmt::print(stderr, "gearshift: standard output cannot be written\n");
  return code == 0 ? kFailed : code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file as long as it may be is told by who writes it, as a full disk is
  try {
    return with_output(run(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "gearshift: {}\n", gearshift::printable(error.what()));
    return kFailed;
  }
}
