// Gmsh's mesh files: https://gmsh.info/doc/texinfo/gmsh.html, sections "MSH file format" (4.1, and the legacy
// versions 1, 2 and 4.0).
#include "geometry/mesh_io/file_cursor.h"
#include "geometry/mesh_io/mesh_formats.h"
#include "geometry/region_labels.h"

#include <unordered_map>
#include <unordered_set>

namespace omentum::geometry {
namespace {

constexpr std::size_t kCorners = 4;  // of a tetrahedron

class GmshReader {
 public:
  explicit GmshReader(const std::filesystem::path& file) : in_(file) { mesh_.source = in_.name(); }

  RawMesh read();

 private:
  void read_format();
  void read_nodes_1_and_2();
  void read_nodes_4();
  void read_entities();
  void read_elements_1();
  void read_elements_2();
  void read_elements_4();
  void skip_section(std::string_view name);

  // One value, as text or in the binary type that the version prescribes for it.
  std::int64_t integer(const char* expected) {
    return binary_ ? in_.binary<std::int32_t>(expected) : in_.integer(expected);
  }
  std::int64_t size(const char* expected) {
    return binary_ ? static_cast<std::int64_t>(in_.binary<std::uint64_t>(expected)) : in_.integer(expected);
  }
  // Gmsh 4.1 widened node and element numbers.
  std::int64_t number(const char* expected) { return version_ > 4.05 ? size(expected) : integer(expected); }
  double real(const char* expected) { return binary_ ? in_.binary<double>(expected) : in_.real(expected); }
  Vec3 point() {
    const double x = real("x of a node"), y = real("y of a node"), z = real("z of a node");
    return {x, y, z};
  }

  std::size_t checked_count(std::int64_t value, const char* expected) const;
  void add_node(std::int64_t number, const Vec3& position);
  std::vector<std::int32_t> read_physical_groups();
  std::int32_t label_of_volume(std::int64_t tag);
  std::int32_t label(const char* expected) { return checked_label(in_, integer(expected), expected); }
  void read_element_nodes(std::int64_t element, std::int64_t type, std::int32_t region);
  std::int32_t index_of(std::int64_t number, std::int64_t element) const;

