// The haptic thread beside the renderer at full load: the cabin drawn one frame after another, as fast as it goes.
#include <atomic>
#include <thread>

#include "tests/bench/jitter_contest.h"
#include "tests/bench/picture/picture_rig.h"

namespace gearshift {
namespace {

class FlatOutRenderer {
 public:
  FlatOutRenderer(const BenchOptions& options, std::atomic<int>& frames)
      : cabin_(paper_cabin(options)), stage_(cabin_, options.model_folder), renderer_(gpu_, {}), frames_(frames) {
    renderer_.set_model(stage_.model());
    stage_.place(in_first(cabin_.gate));
    draw();  // what the first frame alone does is no load
    thread_ = std::thread([this] {
      while (!stop_) draw();
    });
  }
  ~FlatOutRenderer() {
    stop_ = true;
    thread_.join();
  }
  FlatOutRenderer(const FlatOutRenderer&) = delete;
  FlatOutRenderer& operator=(const FlatOutRenderer&) = delete;

 private:
  void draw() {
    const View view = seen_from(stage_.driver_eye(), renderer_.config());
    gpu_.wait(renderer_.draw(stage_.scene(), {&view, 1}));
    ++frames_;
  }

  StageConfig cabin_;
  Stage stage_;
  Gpu gpu_{{}};
  Renderer renderer_;
  std::atomic<int>& frames_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace

std::vector<BenchRow> bench_beside(const BenchOptions& options) {
  std::atomic<int> frames{0};
  const JitterLoad drawing{", beside the cabin drawn flat out",
                           [&] { return std::make_shared<FlatOutRenderer>(options, frames); }};
  std::vector<BenchRow> rows = jitter_rows(options, "beside", drawing, 0.0, 1.0);
  rows.back().beside.push_back({"frames drawn meanwhile", static_cast<double>(frames), ""});
  return rows;
}

}  // namespace gearshift
