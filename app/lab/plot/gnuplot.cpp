#include "app/lab/plot/gnuplot.h"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <fmt/core.h>

#include "haptics/files/atomic_file.h"

namespace gearshift::lab {
namespace {

std::string script_of(const Figure& figure) {
  std::string script = "set encoding utf8\n";
  for (const std::string terminal : {"svg", "png"}) {
    const bool svg = terminal == "svg";
    script += fmt::format("set terminal {} size {},{} font \"DejaVu Sans,{}\" background \"#ffffff\"\n",
                          svg ? "svg" : "pngcairo", figure.width, figure.height, svg ? 12 : 10);
    script += fmt::format("set output \"{}.{}\"\n", figure.name, terminal);
    script += figure.commands + "unset output\nreset session\n";
  }
  return script;
}

// Blocks Ctrl-C and the other signals that end a program. This process is about to become gnuplot, which inherits the
// blocked signals. An interrupted gnuplot would leave an incomplete figure, and gnuplot finishes soon anyway.
void ignore_terminal_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
}

// Waits for gnuplot and returns its exit code, or 127 if it did not exit normally. `waiting` may throw to stop the
// program; the exception is rethrown only after gnuplot has ended.
int wait_for(pid_t child, const std::function<void()>& waiting) {
  int status = 0;
  pid_t ended = 0;
  try {
    while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
      waiting();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  } catch (...) {
    waitpid(child, &status, 0);
    throw;
  }
  return ended >= 0 && WIFEXITED(status) ? WEXITSTATUS(status) : 127;
}

// Runs gnuplot in the folder, so that no path has to be quoted. Returns its exit code, or 127 if it cannot be started.
int run_gnuplot(const std::filesystem::path& folder, const std::string& script, const std::function<void()>& waiting) {
  const std::string directory = folder.string();
  const pid_t child = fork();
  if (child == 0) {
    ignore_terminal_signals();
    setenv("LC_ALL", "C.UTF-8", 1);  // available everywhere; gnuplot needs UTF-8 for the degree sign
    setenv("TERM", "dumb", 1);       // known everywhere; gnuplot complains about a terminal that it does not know
    if (chdir(directory.c_str()) == 0) execlp("gnuplot", "gnuplot", script.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  return child < 0 ? 127 : wait_for(child, waiting);
}

}  // namespace

void draw_figure(const std::filesystem::path& folder, const Figure& figure, const std::function<void()>& waiting) {
  const std::string script = figure.name + ".gp";
  haptics::write_text_file(folder / script, script_of(figure));
  const int code = run_gnuplot(folder, script, waiting);
  if (code == 127) throw std::runtime_error("gnuplot cannot be started; install the package gnuplot-nox");
  if (code != 0)
    throw std::runtime_error(fmt::format("{}: gnuplot failed (exit code {})", (folder / script).string(), code));
}

}  // namespace gearshift::lab
