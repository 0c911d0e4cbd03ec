// A block as an organ, and a scene around it, in files.
#pragma once

#include "organ/organ.h"
#include "transport/messages.h"

#include "tests/support/process.h"

#include <string>

namespace omentum::test {

/// A block of 10 cm, soft tissue, held at z = 0, in a folder of its own.
class BlockScene {
 public:
  /// m
  static constexpr double kSide = 0.1;
  /// One probe of one point.
  static constexpr const char* kProbe =
      "[[tools]]\nid = 0\nname = \"probe\"\nshape = \"probe\"\npoints = [[0,0,0]]\n";

  /// `cells` along each side. `tools`: of the scene, as it is written in its file.
  explicit BlockScene(int cells, const std::string& tools = kProbe);

  std::string scene() const { return folder_ / "scene.toml"; }
  std::string report() const { return folder_ / "report.json"; }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  /// As a node loads it, with its tensors.
  organ::Organ organ() const { return organ::load_organ(file("block.h5"), organ::Load::kWithTensors); }
  const std::string& organ_hash() const { return hash_; }
  /// What a deform_node tells that serves this scene with the organ file of that hash.
  msg::SceneInfo info(const std::string& organ_hash) const;
  msg::SceneInfo info() const { return info(hash_); }
  /// The file of the same scene but for a few letters.
  std::string scene_with(const std::string& text, const std::string& instead) const;

 private:
  ScratchFolder folder_;
  std::string hash_;
};

}  // namespace omentum::test
