// Entry point of the gearshift program: parses the command line and runs the chosen subcommand.
#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "app/base/console.h"
#include "app/verbs/verbs.h"
#include "app/verbs/version_text.h"
#include "haptics/files/printable.h"

namespace {

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

// If stdin, stdout or stderr is closed, the next file opened would reuse its descriptor and receive our output. So
// /dev/null is opened in its place, read-only: output to it then fails and is reported, just as if the disk were full.
void reserve_standard_streams() {
  for (const int stream : {0, 1, 2})
    if (fcntl(stream, F_GETFD) == -1) open("/dev/null", O_RDONLY);  // open() returns the lowest free descriptor
}

// Ignores the signals that a failing write raises. The write then returns an error instead of ending the program, and
// the caller of the write reports the error.
void ignore_write_signals() {
  std::signal(SIGXFSZ, SIG_IGN);  // raised when a file reaches the size limit
  std::signal(SIGPIPE, SIG_IGN);  // raised when the reader has closed the pipe
}

int run(int argc, char** argv) {
  CLI::App app{"gearshift: a trainer for manual shifting"};
  app.set_version_flag("--version", gearshift::verbs::version_text());
  try {
    const gearshift::verbs::VerbAction action = gearshift::verbs::parse_command_line(app, argc, argv);
    return action();
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    gearshift::base::print_message("{}", gearshift::verbs::usage_sentence(error));
    return kBadUsage;
  }
}

// Turns an exit code of success into failure if not all output could be written, so that a script does not mistake a
// truncated table for a complete one.
int check_output(int code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  gearshift::base::print_message("cannot write to standard output");
  return code == 0 ? kFailed : code;
}

}  // namespace

int main(int argc, char** argv) {
  reserve_standard_streams();
  ignore_write_signals();
  try {
    return check_output(run(argc, argv));
  } catch (const std::exception& error) {
    gearshift::base::print_message("{}", gearshift::haptics::printable(error.what()));
    return kFailed;
  }
}
