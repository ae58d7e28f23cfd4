// gearshift: one program, plain verbs.
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/verbs/verbs.h"
#include "app/version/version_text.h"

namespace {

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

int run(int argc, char** argv) {
  CLI::App app{"gearshift: a trainer for manual shifting"};
  app.set_version_flag("--version", gearshift::version_text());
  app.require_subcommand(0, 1);  // an unknown verb shall be named, so that none is refused below

  gearshift::VerbAction action;
  gearshift::add_train_verb(app, action);
  gearshift::add_demo_verb(app, action);
  gearshift::add_lesson_verb(app, action);
  gearshift::add_tour_verb(app, action);
  gearshift::add_render_verb(app, action);
  gearshift::add_gate_verb(app, action);
  gearshift::add_identify_verb(app, action);
  gearshift::add_stability_verb(app, action);
  gearshift::add_reproduce_verb(app, action);
  gearshift::add_replay_verb(app, action);
  gearshift::add_report_verb(app, action);
  gearshift::add_devices_verb(app, action);
  gearshift::add_campaign_verb(app, action);
  gearshift::add_bench_verb(app, action);

  try {
    if (argc == 1) {
      app.parse("train");
    } else {
      app.parse(argc, argv);
    }
    if (!action)
      throw CLI::RequiredError(
          "A subcommand: train, demo, lesson, tour, render, gate, identify, stability, reproduce, replay, report, "
          "devices, campaign or bench (see --help)");
    return action();
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "gearshift: {}\n", error.what());
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
  try {
    return with_output(run(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "gearshift: {}\n", error.what());
    return kFailed;
  }
}
