// gearshift: one program, plain verbs.
#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "app/print_out.h"
#include "app/verbs/verbs.h"
#include "app/version/version_text.h"
#include "haptics/files/printable.h"

namespace {

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

// The number of a standard stream that is closed would go to the first file that is opened, and what is said into that
// file. Nothing can be written to what stands there now: it is told as a full disk is.
void hold_standard_streams() {
  for (const int stream : {0, 1, 2})
    if (fcntl(stream, F_GETFD) == -1) open("/dev/null", O_RDONLY);  // the lowest free number: this one
}

// A fault of a file or of a reader is told by who writes, and ends nothing.
void ignore_signals_of_files() {
  std::signal(SIGXFSZ, SIG_IGN);  // a file as long as it may be
  std::signal(SIGPIPE, SIG_IGN);  // nobody reads any more
}

int run(int argc, char** argv) {
  CLI::App app{"gearshift: a trainer for manual shifting"};
  app.set_version_flag("--version", gearshift::version_text());
  try {
    const gearshift::VerbAction action = gearshift::parse_command_line(app, argc, argv);
    return action();
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    gearshift::print_problem("{}", gearshift::usage_sentence(error));
    return kBadUsage;
  }
}

// What was printed has arrived: a script must not take a cut table for a whole one.
int with_output(int code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  gearshift::print_problem("standard output cannot be written");
  return code == 0 ? kFailed : code;
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  ignore_signals_of_files();
  try {
    return with_output(run(argc, argv));
  } catch (const std::exception& error) {
    gearshift::print_problem("{}", gearshift::printable(error.what()));
    return kFailed;
  }
}
