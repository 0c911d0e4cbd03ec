#include "organ_tools/organ_solve/solution_csv.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace omentum::organ_tools {

namespace {

using geometry::Vec3;

void append_row(std::string& text, std::int32_t node, const Vec3& v) {
  char row[100];
  std::snprintf(row, sizeof row, "%d,%.12e,%.12e,%.12e\n", node, v.x(), v.y(), v.z());
  text += row;
}

[[noreturn]] void refuse(const std::string& file) {
  throw geometry::InputError(file + ": cannot be written: " + std::strerror(errno));
}

// A file that is written beside its place; it vanishes unless it was moved there.
class PartialFile {
 public:
  PartialFile(std::string file, const std::string& text)
      : file_(std::move(file)), partial_(file_ + ".partial-" + std::to_string(getpid())) {
    if (std::filesystem::is_directory(file_)) {
      errno = EISDIR;
      refuse(file_);
    }
    std::FILE* out = std::fopen(partial_.c_str(), "w");
    if (out == nullptr) refuse(file_);
    bool whole = std::fwrite(text.data(), 1, text.size(), out) == text.size();
    whole = std::fclose(out) == 0 && whole;
    if (whole) return;
    const int reason = errno;
    std::remove(partial_.c_str());
    errno = reason;
    refuse(file_);
  }
  ~PartialFile() { std::remove(partial_.c_str()); }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  void move_to_its_place() {
    if (std::rename(partial_.c_str(), file_.c_str()) != 0) refuse(file_);
  }

 private:
  std::string file_, partial_;
};

}  // namespace

void write_solution(const std::string& prefix, const organ::Organ& organ, Imposed imposed,
                    const physics::StaticSolution& solution) {
  std::vector<Vec3> by_file_node(organ.mesh.file_node_count, Vec3::Zero());
  for (std::size_t n = 0; n < solution.displacements.size(); ++n) {
    by_file_node[organ.mesh.file_node[n]] = solution.displacements[n];
  }
  std::string displacements = "node,ux,uy,uz\n";
  for (std::size_t n = 0; n < by_file_node.size(); ++n) {
    append_row(displacements, static_cast<std::int32_t>(n), by_file_node[n]);
  }
  std::string forces = "node,fx,fy,fz\n";
  for (std::size_t i = 0; i < imposed.size(); ++i) {
    append_row(forces, organ.mesh.file_node[imposed[i].node], solution.holding_forces[i]);
  }
  // nothing is in its place before both are whole
  PartialFile u(prefix + ".u.csv", displacements), f(prefix + ".f.csv", forces);
  u.move_to_its_place();
  f.move_to_its_place();
}

}  // namespace omentum::organ_tools
