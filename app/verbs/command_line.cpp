#include <algorithm>
#include <string_view>
#include <vector>

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

// Number of letters to insert, delete, replace or swap with their neighbour that turn one word into the other.
std::size_t typing_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

// "; did you mean tour?" if one of the names is near the word, otherwise empty.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  constexpr std::size_t kMaxWord = 40, kMaxTypos = 2;  // in longer words than the first nobody mistypes a name
  const std::size_t allowed = std::min(kMaxTypos, (word.size() + 1) / 3);
  std::string best;
  std::size_t least = allowed + 1;
  for (const std::string& name : names) {
    const std::size_t typos = word.size() > kMaxWord ? least : typing_distance(word, name);
    if (typos >= least) continue;
    least = typos;
    best = name;
  }
  return best.empty() ? std::string() : "; did you mean " + best + "?";
}

std::vector<std::string> option_names(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// `gearshift help` is `gearshift --help`, and `gearshift help VERB` is `gearshift VERB --help`.
std::vector<std::string> words_of(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.front() != "help") return words;
  words.erase(words.begin());
  if (words.size() > 1) throw CLI::ParseError("help takes one verb", CLI::ExitCodes::ExtrasError);
  words.emplace_back("--help");
  return words;
}

void reject_unknown_verb(const CLI::App& app, const std::string& word) {
  const bool is_option = !word.empty() && word.front() == '-';
  const auto is_it = [&](const CLI::App* verb) { return verb->get_name() == word; };
  if (is_option || !app.get_subcommands(is_it).empty()) return;
  std::vector<std::string> names{"help"};
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  const std::string guess = did_you_mean(word, names);
  throw CLI::ParseError(
      "unknown verb \"" + word + "\"" + (guess.empty() ? "; the verbs are " + verb_names(app) : guess),
      CLI::ExitCodes::ExtrasError);
}

// CLI11 names unknown options only; adds the option that was meant, if one is near.
void parse(CLI::App& app, std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  try {
    app.parse(std::move(words));
  } catch (const CLI::ExtrasError& unknown) {
    for (const CLI::App* verb : app.get_subcommands())
      for (const std::string& word : verb->remaining())
        if (const std::string guess = did_you_mean(word, option_names(*verb)); word.starts_with("--") && !guess.empty())
          throw CLI::ParseError("unknown option \"" + word + "\"" + guess, CLI::ExitCodes::ExtrasError);
    throw;
  }
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
    const std::vector<std::string> words = words_of(argc, argv);
    reject_unknown_verb(app, words.front());
    app.name(argv[0]);
    parse(app, words);
    for (const CLI::App* verb : app.get_subcommands()) reject_empty_paths(*verb);
  }
  if (!action) throw CLI::RequiredError("A verb (" + verb_names(app) + "; see --help)");
  return action;
}

std::string usage_sentence(const CLI::ParseError& refusal) {
  return haptics::printable(refusal.what());
}

}  // namespace gearshift::verbs
