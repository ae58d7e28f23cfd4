#include "engine/window/controllers.h"

#include <GLFW/glfw3.h>
#include <fcntl.h>
#include <libevdev/libevdev.h>
#include <linux/input.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "engine/window/glfw_use.h"
#include "engine/window/window.h"

namespace gearshift::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDeviceFiles = "/dev/input";
constexpr std::chrono::seconds kRetry{1};  // interval of attempts to open a device that may not be read
constexpr const char* kSteamCopy = "28de:11ff";

std::string sysfs_text(const fs::path& file) {
  std::ifstream stream(file);
  std::string text;
  std::getline(stream, text);
  return text;
}

unsigned hex_number(const std::string& text) {
  unsigned number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number, 16);
  return number;
}

// The set bits of a line such as "3f 0 0 10003": words of an unsigned long each, the highest first.
class BitSet {
 public:
  explicit BitSet(const std::string& line) {
    for (std::size_t end = line.size(); end > 0;) {
      const std::size_t blank = line.rfind(' ', end - 1);
      const std::size_t begin = blank == std::string::npos ? 0 : blank + 1;
      unsigned long word = 0;
      std::from_chars(line.data() + begin, line.data() + end, word, 16);
      words_.push_back(word);
      end = blank == std::string::npos ? 0 : blank;
    }
  }

  bool has(unsigned bit) const {
    constexpr unsigned kBits = 8 * sizeof(unsigned long);
    return bit / kBits < words_.size() && (words_[bit / kBits] >> (bit % kBits) & 1u) != 0;
  }
  bool has_between(unsigned first, unsigned last) const {
    for (unsigned bit = first; bit <= last; ++bit)
      if (has(bit)) return true;
    return false;
  }

 private:
  std::vector<unsigned long> words_;
};

// True if the input device may be a controller. The rules are those of the kernel's joydev (joydev_match), of udev
// (test_pointers) and of SDL (SDL_evdev_capabilities.c), except that they refuse pedals, which have axes and no button.
bool is_controller(const fs::path& device) {
  const BitSet properties(sysfs_text(device / "properties"));
  const BitSet axes(sysfs_text(device / "capabilities/abs")), keys(sysfs_text(device / "capabilities/key"));
  const unsigned bus = hex_number(sysfs_text(device / "id/bustype"));
  const bool is_built_in = bus == BUS_HOST || bus == BUS_I2C || bus == BUS_SPI || bus == BUS_ISA;
  const bool points = keys.has_between(BTN_MOUSE, BTN_TASK) || keys.has_between(BTN_TOOL_PEN, BTN_TOOL_QUADTAP) ||
                      axes.has(ABS_MT_POSITION_X);
  const bool types = keys.has(KEY_A) && keys.has(KEY_Z) && keys.has(KEY_ENTER);
  if (is_built_in || points || types || properties.has(INPUT_PROP_ACCELEROMETER)) return false;
  return axes.has_between(ABS_X, ABS_BRAKE) || keys.has_between(BTN_JOYSTICK, BTN_THUMBR) ||
         keys.has_between(BTN_TRIGGER_HAPPY, BTN_TRIGGER_HAPPY40);
}

// The identifier that GLFW computes; it follows SDL's.
std::string guid_of(const fs::path& device, const std::string& name) {
  const auto number = [&](const char* part) { return hex_number(sysfs_text(device / "id" / part)); };
  const auto bytes = [](unsigned word) { return fmt::format("{:02x}{:02x}", word & 0xff, word >> 8 & 0xff); };
  const unsigned vendor = number("vendor"), product = number("product"), version = number("version");
  std::string guid = bytes(number("bustype")) + "0000";
  if (vendor != 0 && product != 0 && version != 0)
    return guid + bytes(vendor) + "0000" + bytes(product) + "0000" + bytes(version) + "0000";
  for (std::size_t i = 0; i < 11; ++i)
    guid += fmt::format("{:02x}", i < name.size() ? static_cast<unsigned char>(name[i]) : 0);
  return guid + "00";
}

float centred(const input_absinfo& axis) {
  const float range = static_cast<float>(axis.maximum) - static_cast<float>(axis.minimum);
  return range == 0.0f ? 0.0f
                       : 2.0f * (static_cast<float>(axis.value) - static_cast<float>(axis.minimum)) / range - 1.0f;
}

