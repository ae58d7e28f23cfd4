#include "app/verbs/verbs.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

void add_verbs(CLI::App& app, VerbAction& action) {
  add_train_verb(app, action);
  add_demo_verb(app, action);
  add_lesson_verb(app, action);
  add_tour_verb(app, action);
  add_render_verb(app, action);
  add_gate_verb(app, action);
  add_identify_verb(app, action);
  add_stability_verb(app, action);
  add_reproduce_verb(app, action);
  add_replay_verb(app, action);
  add_report_verb(app, action);
  add_devices_verb(app, action);
  add_campaign_verb(app, action);
  add_bench_verb(app, action);
}

}  // namespace

VerbAction parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  app.require_subcommand(0, 1);  // an unknown verb shall be named, so that none is refused below
  VerbAction action;
  add_verbs(app, action);
  if (argc == 1) {
    app.parse("train");
  } else {
    app.parse(argc, argv);
  }
  if (!action)
    throw CLI::RequiredError(
        "A subcommand: train, demo, lesson, tour, render, gate, identify, stability, reproduce, replay, report, "
        "devices, campaign or bench (see --help)");
  return action;
}

std::string usage_sentence(const CLI::ParseError& refusal) {
  return printable(refusal.what());
}

}  // namespace gearshift