  FileCursor in_;
  RawMesh mesh_;
  double version_ = 1.0;
  bool binary_ = false;
  std::unordered_map<std::int64_t, std::int32_t> index_of_number_;
  std::unordered_set<std::int64_t> tetrahedron_numbers_;
  std::unordered_map<std::int64_t, std::vector<std::int32_t>> groups_of_volume_;  // Gmsh 4
};

RawMesh GmshReader::read() {
  while (!in_.at_end()) {
    const std::string_view section = in_.word("a section such as $Nodes");
    if (section == "$MeshFormat") {
      read_format();
    } else if (section == "$NOD" || (section == "$Nodes" && version_ < 4)) {
      read_nodes_1_and_2();
    } else if (section == "$Nodes") {
      read_nodes_4();
    } else if (section == "$Entities") {
      read_entities();
    } else if (section == "$ELM") {
      read_elements_1();
    } else if (section == "$Elements") {
      version_ < 4 ? read_elements_2() : read_elements_4();
    } else if (section.starts_with("$")) {
      skip_section(section);
    } else {
      in_.fail("text outside a section", "a section such as $MeshFormat, $Nodes or $Elements");
    }
  }
  if (mesh_.positions.empty())
    throw InputError(mesh_.source + ": found no nodes, expected a section $Nodes or $NOD");
  return std::move(mesh_);
}

void GmshReader::read_format() {
  version_ = in_.real("the version of the format");
  binary_ = in_.integer("0 (ASCII) or 1 (binary)") != 0;
  const std::int64_t real_size = in_.integer("the size of a real number, 8");
  if (!((version_ >= 2 && version_ < 3) || (version_ >= 4 && version_ < 5))) {
    in_.fail("version " + std::to_string(version_), "version 2.x or 4.x");
  }
  if (real_size != 8) in_.fail("real numbers of " + std::to_string(real_size) + " bytes", "8");
  if (binary_) {
    in_.rest_of_line();
    if (in_.binary<std::int32_t>("the number 1") != 1) in_.fail("another byte order", "this machine's");
  }
  if (in_.word("$EndMeshFormat") != "$EndMeshFormat") in_.fail("something else", "$EndMeshFormat");
}

std::size_t GmshReader::checked_count(std::int64_t value, const char* expected) const {
  if (value < 0 || static_cast<std::size_t>(value) > in_.remaining())
    in_.fail(std::to_string(value), expected);
  return static_cast<std::size_t>(value);
}

void GmshReader::add_node(std::int64_t number, const Vec3& position) {
  const auto index = static_cast<std::int32_t>(mesh_.positions.size());
  if (!index_of_number_.emplace(number, index).second) {
    in_.fail("node number " + std::to_string(number) + " twice", "each once");
  }
  mesh_.positions.push_back(position);
  mesh_.node_numbers.push_back(number);
}

void GmshReader::read_nodes_1_and_2() {
  const std::size_t count = in_.count("the number of nodes");
  if (binary_) in_.rest_of_line();
  mesh_.positions.reserve(count);
  index_of_number_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t number = integer("a node number");
    add_node(number, point());
  }
  in_.word("$EndNodes or $ENDNOD");
}

void GmshReader::read_nodes_4() {
  if (binary_) in_.rest_of_line();
  const std::size_t blocks = checked_count(size("the number of node blocks"), "the number of node blocks");
  const std::size_t count = checked_count(size("the number of nodes"), "the number of nodes");
  const bool numbers_first = version_ > 4.05;
  if (numbers_first) {
    size("the smallest node number");
    size("the largest node number");
  }
  index_of_number_.reserve(count);
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::int64_t first = integer("an entity's tag or dimension");
    const std::int64_t second = integer("an entity's dimension or tag");
    const std::int64_t dimension = numbers_first ? first : second;
    const bool parametric = integer("the parametric flag") != 0;
    const std::size_t in_block =
        checked_count(size("the number of nodes in this block"), "a number of nodes");
    std::vector<std::int64_t> numbers;
    for (std::size_t i = 0; numbers_first && i < in_block; ++i) numbers.push_back(number("a node number"));
    for (std::size_t i = 0; i < in_block; ++i) {
      const std::int64_t node_number = numbers_first ? numbers[i] : number("a node number");
      add_node(node_number, point());
      for (std::int64_t d = 0; parametric && d < dimension; ++d) real("a parametric coordinate");
    }
  }
  in_.word("$EndNodes");
}

std::int32_t GmshReader::index_of(std::int64_t number, std::int64_t element) const {
  const auto found = index_of_number_.find(number);
  if (found == index_of_number_.end()) {
    in_.fail("node number " + std::to_string(number) + " in tetrahedron " + std::to_string(element),
             "the number of a node listed before");
  }
  return found->second;
}

std::vector<std::int32_t> GmshReader::read_physical_groups() {
  const std::size_t count =
      checked_count(size("the number of physical groups"), "the number of physical groups");
  std::vector<std::int32_t> groups;
  for (std::size_t i = 0; i < count; ++i) groups.push_back(label("a physical group"));
  return groups;
}

// Points, curves, surfaces, volumes: each a tag, its place or box, its groups, and but for points its
// boundary.
void GmshReader::read_entities() {
  if (binary_) in_.rest_of_line();
  std::array<std::size_t, 4> counts{};
  for (std::size_t& count : counts)
    count = checked_count(size("the number of entities"), "the number of entities");
  for (std::size_t dimension = 0; dimension < counts.size(); ++dimension) {
    const int reals = dimension == 0 && version_ > 4.05 ? 3 : 6;
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      const std::int64_t tag = integer("an entity's tag");
      for (int r = 0; r < reals; ++r) real("a coordinate of an entity's box");
      std::vector<std::int32_t> groups = read_physical_groups();
      if (dimension == 3) groups_of_volume_[tag] = std::move(groups);
      if (dimension == 0) continue;
      const std::size_t bounding =
          checked_count(size("the number of bounding entities"), "the number of bounding entities");
      for (std::size_t b = 0; b < bounding; ++b) integer("a bounding entity's tag");
    }
  }
  in_.word("$EndEntities");
}