// The button of a game pad that usually has this code, after the kernel's Documentation/input/gamepad.rst. Drivers disagree
// about X and Y.
std::optional<std::size_t> usual_button(unsigned code) {
  switch (code) {
    case BTN_SOUTH:
      return GLFW_GAMEPAD_BUTTON_A;
    case BTN_EAST:
      return GLFW_GAMEPAD_BUTTON_B;
    case BTN_TL:
      return GLFW_GAMEPAD_BUTTON_LEFT_BUMPER;
    case BTN_TR:
      return GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER;
    case BTN_SELECT:
      return GLFW_GAMEPAD_BUTTON_BACK;
    case BTN_START:
      return GLFW_GAMEPAD_BUTTON_START;
    case BTN_MODE:
      return GLFW_GAMEPAD_BUTTON_GUIDE;
    case BTN_THUMBL:
      return GLFW_GAMEPAD_BUTTON_LEFT_THUMB;
    case BTN_THUMBR:
      return GLFW_GAMEPAD_BUTTON_RIGHT_THUMB;
    default:
      return std::nullopt;
  }
}

// GLFW reports the state of a game pad and no events, so it misses a press shorter than a frame. The device has reported
// it, but only GLFW's table knows which button of the pad it is. That shows whenever a button stays down for a frame; two
// such presses count, because a single one may be two buttons that change places between two readings. Until then a
// button has its usual meaning, because the first press may be the one that stops the motors.
class ShortPresses {
 public:
  // Call once per poll. `device`: the pad as a controller. Adds the short presses to the state that GLFW reports.
  void add_to(Gamepad& pad, const Controller& device) {
    std::vector<unsigned char> held = device.buttons;
    for (const std::size_t i : device.tapped) held[i] = 0;
    held_.resize(held.size());
    const std::optional<std::size_t> pressed = only_new(held_, held), shown = only_new(pad_, pad.buttons);
    if (pressed && shown && device.tapped.empty()) learn(*pressed, *shown);
    held_ = std::move(held);
    pad_ = pad.buttons;
    for (const std::size_t i : device.tapped) {
      const auto known = known_.find(i);
      const bool is_known = known != known_.end() && known->second.times >= kTimes;
      if (is_known)
        pad.buttons[known->second.button] = 1;
      else if (const auto usual = i < device.codes.size() ? usual_button(device.codes[i]) : std::nullopt)
        pad.buttons[*usual] = 1;
    }
  }

 private:
  static constexpr int kTimes = 2;
  struct Known {
    std::size_t button = 0;  // GLFW_GAMEPAD_BUTTON_...
    int times = 0;           // how often this has shown
  };

  // The button that is down now and was up before; empty if there are several or none.
  template <class Buttons>
  static std::optional<std::size_t> only_new(const Buttons& before, const Buttons& now) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] == 0 || before[i] != 0) continue;
      if (found) return std::nullopt;
      found = i;
    }
    return found;
  }
  void learn(std::size_t pressed, std::size_t shown) {
    Known& known = known_[pressed];
    known = {shown, known.button == shown ? known.times + 1 : 1};
  }

  std::vector<unsigned char> held_;
  std::array<unsigned char, 15> pad_{};
  std::map<std::size_t, Known> known_;
};

// The device behind each of GLFW's joystick numbers. GLFW reads a device's events whenever it is asked about it, and writes out of
// bounds at the event of a key below BTN_MISC (glfw issues 2455 and 2856; GLFW 3.4 aborts). Keyboards that declare an axis
// count as joysticks, so a device that is no game pad is asked only once, right after it was opened.
struct Joystick {
  enum class Kind : unsigned char { unknown, gamepad, other } kind = Kind::unknown;
  std::string file;  // of its controller; empty: not known yet
  ShortPresses short_presses{};
};
std::array<Joystick, GLFW_JOYSTICK_LAST + 1> joysticks;
int joysticks_since = 0;  // glfw_starts() for which they hold

bool is_gamepad(int id) {
  using Kind = Joystick::Kind;
  Kind& kind = joysticks[static_cast<std::size_t>(id)].kind;
  if (kind == Kind::unknown && glfwJoystickPresent(id) == GLFW_TRUE)
    kind = glfwJoystickIsGamepad(id) == GLFW_TRUE ? Kind::gamepad : Kind::other;
  return kind == Kind::gamepad;
}

