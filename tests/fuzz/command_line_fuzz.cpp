// Fuzzes the command line, with one argument per line of input. The arguments must be parsed, or be rejected in one
// sentence. No verb runs. Texts that a verb parses only when it runs (a hand, a size, a camera) are parsed from every
// line. The first line also becomes the value of the environment variables that locate the user's folders.
#include <stdlib.h>

#include <cmath>
#include <vector>

#include "app/base/user_folders.h"
#include "app/demo/render_file.h"
#include "app/verbs/picture_size.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/verbs.h"
#include "tests/fuzz/fuzz_checks.h"

using namespace gearshift::base;
using namespace gearshift::demo;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::verbs;

namespace {

constexpr std::size_t kMaxArguments = 64;

// Splits the text into lines and drops zero bytes, which an argument cannot contain.
std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else if (c != '\0') {
      lines.back() += c;
    }
  }
  if (lines.size() > kMaxArguments) lines.resize(kMaxArguments);
  return lines;
}

void check_folders(const std::string& value) {
  for (const char* variable : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "HOME"}) {
    setenv(variable, value.c_str(), 1);
    for (const auto& folder : {user_config_folder(), user_data_folder(), user_presets_folder()}) {
      check_invariant(folder.is_absolute(), "a user's folder does not depend on where the program was started");
    }
  }
}

void check_arguments(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  CLI::App app{"gearshift"};
  app.set_version_flag("--version", "1.2.3");
  try {
    const VerbAction action = parse_command_line(app, static_cast<int>(argv.size()), argv.data());
    check_invariant(static_cast<bool>(action), "accepted arguments are valid");
  } catch (const CLI::Success&) {
    check_invariant(!app.help().empty(), "help is printed");
  } catch (const CLI::ParseError& refusal) {
    check_sentence(std::runtime_error(usage_sentence(refusal)), "");
  }
}

// Calls `read`, which throws CLI::ValidationError for invalid input.
template <class Read>
void check_text(const Read& read) {
  try {
    read();
  } catch (const CLI::ValidationError& refusal) {
    check_sentence(std::runtime_error(usage_sentence(refusal)), "");
  }
}

void check_hand(const std::string& text) {
  const HandImpedance hand = driving_hand(text);
  check_invariant(std::isfinite(hand.mass) && std::isfinite(hand.damping) && std::isfinite(hand.stiffness) &&
                      hand.mass >= 0.0 && hand.damping >= 0.0 && hand.stiffness > 0.0,
                  "a hand that leads the lever is one");
}

void check_size(const std::string& text, bool stereo) {
  const PictureSize size = picture_size(text, stereo);
  for (const int side : {size.width, size.height})
    check_invariant(side >= kMinPictureSide && side <= kMaxPictureSide, "a picture has a valid size");
  check_invariant(!stereo || size.width % 2 == 0, "two eyes have the same integer width");
}

void check_camera_text(const std::string& text) {
  try {
    check_camera(text);
  } catch (const std::invalid_argument& refusal) {  // the verb converts this exception in the same way
    throw CLI::ValidationError(refusal.what());
  }
}

void check_texts(const std::string& line) {
  check_text([&] { check_hand(line); });
  check_text([&] { check_size(line, false); });
  check_text([&] { check_size(line, true); });
  check_text([&] { check_camera_text(line); });
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> lines = lines_of(text_of(data, size));
  check_folders(lines[0]);
  for (const std::string& line : lines) check_texts(line);
  lines[0] = "gearshift";
  check_arguments(lines);
  return 0;
}
