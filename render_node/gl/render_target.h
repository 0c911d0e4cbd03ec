// Framebuffers: the multisampled one that the scene is drawn into, and the plain one it is resolved to.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render::gl {

/// Owns a framebuffer with colour (and depth if asked), `samples` per pixel (0: plain).
class RenderTarget {
 public:
  RenderTarget(Size size, int samples, bool with_depth);
  ~RenderTarget();
  RenderTarget(const RenderTarget&) = delete;
  RenderTarget& operator=(const RenderTarget&) = delete;

  unsigned framebuffer() const { return framebuffer_; }
  /// What was drawn, smooth between its pixels; 0 with several samples per pixel.
  unsigned texture() const { return texture_; }
  Size size() const { return size_; }

 private:
  void attach_texture();

  Size size_;
  unsigned framebuffer_ = 0, texture_ = 0, colour_ = 0, depth_ = 0;
};

/// Owns a square depth texture that is compared when sampled.
class ShadowMap {
 public:
  explicit ShadowMap(int side);
  ~ShadowMap();
  ShadowMap(const ShadowMap&) = delete;
  ShadowMap& operator=(const ShadowMap&) = delete;

  void begin() const;  // binds and clears it
  void bind_texture(int unit) const;

 private:
  int side_;
  unsigned framebuffer_ = 0, texture_ = 0;
};

}  // namespace omentum::render::gl
