#include "app/demo/demo.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/base/output_folder.h"
#include "app/cabin/sound/cabin_sound.h"
#include "app/cabin/view/cabin_kind.h"
#include "app/demo/contact_sheet.h"
#include "app/demo/demo_lessons.h"
#include "app/demo/demo_page.h"
#include "app/demo/film.h"
#include "app/demo/filmed_drive.h"
#include "app/demo/render_file.h"
#include "app/demo/shots.h"
#include "app/lessons/simulated_driver/auto_driver.h"
#include "engine/sound/wav.h"

namespace gearshift::demo {
namespace {

constexpr int kSheetColumns = 3;
constexpr int kSheetWidth = 480;  // [px] approximate width of a picture on the contact sheet

cabin::Stage make_stage(const DemoSetup& setup, cabin::Cabin cabin) {
  return {cabin::stage_config(setup.tour.gate, setup.tour.lever.yoke, cabin), base::assets_folder() / "models"};
}

// Uploads a cabin. One upload per cabin is enough: all drives of a demo use the same car, so the red line on the dial
// never changes.
void show_cabin(cabin::CabinView& view, cabin::Stage& stage, const FilmFrame& frame) {
  stage.place({frame.lever, frame.car, frame.time});
  view.set_model(stage.model());
}

engine::Image take_picture(cabin::CabinView& view, cabin::Stage& stage, const FilmFrame& frame,
                           const std::string& from) {
  stage.place({frame.lever, frame.car, frame.time});
  view.begin();
  view.draw(stage.scene(), cabin::camera(from), cabin::camera_field(from));
  return view.picture();
}

// Renders the pictures sorted by kind of cabin, so that each model is uploaded only once.
std::vector<engine::Image> take_pictures(cabin::CabinView& view, const DemoSetup& setup, const std::vector<Shot>& shots,
                                         const lab::TourProgress& progress, DemoResult& result) {
  std::vector<engine::Image> pictures(shots.size());
  std::vector<double> times;
  for (const cabin::Cabin cabin : {cabin::Cabin::closed, cabin::Cabin::open_gate, cabin::Cabin::cutaway}) {
    cabin::Stage stage = make_stage(setup, cabin);
    show_cabin(view, stage, *shots.front().frame);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      if (cabin::cabin_for_camera(shots[i].camera) != cabin) continue;
      const auto start = std::chrono::steady_clock::now();
      pictures[i] = take_picture(view, stage, *shots[i].frame, shots[i].camera);
      times.push_back(ms_since(start));
      engine::write_png(setup.tour.folder / (shots[i].name + ".png"), pictures[i]);
      progress("pictures", static_cast<double>(times.size()) / static_cast<double>(shots.size()));
    }
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  result.picture_ms = times[times.size() / 2];
  return pictures;
}

void render_film(cabin::CabinView& view, const DemoSetup& setup, std::span<const FilmFrame> film,
                 const lab::TourProgress& progress, DemoResult& result) {
  if (setup.film_rate <= 0.0) return;
  const std::filesystem::path folder = setup.tour.folder / "film";
  base::make_folder(folder);
  cabin::Stage stage = make_stage(setup, cabin::Cabin::closed);
  show_cabin(view, stage, film.front());
  for (; result.film_frames / setup.film_rate < film.back().time; ++result.film_frames) {
    const FilmFrame& frame = frame_at(film, result.film_frames / setup.film_rate);
    engine::write_png(folder / fmt::format("{:05}.png", result.film_frames),
                      take_picture(view, stage, frame, "driver"));
    progress("film", frame.time / film.back().time);
  }
}

void record_sound(const DemoSetup& setup, std::span<const FilmFrame> film, const lab::TourProgress& progress) {
  engine::SoundWorld world(engine::SoundOutput::memory);
  cabin::CabinSound sound(world, {});
  cabin::Stage stage = make_stage(setup, cabin::Cabin::closed);
  std::vector<float> stereo;
  constexpr std::size_t kFrames = static_cast<std::size_t>(engine::kSoundRate * lab::kWatchPeriod);
  std::vector<float> part(2 * kFrames);
  for (const FilmFrame& frame : film) {
    stage.place({frame.lever, frame.car, frame.time});
    sound.update(frame.events, frame.lever, frame.car, cabin::camera("driver"), stage.knob(), frame.time);
    world.render(part);
    stereo.insert(stereo.end(), part.begin(), part.end());
    progress("sound", frame.time / film.back().time);
  }
  engine::write_wav(setup.tour.folder / "demo.wav", stereo, engine::kSoundRate);
}

lessons::LessonDriveConfig tour_drive(const DemoSetup& setup, const vehicle::CarSpec& car) {
  lessons::LessonDriveConfig config;
  config.lesson = lessons::tour_lesson(car, setup.tour.gate);
  config.car = car;
  config.gate = setup.tour.layout;
  config.seed = setup.tour.seed;
  return config;
}

DemoChapter tour_chapter(const FilmedDrive& tour, const std::optional<vehicle::CarSpec>& car) {
  if (!car)
    return {"Through every gear",
            {"No shipped car has all the gears of this gate, so the drive was simulated without a car."},
            {},
            {}};
  DemoChapter chapter{"Through every gear", {car->title + "."}, {}, {}};
  for (std::string& sentences : describe_result(tour)) chapter.text.push_back(std::move(sentences));
  return chapter;
}

void add_pictures(const std::vector<Shot>& shots, DemoChapter& chapter) {
  for (const Shot& shot : shots) chapter.pictures.push_back({shot.name + ".png", shot.caption});
}

}  // namespace

std::size_t DemoResult::pictures() const {
  std::size_t count = 0;
  for (const DemoChapter& chapter : chapters) count += chapter.pictures.size();
  return count;
}

DemoResult run_demo(const DemoSetup& setup, const lab::TourProgress& progress) {
  DemoResult result;
  std::vector<FilmFrame> by_hand;  // film of the tour by a scripted hand, without a car
  result.tour = lab::drive_tour(
      setup.tour, progress, [&](const haptics::HapticSnapshot& now, std::span<const haptics::HapticEvent> events) {
        by_hand.push_back(
            {static_cast<double>(by_hand.size()) * lab::kWatchPeriod, now, {events.begin(), events.end()}, {}});
      });
  lab::draw_tour(setup.tour, result.tour, progress);

  const std::optional<vehicle::CarSpec> car = fitting_car(setup.tour.gate);
  FilmedDrive tour;
  std::vector<DemoLesson> lessons;
  if (car) {
    tour = film_drive(tour_drive(setup, *car));
    lessons = drive_demo_lessons(setup, *car, progress);
  } else {
    tour.film = std::move(by_hand);
  }
  record_sound(setup, tour.film, progress);

  std::vector<Shot> shots = tour_shots(tour.film, setup.tour.gate);
  result.chapters.push_back(tour_chapter(tour, car));
  add_pictures(shots, result.chapters.back());
  for (const DemoLesson& lesson : lessons) {
    const std::vector<Shot> more = lesson_shots(lesson.last.film, lesson.last.lesson.key);
    result.chapters.push_back({lesson.last.lesson.title, describe_result(lesson.last), lesson.trace, {}});
    add_pictures(more, result.chapters.back());
    shots.insert(shots.end(), more.begin(), more.end());
    result.passed = result.passed && lesson.last.result.passed;
  }

  cabin::CabinView view(setup.view, nullptr, nullptr);
  const std::vector<engine::Image> pictures = take_pictures(view, setup, shots, progress, result);
  const int shrink = std::max(1, pictures[0].width / kSheetWidth);
  engine::write_png(setup.tour.folder / "contact_sheet.png", contact_sheet(pictures, kSheetColumns, shrink));
  render_film(view, setup, tour.film, progress, result);
  result.device = view.gpu().name;
  result.validation_messages = view.validation_messages();
  result.has_report = !lessons.empty();
  if (result.has_report) write_demo_report(setup, lessons);
  write_demo_page(setup, result);
  return result;
}

}  // namespace gearshift::demo
