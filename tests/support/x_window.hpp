// Somebody else's window on an XScreen, found by its title: what it shows, and what its user and a window manager do.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/support/x_screen.hpp"

namespace support {

class XWindow {
 public:
  // Keys as X names them: the Latin letters' own codes, and those of two others.
  static constexpr xcb_keysym_t kSpace = 0x20, kEscape = 0xff1b;

  // Waits until a window of this title is there. Refers to the screen.
  XWindow(const XScreen& screen, std::string_view title) : screen_(screen) {
    const auto stop = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (; std::chrono::steady_clock::now() < stop; std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
      if (const auto found = find(title)) {
        window_ = *found;
        return;
      }
    }
    throw std::runtime_error("no window named " + std::string(title));
  }

  struct Place {
    int x = 0, y = 0, width = 0, height = 0;
  };
  // On the screen. There is no window manager, so nothing is around it.
  [[nodiscard]] Place place() const {
    const auto reply = take(xcb_get_geometry_reply(wire(), xcb_get_geometry(wire(), window_), nullptr));
    if (!reply) {
      throw std::runtime_error("the window is gone");
    }
    return {reply->x, reply->y, reply->width, reply->height};
  }

  [[nodiscard]] bool is_visible() const {
    const auto reply =
        take(xcb_get_window_attributes_reply(wire(), xcb_get_window_attributes(wire(), window_), nullptr));
    return reply && reply->map_state == XCB_MAP_STATE_VIEWABLE;
  }

  [[nodiscard]] render::Image8 screenshot() const {
    const render::Image8 all = screen_.screenshot();
    const Place at = place();
    render::Image8 part = render::black_image(at.width, at.height);
    for (int y = 0; y < at.height; ++y) {
      const auto from = 3 * static_cast<std::ptrdiff_t>((y + at.y) * all.width + at.x);
      std::copy_n(all.rgb.begin() + from, 3 * at.width,
                  part.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(y) * at.width);
    }
    return part;
  }

  void press(xcb_keysym_t key) const {
    xcb_key_press_event_t event{};
    event.response_type = XCB_KEY_PRESS;
    event.detail = code_of(key);
    event.root = screen_.root();
    event.event = window_;
    event.same_screen = 1;
    send(event, XCB_EVENT_MASK_KEY_PRESS);
    event.response_type = XCB_KEY_RELEASE;
    send(event, XCB_EVENT_MASK_KEY_RELEASE);
  }

  // As the button in a window's frame does.
  void ask_to_close() const {
    xcb_client_message_event_t event{};
    event.response_type = XCB_CLIENT_MESSAGE;
    event.format = 32;
    event.window = window_;
    event.type = atom("WM_PROTOCOLS");
    event.data.data32[0] = atom("WM_DELETE_WINDOW");
    send(event, XCB_EVENT_MASK_NO_EVENT);
  }

  void resize(std::uint32_t width, std::uint32_t height) const {
    const std::uint32_t values[2]{width, height};
    xcb_configure_window(wire(), window_, XCB_CONFIG_WINDOW_WIDTH | XCB_CONFIG_WINDOW_HEIGHT, values);
    xcb_flush(wire());
  }

  void unmap() const {
    xcb_unmap_window(wire(), window_);
    xcb_flush(wire());
  }
  void map() const {
    xcb_map_window(wire(), window_);
    xcb_flush(wire());
  }

 private:
  template <class Reply>
  static std::unique_ptr<Reply, decltype(&std::free)> take(Reply* reply) {
    return {reply, &std::free};
  }

  [[nodiscard]] xcb_connection_t* wire() const { return screen_.connection(); }

  [[nodiscard]] std::optional<xcb_window_t> find(std::string_view title) const {
    const auto tree = take(xcb_query_tree_reply(wire(), xcb_query_tree(wire(), screen_.root()), nullptr));
    for (int i = 0; tree && i < xcb_query_tree_children_length(tree.get()); ++i) {
      const xcb_window_t window = xcb_query_tree_children(tree.get())[i];
      const auto name = take(xcb_get_property_reply(
          wire(), xcb_get_property(wire(), 0, window, XCB_ATOM_WM_NAME, XCB_GET_PROPERTY_TYPE_ANY, 0, 256), nullptr));
      if (name && std::string_view(static_cast<const char*>(xcb_get_property_value(name.get())),
                                   static_cast<std::size_t>(xcb_get_property_value_length(name.get()))) == title) {
        return window;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] xcb_keycode_t code_of(xcb_keysym_t key) const {
    const xcb_setup_t* setup = xcb_get_setup(wire());
    const xcb_keycode_t least = setup->min_keycode;
    const auto count = static_cast<std::uint8_t>(setup->max_keycode - least + 1);
    const auto reply =
        take(xcb_get_keyboard_mapping_reply(wire(), xcb_get_keyboard_mapping(wire(), least, count), nullptr));
    for (int i = 0; reply && i < count; ++i) {
      if (xcb_get_keyboard_mapping_keysyms(reply.get())[i * reply->keysyms_per_keycode] == key) {
        return static_cast<xcb_keycode_t>(least + i);
      }
    }
    throw std::runtime_error("no such key");
  }

  [[nodiscard]] xcb_atom_t atom(std::string_view name) const {
    const auto cookie = xcb_intern_atom(wire(), 0, static_cast<std::uint16_t>(name.size()), name.data());
    const auto reply = take(xcb_intern_atom_reply(wire(), cookie, nullptr));
    return reply ? reply->atom : xcb_atom_t{XCB_ATOM_NONE};
  }

  template <class Event>
  void send(const Event& event, std::uint32_t mask) const {
    char bytes[32]{};  // of every event on the wire
    static_assert(sizeof(event) <= sizeof(bytes));
    std::memcpy(bytes, &event, sizeof(event));
    xcb_send_event(wire(), 0, window_, mask, bytes);
    xcb_flush(wire());
  }

  const XScreen& screen_;
  xcb_window_t window_ = XCB_WINDOW_NONE;
};

}  // namespace support
