// gearshift render: any glTF file as a picture, mono or stereo.
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/print_out.h"
#include "app/render/render_file.h"
#include "app/verbs/number_between.h"
#include "app/verbs/picture_size.h"
#include "app/verbs/two_files.h"
#include "app/verbs/verbs.h"

namespace gearshift {
namespace {

struct RenderArguments {
  std::string file, out, size = "1280x720", camera = "fit";
  int samples = 4;
  std::optional<double> fov;  // [deg]
  bool stereo = false;
};

RenderFileSetup make_setup(const RenderArguments& arguments) {
  try {
    check_camera(arguments.camera);
  } catch (const std::invalid_argument& refused) {
    throw CLI::ValidationError(refused.what());
  }
  RenderFileSetup setup;
  setup.file = arguments.file;
  setup.out = arguments.out;
  setup.camera = arguments.camera;
  const PictureSize size = picture_size(arguments.size, arguments.stereo);
  setup.view.width = size.width;
  setup.view.height = size.height;
  setup.view.samples = arguments.samples;
  setup.view.stereo = arguments.stereo;
  setup.field = arguments.fov;
  return setup;
}

int run_render(const RenderArguments& arguments) {
  check_two_files("--out", "the picture and what it is of", arguments.out, arguments.file);
  const RenderFileSetup setup = make_setup(arguments);
  const RenderFileResult result = render_file(setup);
  for (const std::string& skipped : result.skipped) print_problem("not drawn: {}", skipped);
  print_out("{}: {} triangles in {} draws, read in {:.0f} ms, drawn {:.0f} ms after the start on {}\n",
            setup.out.string(), result.triangles, result.draws, result.load_ms, result.first_frame_ms, result.device);
  return 0;
}

}  // namespace

void add_render_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* verb = app.add_subcommand("render", "Any glTF file as a picture, mono or stereo");
  verb->footer(
      "Examples:\n"
      "  gearshift render FILE --out PNG\n"
      "  gearshift render FILE --stereo --out PNG\n");
  verb->add_option("file", arguments->file, "glTF 2.0 file, .gltf or .glb")->type_name("FILE")->required();
  verb->add_option("--out", arguments->out, "the picture")->type_name("PNG")->required();
  verb->add_option("--size", arguments->size, "of the picture [px]")->type_name("WxH")->capture_default_str();
  verb->add_option("--samples", arguments->samples, "a pixel: 1 or 4")
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  verb->add_option("--camera", arguments->camera,
                   "fit, driver, ahead, lever, gate, cluster, gearbox, or X,Y,Z:X,Y,Z: an eye and what it looks at [m]")
      ->capture_default_str();
  verb->add_option("--fov", arguments->fov,
                   "field of view across the shorter side [deg]: 58, or the named camera's own")
      ->check(number_between(5.0, 150.0));
  verb->add_flag("--stereo", arguments->stereo, "both eyes, side by side");
  verb->callback([arguments, &action] { action = [arguments] { return run_render(*arguments); }; });
}

}  // namespace gearshift