// Returns the controller of GLFW's joystick; null if it is not found yet. GLFW does not say which device file it has
// opened. It gives equal devices that are present at its start their numbers in the alphabetical order of their files, and a
// device that is plugged in later the first free number.
Controller* controller_of(int id, std::vector<Controller>& controllers) {
  const char* name = glfwGetJoystickName(id);
  const char* guid = glfwGetJoystickGUID(id);
  if (name == nullptr || guid == nullptr) return nullptr;  // the pad was just unplugged
  Joystick& joystick = joysticks[static_cast<std::size_t>(id)];
  Controller* found = nullptr;
  for (Controller& one : controllers) {
    if (one.name != name || one.guid != guid) continue;
    if (one.file == joystick.file) return &one;
    const bool is_taken =
        std::any_of(joysticks.begin(), joysticks.end(), [&](const Joystick& j) { return j.file == one.file; });
    if (!is_taken && (found == nullptr || one.file < found->file)) found = &one;
  }
  if (found != nullptr) joystick.file = found->file;
  return found;
}

// Adds the state of the game pads that GLFW knows to their controllers.
void add_gamepads(std::vector<Controller>& controllers) {
  if (!glfw_is_in_use()) return;
  if (std::exchange(joysticks_since, glfw_starts()) != glfw_starts()) {
    joysticks = {};
    glfwSetJoystickCallback([](int id, int) { joysticks[static_cast<std::size_t>(id)] = {}; });
  }
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
    GLFWgamepadstate mapped;
    if (!is_gamepad(id) || glfwGetGamepadState(id, &mapped) == GLFW_FALSE) continue;
    Controller* pad = controller_of(id, controllers);
    if (pad == nullptr) continue;
    pad->gamepad.emplace();
    std::copy(std::begin(mapped.axes), std::end(mapped.axes), pad->gamepad->axes.begin());
    std::copy(std::begin(mapped.buttons), std::end(mapped.buttons), pad->gamepad->buttons.begin());
    joysticks[static_cast<std::size_t>(id)].short_presses.add_to(*pad->gamepad, *pad);
  }
}

}  // namespace

// A device file of a controller.
struct Controllers::Node {
  explicit Node(const fs::path& sysfs) : found(std::chrono::steady_clock::now()) {
    const fs::path input = sysfs / "device";
    place = sysfs_text(input / "phys") + " " + sysfs_text(input / "uniq");
    state.file = sysfs.filename();
    state.name = sysfs_text(input / "name");
    state.id = sysfs_text(input / "id/vendor") + ":" + sysfs_text(input / "id/product");
    state.guid = guid_of(input, state.name);
    state.can_be_read = false;
  }
  ~Node() { close_file(); }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  void open_file();
  void close_file();
  void read();

  std::string place;  // USB port, or the addresses of Bluetooth's host and device
  std::chrono::steady_clock::time_point found;
  Controller state;
  int descriptor = -1;
  bool is_gone = false;  // unplugged
  libevdev* device = nullptr;
  std::vector<unsigned> axes, hats;  // the kernel's codes; of a hat, the code of its x axis
};

void Controllers::Node::open_file() {
  descriptor = ::open((fs::path(kDeviceFiles) / state.file).c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 || libevdev_new_from_fd(descriptor, &device) < 0) return close_file();
  state.can_be_read = true;
  const auto has = [this](unsigned type, unsigned code) { return libevdev_has_event_code(device, type, code) != 0; };
  for (unsigned code = 0; code < ABS_CNT; ++code)
    if (has(EV_ABS, code) && (code < ABS_HAT0X || code > ABS_HAT3Y)) axes.push_back(code);
  for (unsigned code = BTN_MISC; code < KEY_CNT; ++code)
    if (has(EV_KEY, code)) state.codes.push_back(code);
  for (unsigned code = ABS_HAT0X; code <= ABS_HAT3X; code += 2)
    if (has(EV_ABS, code) || has(EV_ABS, code + 1)) hats.push_back(code);
}

void Controllers::Node::close_file() {
  libevdev_free(device);
  if (descriptor >= 0) ::close(descriptor);
  device = nullptr;
  descriptor = -1;
  state.can_be_read = false;
}

