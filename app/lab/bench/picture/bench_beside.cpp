// Measures how late the haptic thread wakes up while the renderer draws the cabin without pauses.
#include <atomic>
#include <thread>

#include "app/lab/bench/lever/jitter_contest.h"
#include "app/lab/bench/picture/picture_rig.h"

namespace gearshift::lab {
namespace {

class BusyRenderer {
 public:
  BusyRenderer(const BenchOptions& options, std::atomic<int>& frames)
      : cabin_(paper_cabin(options)), stage_(cabin_, options.model_folder), renderer_(gpu_, {}), frames_(frames) {
    renderer_.set_model(stage_.model());
    stage_.place(in_first_gear(cabin_.gate));
    draw();  // the first frame takes longer than later ones, so draw it before measuring
    thread_ = std::thread([this] {
      while (!stop_) draw();
    });
  }
  ~BusyRenderer() {
    stop_ = true;
    thread_.join();
  }
  BusyRenderer(const BusyRenderer&) = delete;
  BusyRenderer& operator=(const BusyRenderer&) = delete;

 private:
  void draw() {
    const engine::View view = symmetric_view(stage_.driver_eye(), renderer_.config());
    gpu_.wait(renderer_.draw(stage_.scene(), {&view, 1}));
    ++frames_;
  }

  cabin::StageConfig cabin_;
  cabin::Stage stage_;
  engine::Gpu gpu_{{}};
  engine::Renderer renderer_;
  std::atomic<int>& frames_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace

std::vector<BenchRow> bench_beside(const BenchOptions& options) {
  std::atomic<int> frames{0};
  const JitterLoad drawing{", while the cabin is drawn at full speed",
                           [&] { return std::make_shared<BusyRenderer>(options, frames); }};
  std::vector<BenchRow> rows = jitter_rows(options, "beside", drawing, 0.0, 1.0);
  rows.back().related.push_back({"frames drawn meanwhile", static_cast<double>(frames), ""});
  return rows;
}

}  // namespace gearshift::lab
