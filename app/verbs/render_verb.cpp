// gearshift render: renders any glTF file to a picture, mono or stereo.
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/base/console.h"
#include "app/demo/render_file.h"
#include "app/verbs/distinct_outputs.h"
#include "app/verbs/number_between.h"
#include "app/verbs/picture_size.h"
#include "app/verbs/verbs.h"

namespace gearshift::verbs {
namespace {

struct RenderArguments {
  std::string file, out, size = "1280x720", camera = "fit";
  int samples = 4;
  std::optional<double> fov;  // [deg] field of view; empty: the camera's default
  bool stereo = false;
};

demo::RenderFileSetup make_setup(const RenderArguments& arguments) {
  try {
    demo::check_camera(arguments.camera);
  } catch (const std::invalid_argument& refused) {
    throw CLI::ValidationError(refused.what());
  }
  demo::RenderFileSetup setup;
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
  check_distinct_outputs("--out", "the picture and the model", arguments.out, arguments.file);
  const demo::RenderFileSetup setup = make_setup(arguments);
  const demo::RenderFileResult result = demo::render_file(setup);
  for (const std::string& skipped : result.skipped) base::print_message("not drawn: {}", skipped);
  base::print_out("{}: {} triangles in {} draw calls, loaded in {:.0f} ms, finished after {:.0f} ms on {}\n",
                  setup.out.string(), result.triangles, result.draws, result.load_ms, result.first_frame_ms,
                  result.device);
  return 0;
}

}  // namespace

void add_render_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* verb = app.add_subcommand("render", "Render any glTF file to a picture, mono or stereo");
  verb->footer(
      "Examples:\n"
      "  gearshift render FILE --out PNG\n"
      "  gearshift render FILE --stereo --out PNG\n");
  verb->add_option("file", arguments->file, "glTF 2.0 file, .gltf or .glb")->type_name("FILE")->required();
  verb->add_option("--out", arguments->out, "picture to write")->type_name("PNG")->required();
  verb->add_option("--size", arguments->size, "picture size [px]")->type_name("WxH")->capture_default_str();
  verb->add_option("--samples", arguments->samples, "samples per pixel: 1 or 4")
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  verb->add_option(
          "--camera", arguments->camera,
          "fit, driver, ahead, lever, gate, cluster or gearbox; or the eye and target points as X,Y,Z:X,Y,Z [m]")
      ->capture_default_str();
  verb->add_option("--fov", arguments->fov,
                   "field of view across the shorter side [deg]; default: 58, or that of the named camera")
      ->check(number_between(5.0, 150.0));
  verb->add_flag("--stereo", arguments->stereo, "render both eyes, side by side");
  verb->callback([arguments, &action] { action = [arguments] { return run_render(*arguments); }; });
}

}  // namespace gearshift::verbs
