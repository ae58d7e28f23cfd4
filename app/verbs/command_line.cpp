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

std::string verb_names(const CLI::App& app) {
  std::string names;
  for (const CLI::App* verb : app.get_subcommands({})) names += (names.empty() ? "" : ", ") + verb->get_name();
  return names;
}

void refuse_unknown_verb(const CLI::App& app, const std::string& word) {
  const bool is_option = !word.empty() && word.front() == '-';
  const auto is_it = [&](const CLI::App* verb) { return verb->get_name() == word; };
  if (is_option || !app.get_subcommands(is_it).empty()) return;
  throw CLI::ParseError("no such verb: \"" + word + "\"; there are " + verb_names(app), CLI::ExitCodes::ExtrasError);
}

// A shell's variable that nobody set: what would be written goes elsewhere, or nowhere.
void refuse_unnamed_files(const CLI::App& verb) {
  const auto is_file = [](const std::string& type) {
    const std::string kind = type.substr(0, type.find(':'));  // before what its checks add
    return kind == "FILE" || kind == "DIR" || kind == "FOLDER" || kind == "PNG" || kind == "TRACE";
  };
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& value : option->results())
      if (value.empty() && is_file(option->get_type_name())) throw CLI::ValidationError(option->get_name(), "is empty");
  }
}

}  // namespace

VerbAction parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  app.require_subcommand(0, 1);  // an unknown verb shall be named, so that none is refused below
  VerbAction action;
  add_verbs(app, action);
  if (argc < 2) {
    app.parse("train");
  } else {
    refuse_unknown_verb(app, argv[1]);
    app.parse(argc, argv);
    for (const CLI::App* verb : app.get_subcommands()) refuse_unnamed_files(*verb);
  }
  if (!action) throw CLI::RequiredError("A verb of " + verb_names(app) + " (see --help)");
  return action;
}

std::string usage_sentence(const CLI::ParseError& refusal) {
  return printable(refusal.what());
}

}  // namespace gearshift
