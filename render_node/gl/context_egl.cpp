#include "render_node/gl/gl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <string>

namespace omentum::render::gl {
namespace {

// libepoxy ends the process where a library is missing.
void require_library(const char* name, const char* package) {
  void* const library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    throw DisplayError(std::string("off-screen pictures: ") + name + " cannot be loaded (is " + package +
                       " installed?)");
  dlclose(library);
}

// Mesa's surfaceless platform needs no display server and no graphics device; a device of the machine is next
// (drivers that know no surfaceless platform); last the default display.
EGLDisplay find_display() {
  require_library("libEGL.so.1", "libegl1");
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 8> devices{};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint d = 0; d < count; ++d) {
      const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[d], nullptr);
      if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
    }
  }
  const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  throw DisplayError("off-screen pictures: EGL found no display to draw with (is libegl-mesa0 installed?)");
}

std::string hexadecimal(EGLint error) {
  std::array<char, 12> text{};
  std::snprintf(text.data(), text.size(), "0x%04x", static_cast<unsigned>(error));
  return text.data();
}

class EglContext final : public GlContext {
 public:
  explicit EglContext(Size size) : size_(size), display_(find_display()) {
    try {
      create();
    } catch (...) {
      release();
      throw;
    }
  }
  ~EglContext() override { release(); }

  Size size() const override { return size_; }
  bool has_window() const override { return false; }
  void start_panel() override {}
  void stop_panel() override {}

  Input begin_frame() override {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size_.width), static_cast<float>(size_.height)};
    io.DeltaTime = 1.0f / 30;  // nothing in the panel of a picture moves by itself
    return {};
  }
  void end_frame() override { glFinish(); }

 private:
  void create() {
    constexpr std::array<EGLint, 7> kConfig{
        EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_NONE};
    constexpr std::array<EGLint, 7> kVersion{EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
    constexpr std::array<EGLint, 5> kOnePixel{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display_, kConfig.data(), &config, 1, &count) ||
        count == 0) {
      throw DisplayError("off-screen pictures: EGL offers no OpenGL here, error " +
                         hexadecimal(eglGetError()));
    }
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, kVersion.data());
    if (context_ == EGL_NO_CONTEXT) {
      throw DisplayError("off-screen pictures: EGL refused an OpenGL 3.3 core context, error " +
                         hexadecimal(eglGetError()));
    }
    // pictures go to a framebuffer of our own; some drivers still want a surface
    if (!epoxy_has_egl_extension(display_, "EGL_KHR_surfaceless_context")) {
      surface_ = eglCreatePbufferSurface(display_, config, kOnePixel.data());
    }
    if (!eglMakeCurrent(display_, surface_, surface_, context_)) {
      throw DisplayError("off-screen pictures: EGL cannot use its OpenGL context, error " +
                         hexadecimal(eglGetError()));
    }
  }

  void release() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }

  Size size_;
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace

std::unique_ptr<GlContext> open_egl_context(Size size) {
  return std::make_unique<EglContext>(size);
}

}  // namespace omentum::render::gl
