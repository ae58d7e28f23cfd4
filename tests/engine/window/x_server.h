// A second client of the X server, with which a test observes and acts from outside the program.
#pragma once

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "engine/image/image.h"

namespace gearshift::test {

class XServer {
 public:
  XServer() : display_(XOpenDisplay(nullptr)) {
    // One connection stays open, because Xvfb resets when its last client disconnects.
    [[maybe_unused]] static Display* const keep_server_alive = XOpenDisplay(nullptr);
    REQUIRE_MESSAGE(display_ != nullptr,
                    "this test needs an X server: xvfb-run -a -s \"-screen 0 1280x720x24\" PROGRAM");
  }
  ~XServer() { XCloseDisplay(display_); }
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  // Returns the window with that title; 0 if there is none.
  ::Window find(const std::string& title) const {
    ::Window root = 0, parent = 0, *children = nullptr, found = 0;
    unsigned int count = 0;
    XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count);
    for (unsigned int i = 0; i < count; ++i) {
      char* name = nullptr;
      if (XFetchName(display_, children[i], &name) == 0) continue;
      if (title == name) found = children[i];
      XFree(name);
    }
    if (children != nullptr) XFree(children);
    return found;
  }

  void resize(::Window window, int width, int height) {
    XResizeWindow(display_, window, static_cast<unsigned>(width), static_cast<unsigned>(height));
    XSync(display_, False);
  }
  void move(::Window window, int x, int y) {
    XMoveWindow(display_, window, x, y);
    XSync(display_, False);
  }
  // unmap() and map() minimise and restore the window like a window manager that unmaps minimised windows.
  void unmap(::Window window) {
    XUnmapWindow(display_, window);
    XSync(display_, False);
  }
  void map(::Window window) {
    XMapWindow(display_, window);
    XSync(display_, False);
  }
  // Minimises or restores the window like a window manager that keeps minimised windows mapped: ICCCM 4.1.3.1, WM_STATE
  // is Iconic (3) or Normal (1).
  void set_iconic(::Window window, bool iconic) {
    const Atom state = XInternAtom(display_, "WM_STATE", False);
    const long value[2] = {iconic ? 3L : 1L, 0L};
    XChangeProperty(display_, window, state, state, 32, PropModeReplace, reinterpret_cast<const unsigned char*>(value),
                    2);
    XSync(display_, False);
  }
  void request_close(::Window window) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
    XSendEvent(display_, window, False, NoEventMask, &event);
    XSync(display_, False);
  }

  // Returns the window's content on the screen.
  engine::Image picture(::Window window) const {
    XWindowAttributes at;
    REQUIRE(XGetWindowAttributes(display_, window, &at) != 0);
    XImage* screenshot = XGetImage(display_, window, 0, 0, static_cast<unsigned>(at.width),
                                   static_cast<unsigned>(at.height), AllPlanes, ZPixmap);
    REQUIRE(screenshot != nullptr);
    engine::Image image{.width = at.width, .height = at.height, .rgba = {}};
    for (int i = 0; i < at.width * at.height; ++i) {
      const unsigned long pixel = XGetPixel(screenshot, i % at.width, i / at.width);
      for (const int shift : {16, 8, 0}) image.rgba.push_back(static_cast<std::uint8_t>(pixel >> shift));
      image.rgba.push_back(255);
    }
    XDestroyImage(screenshot);
    return image;
  }

 private:
  Display* display_;
};

// Runs xdotool, which injects mouse and keyboard input through XTEST as if it came from a user.
inline void xdotool(const std::string& arguments) {
  REQUIRE_MESSAGE(std::system(("xdotool " + arguments).c_str()) == 0, "xdotool " << arguments);
}

}  // namespace gearshift::test