void Controllers::Node::read() {
  if (device == nullptr) return;
  input_event event;
  std::set<unsigned> newly_down;                  // also those that were released since
  std::set<std::pair<unsigned, bool>> deflected;  // codes of axes, and whether the value was positive
  int result = LIBEVDEV_READ_STATUS_SUCCESS;
  while (result >= 0) {
    // After an overflow of the kernel's queue (LIBEVDEV_READ_STATUS_SYNC), libevdev asks for the present state.
    const bool overflowed = result == LIBEVDEV_READ_STATUS_SYNC;
    result = libevdev_next_event(device, overflowed ? LIBEVDEV_READ_FLAG_SYNC : LIBEVDEV_READ_FLAG_NORMAL, &event);
    if (result >= 0 && event.type == EV_KEY && event.value != 0) newly_down.insert(event.code);
    if (result >= 0 && event.type == EV_ABS && event.value != 0) deflected.insert({event.code, event.value > 0});
    if (overflowed && result == -EAGAIN) result = LIBEVDEV_READ_STATUS_SUCCESS;
  }
  is_gone = result != -EAGAIN;
  state.axes.clear();
  state.buttons.clear();
  state.tapped.clear();
  for (const unsigned code : axes) state.axes.push_back(centred(*libevdev_get_abs_info(device, code)));
  const auto add_button = [this](bool is_down, bool was_down) {
    if (!is_down && was_down) state.tapped.push_back(state.buttons.size());
    state.buttons.push_back(is_down || was_down ? 1 : 0);
  };
  for (const unsigned code : state.codes)
    add_button(libevdev_get_event_value(device, EV_KEY, code) != 0, newly_down.contains(code));
  for (const unsigned x : hats) {
    const auto add_direction = [&](unsigned code, bool is_positive) {
      const int value = libevdev_get_event_value(device, EV_ABS, code);
      add_button(is_positive ? value > 0 : value < 0, deflected.contains({code, is_positive}));
    };
    add_direction(x + 1, false);
    add_direction(x, true);
    add_direction(x + 1, true);
    add_direction(x, false);
  }
}

Controllers::Controllers(std::chrono::milliseconds grant_delay) : grant_delay_(grant_delay) {}
Controllers::~Controllers() = default;

bool Controllers::is_outdated() const {
  struct stat folder {};
  if (stat(kDeviceFiles, &folder) != 0) return !nodes_.empty();
  if (folder.st_mtim.tv_sec != changed_.tv_sec || folder.st_mtim.tv_nsec != changed_.tv_nsec) return true;
  if (std::any_of(nodes_.begin(), nodes_.end(), [](const auto& node) { return node->is_gone; })) return true;
  // A device may have appeared in the clock tick of the last scan.
  const bool may_change = !is_settled_ || std::any_of(nodes_.begin(), nodes_.end(),
                                                      [](const auto& node) { return !node->state.can_be_read; });
  return may_change && std::chrono::steady_clock::now() - scanned_ > kRetry;
}

// Finds the controllers by their entries in /sys, which every user may read, and opens the new ones.
void Controllers::scan() {
  struct stat folder {};
  const timespec changed = stat(kDeviceFiles, &folder) == 0 ? folder.st_mtim : timespec{};
  is_settled_ = changed.tv_sec == changed_.tv_sec && changed.tv_nsec == changed_.tv_nsec;
  changed_ = changed;
  const bool is_first = scanned_ == std::chrono::steady_clock::time_point();
  scanned_ = std::chrono::steady_clock::now();
  std::vector<std::unique_ptr<Node>> present;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator("/sys/class/input", error)) {
    const std::string file = entry.path().filename();
    if (!file.starts_with("event") || !is_controller(entry.path() / "device")) continue;
    const auto known = std::find_if(nodes_.begin(), nodes_.end(), [&](const auto& node) {
      return node && node->state.file == file && !node->is_gone;
    });
    present.push_back(known != nodes_.end() ? std::move(*known) : std::make_unique<Node>(entry.path()));
    if (is_first) present.back()->found -= grant_delay_;  // it was there before the program
    if (!present.back()->state.can_be_read) present.back()->open_file();
  }
  const auto place = [](const auto& node) {
    return std::tuple(node->place, node->state.file.size(), node->state.file);
  };
  std::sort(present.begin(), present.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  nodes_ = std::move(present);
}

const std::vector<Controller>& Controllers::poll() {
  if (is_outdated()) scan();
  controllers_.clear();
  const auto now = std::chrono::steady_clock::now();
  for (const auto& node : nodes_) {
    node->read();
    const bool is_denied = now - node->found >= grant_delay_;
    if (!node->is_gone && (node->state.can_be_read || is_denied)) controllers_.push_back(node->state);
  }
  add_gamepads(controllers_);
  if (controllers_.size() > 1) std::erase_if(controllers_, [](const Controller& one) { return one.id == kSteamCopy; });
  return controllers_;
}

std::vector<Controller> list_controllers() {
  std::optional<GlfwUse> glfw;
  if (has_display()) glfw.emplace();
  Controllers controllers(std::chrono::milliseconds(0));
  return controllers.poll();
}

}  // namespace gearshift::engine
