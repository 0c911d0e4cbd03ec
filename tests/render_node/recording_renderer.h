// A renderer that draws nothing and remembers everything.
#pragma once

#include "render_node/renderer.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace omentum::render {

class RecordingRenderer final : public Renderer {
 public:
  explicit RecordingRenderer(Size size = {960, 600}) : size_(size) {}

  MeshId add_mesh(const MeshData& mesh) override {
    meshes.push_back(mesh);
    return static_cast<MeshId>(meshes.size() - 1);
  }
  void update_vertices(MeshId id, std::span<const Vertex> vertices) override {
    MeshData& mesh = meshes.at(static_cast<std::size_t>(id));
    if (vertices.size() != mesh.vertices.size()) throw std::logic_error("another number of vertices");
    mesh.vertices.assign(vertices.begin(), vertices.end());
    ++updates;
  }
  void update_triangles(MeshId id, std::size_t first, std::span<const MeshTriangle> triangles) override {
    MeshData& mesh = meshes.at(static_cast<std::size_t>(id));
    if (first + triangles.size() > mesh.triangles.size())
      throw std::logic_error("more triangles than there are");
    std::copy(triangles.begin(), triangles.end(),
              mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first));
    triangles_sent += triangles.size();
  }
  void replace_mesh(MeshId id, const MeshData& with) override {
    meshes.at(static_cast<std::size_t>(id)) = with;
    triangles_sent += with.triangles.size();
  }
  TubeId add_tube() override {
    tubes.emplace_back();
    return static_cast<TubeId>(tubes.size() - 1);
  }
  void update_tube(TubeId id, std::span<const SkinFrame> frames) override {
    tubes.at(static_cast<std::size_t>(id)).assign(frames.begin(), frames.end());
    ++updates;
  }
  Input begin_frame() override { return on_begin_frame ? on_begin_frame() : Input{}; }
  Pointer look_at_pointer() override { return on_look ? on_look() : Pointer{}; }
  void draw(const Frame& frame) override {
    frames.push_back(frame);
    if (frame.with_panel && on_panel) on_panel();
  }
  Picture read_back() override {
    read_back_from.push_back(frames.size() - 1);
    return {size_, std::vector<std::uint8_t>(4u * size_.width * size_.height)};
  }
  void end_frame() override {}
  Size size() const override { return size_; }
  bool has_window() const override { return windowed; }

  const MeshData& mesh_of(const DrawItem& item) const {
    return meshes.at(static_cast<std::size_t>(item.mesh));
  }

  std::vector<MeshData> meshes;
  std::vector<std::vector<SkinFrame>> tubes;
  std::vector<Frame> frames;
  int updates = 0;
  std::size_t triangles_sent = 0;           // of meshes that were added before
  std::vector<std::size_t> read_back_from;  // numbers of the frames that became pictures

  // a scripted person at a window
  bool windowed = false;
  std::function<Input()> on_begin_frame;
  std::function<Pointer()> on_look;
  std::function<void()> on_panel;

 private:
  Size size_;
};

}  // namespace omentum::render
