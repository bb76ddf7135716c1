// X client: what a desktop does to a window, done by a small client of the test's own: the close button of the window's
// frame, and a file dragged from elsewhere and let go over it.
//
// Source    ICCCM 4.2.8 (WM_DELETE_WINDOW); XDND 5, the source's part
#pragma once

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <initializer_list>
#include <string>
#include <thread>

namespace bosquet::ui::test {

class XClient {
 public:
  explicit XClient(const std::string& display) : display_(XOpenDisplay(display.c_str())) {}
  ~XClient() {
    if (display_) XCloseDisplay(display_);
  }
  XClient(const XClient&) = delete;
  XClient& operator=(const XClient&) = delete;

  /// Presses the close button of the only window there is; false when there is none.
  bool close_window() {
    const Window window = top();
    if (!window) return false;
    tell(window, "WM_PROTOCOLS", {static_cast<long>(atom("WM_DELETE_WINDOW"))});
    return true;
  }

  /// Drops a file in the middle of the window; false when it is not taken within a minute.
  bool drop(const std::string& file) {
    const Window window = top();
    if (!window) return false;
    const Window own = XCreateSimpleWindow(display_, XDefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
    const auto me = static_cast<long>(own);
    const Atom list = atom("text/uri-list"), selection = atom("XdndSelection");
    XSetSelectionOwner(display_, selection, own, CurrentTime);
    constexpr long kVersion = 5L << 24;
    tell(window, "XdndEnter", {me, kVersion, static_cast<long>(list), 0, 0});
    tell(window, "XdndPosition", {me, 0, 500L << 16 | 350, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
    bool dropped = false;
    for (int turn = 0; turn < 6000; ++turn) {
      while (XPending(display_) > 0) {
        XEvent event;
        XNextEvent(display_, &event);
        if (event.type == ClientMessage && event.xclient.message_type == atom("XdndStatus") && !dropped) {
          tell(window, "XdndDrop", {me, 0, CurrentTime, 0, 0});
          dropped = true;
        }
        if (event.type == ClientMessage && event.xclient.message_type == atom("XdndFinished")) return true;
        if (event.type == SelectionRequest) answer(event.xselectionrequest, "file://" + file + "\r\n");
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

 private:
  Atom atom(const char* name) { return XInternAtom(display_, name, False); }

  // Without a window manager the program's windows stand directly on the root.
  Window top() {
    Window root = 0, parent = 0, *children = nullptr, found = 0;
    unsigned count = 0;
    if (!display_ || !XQueryTree(display_, XDefaultRootWindow(display_), &root, &parent, &children, &count)) return 0;
    for (unsigned i = 0; i < count; ++i) {
      XWindowAttributes attributes;
      if (XGetWindowAttributes(display_, children[i], &attributes) && attributes.map_state == IsViewable &&
          attributes.width > 100)
        found = children[i];
    }
    if (children) XFree(children);
    return found;
  }

  void tell(Window window, const char* type, std::initializer_list<long> words) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    std::size_t i = 0;
    for (const long word : words) event.xclient.data.l[i++] = word;
    XSendEvent(display_, window, False, NoEventMask, &event);
    XFlush(display_);
  }

  void answer(const XSelectionRequestEvent& asked, const std::string& text) {
    XChangeProperty(display_, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = asked.requestor;
    event.xselection.selection = asked.selection;
    event.xselection.target = asked.target;
    event.xselection.property = asked.property;
    event.xselection.time = asked.time;
    XSendEvent(display_, asked.requestor, False, NoEventMask, &event);
    XFlush(display_);
  }

  Display* display_;
};

}  // namespace bosquet::ui::test
