#include "app/verbs/verbs.h"
#include "haptics/files/printable.h"

namespace gearshift::verbs {
namespace {

void add_verbs(CLI::App& app, VerbAction& action) {
  add_train_verb(app, action);
  add_demo_verb(app, action);
  add_lesson_verb(app, action);
  add_drive_verb(app, action);
  add_tour_verb(app, action);
  add_shifter_verb(app, action);
  add_render_verb(app, action);
  add_gate_verb(app, action);
  add_identify_verb(app, action);
  add_stability_verb(app, action);
  add_contact_verb(app, action);
  add_reproduce_verb(app, action);
  add_replay_verb(app, action);
  add_report_verb(app, action);
  add_school_verb(app, action);
  add_parameters_verb(app, action);
  add_devices_verb(app, action);
  add_campaign_verb(app, action);
  add_bench_verb(app, action);
  for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; })) verb->group("Verbs");
  app.get_formatter()->label("SUBCOMMAND", "VERB");
}

std::string verb_names(const CLI::App& app) {
  std::string names;
  for (const CLI::App* verb : app.get_subcommands({})) names += (names.empty() ? "" : ", ") + verb->get_name();
  return names;
}

void reject_unknown_verb(const CLI::App& app, const std::string& word) {
  const bool is_option = !word.empty() && word.front() == '-';
  const auto is_it = [&](const CLI::App* verb) { return verb->get_name() == word; };
  if (is_option || !app.get_subcommands(is_it).empty()) return;
  throw CLI::ParseError("unknown verb \"" + word + "\"; the verbs are " + verb_names(app), CLI::ExitCodes::ExtrasError);
}

// Rejects empty paths, which usually come from an unset shell variable. With an empty path, the output would go to the
// wrong place or be lost.
void reject_empty_paths(const CLI::App& verb) {
  const auto is_file = [](const std::string& type) {
    const std::string kind = type.substr(0, type.find(':'));  // validators append ":..." to the type name
    return kind == "FILE" || kind == "DIR" || kind == "FOLDER" || kind == "PNG" || kind == "TRACE";
  };
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& value : option->results())
      if (value.empty() && is_file(option->get_type_name()))
        throw CLI::ValidationError(option->get_name(), "the path must not be empty");
  }
}

}  // namespace

VerbAction parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  app.require_subcommand(0, 1);  // no verb is required here, because our own error message below is better than CLI11's
  VerbAction action;
  add_verbs(app, action);
  if (argc < 2) {
    app.parse("train");
  } else {
    reject_unknown_verb(app, argv[1]);
    app.parse(argc, argv);
    for (const CLI::App* verb : app.get_subcommands()) reject_empty_paths(*verb);
  }
  if (!action) throw CLI::RequiredError("A verb (" + verb_names(app) + "; see --help)");
  return action;
}

std::string usage_sentence(const CLI::ParseError& refusal) {
  return haptics::printable(refusal.what());
}

}  // namespace gearshift::verbs