std::int32_t GmshReader::label_of_volume(std::int64_t tag) {
  const auto found = groups_of_volume_.find(tag);
  if (found == groups_of_volume_.end() || found->second.empty()) return 0;
  const std::vector<std::int32_t>& groups = found->second;
  if (groups.size() > 1) {
    mesh_.why_no_regions = "volume " + std::to_string(tag) + " is in physical groups " +
                           std::to_string(groups[0]) + " and " + std::to_string(groups[1]) +
                           ", expected one for each tetrahedron";
  }
  return groups.front();
}

void GmshReader::read_element_nodes(std::int64_t element, std::int64_t type, std::int32_t region) {
  const auto [kind, count] = gmsh_element(type);
  if (count == 0)
    in_.fail("element type " + std::to_string(type), "one that Gmsh's manual lists (1 to 31, 92, 93)");
  const bool solid = kind == ElementKind::kTetrahedron;
  std::array<std::int32_t, kCorners> tetrahedron{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const std::int64_t node = number("a node of an element");
    if (solid && i < kCorners) tetrahedron[i] = index_of(node, element);
  }
  if (!solid) {
    ++mesh_.others[static_cast<std::size_t>(kind)];
    return;
  }
  // other elements have no number outside of their file
  if (!tetrahedron_numbers_.insert(element).second)
    in_.fail("tetrahedron number " + std::to_string(element) + " twice", "each once");
  mesh_.tetrahedra.push_back(tetrahedron);
  mesh_.tetrahedron_numbers.push_back(element);
  mesh_.regions.push_back(region);
  if (static_cast<std::size_t>(count) > kCorners) ++mesh_.curved;
}

void GmshReader::read_elements_1() {
  const std::size_t count = in_.count("the number of elements");
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t element = in_.integer("an element number");
    const std::int64_t type = in_.integer("an element type");
    const std::int32_t region = label("a physical region");
    in_.integer("an elementary region");
    in_.integer("the number of nodes of an element");
    read_element_nodes(element, type, region);
  }
  in_.word("$ENDELM");
}

void GmshReader::read_elements_2() {
  const std::size_t count = in_.count("the number of elements");
  if (binary_) in_.rest_of_line();
  for (std::size_t i = 0; i < count;) {
    // Binary files group elements of one type behind a header; text has one per line, number first.
    std::int64_t in_group = 1, element = 0;
    if (!binary_) element = integer("an element number");
    const std::int64_t type = integer("an element type");
    if (binary_) in_group = integer("the number of elements in this group");
    const std::size_t tags = checked_count(integer("the number of tags"), "the number of tags");
    if (in_group < 1) in_.fail(std::to_string(in_group) + " elements in a group", "at least 1");
    for (std::int64_t e = 0; e < in_group; ++e, ++i) {
      if (binary_) element = integer("an element number");
      // the first tag is the physical group, 0 without one
      const std::int32_t region = tags > 0 ? label("a tag of an element") : 0;
      for (std::size_t t = 1; t < tags; ++t) integer("a tag of an element");
      read_element_nodes(element, type, region);
    }
  }
  in_.word("$EndElements");
}

void GmshReader::read_elements_4() {
  if (binary_) in_.rest_of_line();
  const std::size_t blocks =
      checked_count(size("the number of element blocks"), "the number of element blocks");
  size("the number of elements");
  if (version_ > 4.05) {
    size("the smallest element number");
    size("the largest element number");
  }
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::int64_t first = integer("an entity's tag or dimension");
    const std::int64_t second = integer("an entity's dimension or tag");
    const auto [dimension, tag] = version_ > 4.05 ? std::pair(first, second) : std::pair(second, first);
    const std::int32_t region = dimension == 3 ? label_of_volume(tag) : 0;
    const std::int64_t type = integer("an element type");
    const std::size_t in_block =
        checked_count(size("the number of elements in this block"), "a number of elements");
    for (std::size_t e = 0; e < in_block; ++e) {
      const std::int64_t element = number("an element number");
      read_element_nodes(element, type, region);
    }
  }
  in_.word("$EndElements");
}

// Sections that say nothing about tetrahedra (names, data) may hold binary data: look for their end
// mark.
void GmshReader::skip_section(std::string_view name) {
  const std::string end = "$End" + std::string(name.substr(1));
  if (!in_.skip_past(end)) in_.fail("no end of section " + std::string(name), end);
}

}  // namespace

RawMesh read_gmsh(const std::filesystem::path& file) {
  return GmshReader(file).read();
}

}  // namespace omentum::geometry
