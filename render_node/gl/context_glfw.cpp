#include "render_node/gl/gl_context.h"
#include "render_node/gl/pointer_reader.h"
#include "render_node/gl/window_keys.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace omentum::render::gl {
namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

class GlfwContext final : public GlContext {
 public:
  GlfwContext(Size size, const std::string& title) {
    if (!glfwInit()) throw DisplayError("window: " + last_glfw_error());
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    // the scene is drawn into a framebuffer of our own; what a window had beside its colours would be kept
    // up to date at each pixel
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
    if (!window_) {
      const std::string reason = last_glfw_error();
      glfwTerminate();
      throw DisplayError("window: " + reason);
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(
        0);  // the render loop keeps the pace; waiting for the screen would add its period to the latency
    glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE);  // a key that is tapped between two frames counts
    glfwSetWindowUserPointer(window_, this);
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double y) {
      static_cast<GlfwContext*>(glfwGetWindowUserPointer(w))->scrolled_ += static_cast<float>(y);
    });
    // told, not asked: on a slow machine a key is up again before the next frame
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int modifiers) {
      if (action != GLFW_PRESS) return;
      static_cast<GlfwContext*>(glfwGetWindowUserPointer(w))
          ->typed_.add(letter_of(key, modifiers, glfwGetKeyName(key, scancode)));
    });
  }
  ~GlfwContext() override {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  Size size() const override {
    Size size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return {std::max(size.width, 1), std::max(size.height, 1)};  // 0 while minimized
  }
  bool has_window() const override { return true; }
  float content_scale() const override {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::max(x, y);
  }
  void start_panel() override {
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
  }  // after our own callbacks: it chains them
  void stop_panel() override { ImGui_ImplGlfw_Shutdown(); }

  Input begin_frame() override {
    glfwPollEvents();
    ImGui_ImplGlfw_NewFrame();
    Input input;
    input.close = glfwWindowShouldClose(window_);
    const Mouse mouse = read_mouse();
    const ImGuiIO& io = ImGui::GetIO();
    if (!io.WantCaptureMouse) {
      const auto dx = static_cast<float>(mouse.x - mouse_.x), dy = static_cast<float>(mouse.y - mouse_.y);
      if (mouse.left && mouse_.left) input.orbit_x = dx, input.orbit_y = dy;
      if (mouse.other && mouse_.other) input.pan_x = dx, input.pan_y = dy;
      input.zoom = scrolled_;
    }
    input.pointer = read_pointer();
    input.keys = std::exchange(typed_, KeyPresses{});
    mouse_ = mouse;
    scrolled_ = seen_scrolled_ = 0;
    return input;
  }
  void end_frame() override { glfwSwapBuffers(window_); }
  Pointer look_at_pointer() override {
    glfwPollEvents();
    return read_pointer();
  }

 private:
  struct Mouse {
    double x = 0, y = 0;
    bool left = false, other = false;
  };
  Pointer read_pointer() {
    const Pointer pointer =
        pointer_reader_.read(window_, scrolled_ - seen_scrolled_, ImGui::GetIO().WantCaptureMouse);
    seen_scrolled_ = scrolled_;
    return pointer;
  }
  Mouse read_mouse() const {
    Mouse mouse;
    glfwGetCursorPos(window_, &mouse.x, &mouse.y);
    const auto down = [&](int button) { return glfwGetMouseButton(window_, button) == GLFW_PRESS; };
    mouse.left = down(GLFW_MOUSE_BUTTON_LEFT);
    mouse.other = down(GLFW_MOUSE_BUTTON_RIGHT) || down(GLFW_MOUSE_BUTTON_MIDDLE);
    return mouse;
  }

  GLFWwindow* window_ = nullptr;
  Mouse mouse_;
  PointerReader pointer_reader_;
  float scrolled_ = 0, seen_scrolled_ = 0;  // since the last frame, and of that by who looked at the pointer
  KeyPresses typed_;                        // since the last frame
};

}  // namespace

std::unique_ptr<GlContext> open_glfw_context(Size size, const std::string& title) {
  return std::make_unique<GlfwContext>(size, title);
}

}  // namespace omentum::render::gl
