// TetGen's .node and .ele: https://wias-berlin.de/software/tetgen/fformats.html
#include "geometry/mesh_io/file_cursor.h"
#include "geometry/mesh_io/file_kind.h"
#include "geometry/mesh_io/mesh_formats.h"
#include "geometry/region_labels.h"

#include <cctype>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <sstream>
#include <unordered_set>

namespace omentum::geometry {
namespace {

// Comments run from # to the end of their line.
void skip_comments(FileCursor& in) {
  while (!in.at_end() && in.next_is('#')) in.rest_of_line();
}

// Where counting begins is 0 or 1 by the manual; some write other numbers, none of which may overflow it.
std::int64_t checked_first(const FileCursor& in, std::int64_t number) {
  constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
  if (number < 0 || number > kLargest)
    in.fail("node number " + std::to_string(number), "0 or 1 for the first node");
  return number;
}

// The first node's number is that of all counting in both files.
std::int64_t read_nodes(FileCursor& in, RawMesh& mesh) {
  skip_comments(in);
  const std::size_t count = in.count("the number of nodes");
  if (in.integer("the dimension, 3") != 3) in.fail("another dimension", "3");
  in.rest_of_line();
  std::int64_t first = 0;
  for (std::size_t n = 0; n < count; ++n) {
    skip_comments(in);
    const std::int64_t number = in.integer("a node number");
    if (n == 0) first = checked_first(in, number);
    if (number != first + static_cast<std::int64_t>(n)) {
      in.fail("node number " + std::to_string(number), std::to_string(first + static_cast<std::int64_t>(n)));
    }
    const double x = in.real("x of a node"), y = in.real("y of a node"), z = in.real("z of a node");
    mesh.positions.emplace_back(x, y, z);
    mesh.node_numbers.push_back(number);
    in.rest_of_line();
  }
  return first;
}

// Words of a line up to a comment.
std::vector<std::string> words_of(std::string_view line) {
  std::istringstream text{std::string(line.substr(0, line.find('#')))};
  return {std::istream_iterator<std::string>(text), {}};
}

std::int64_t attribute_count(std::string_view rest_of_header) {
  const std::vector<std::string> words = words_of(rest_of_header);
  return words.empty() ? 0 : std::atoll(words.front().c_str());
}

// The region is the last attribute (TetGen's switch -A), behind the nodes between corners.
void read_region(std::string_view rest_of_line, std::int64_t middle_nodes, std::int64_t attributes,
                 RawMesh& mesh) {
  if (attributes < 1) return;
  const std::vector<std::string> words = words_of(rest_of_line);
  const std::int64_t at = middle_nodes + attributes - 1;
  const auto label = at < std::ssize(words) ? label_in(words[static_cast<std::size_t>(at)]) : std::nullopt;
  if (!label) {
    mesh.why_no_regions = "the last attribute of tetrahedron " +
                          std::to_string(mesh.tetrahedron_numbers.back()) + " is no whole number";
  }
  mesh.regions.push_back(label.value_or(0));
}

void read_tetrahedra(FileCursor& in, std::int64_t first, RawMesh& mesh) {
  skip_comments(in);
  const std::size_t count = in.count("the number of tetrahedra");
  const std::int64_t nodes = in.integer("the number of nodes of a tetrahedron, 4 or 10");
  if (nodes != 4 && nodes != 10) in.fail(std::to_string(nodes) + " nodes a tetrahedron", "4 or 10");
  if (nodes == 10) mesh.curved = count;
  const std::int64_t attributes = attribute_count(in.rest_of_line());
  std::unordered_set<std::int64_t> own_numbers;
  for (std::size_t t = 0; t < count; ++t) {
    skip_comments(in);
    const std::int64_t own_number = in.integer("a tetrahedron's number");
    if (!own_numbers.insert(own_number).second)
      in.fail("tetrahedron number " + std::to_string(own_number) + " twice", "each once");
    std::array<std::int32_t, 4> tetrahedron{};
    for (std::int32_t& node : tetrahedron) {
      const std::int64_t number = in.integer("a node of a tetrahedron");
      if (number < first || number - first >= std::ssize(mesh.positions)) {
        in.fail("node number " + std::to_string(number) + " in tetrahedron " + std::to_string(own_number),
                "a number of the .node file");
      }
      node = static_cast<std::int32_t>(number - first);
    }
    mesh.tetrahedra.push_back(tetrahedron);
    mesh.tetrahedron_numbers.push_back(own_number);
    read_region(in.rest_of_line(), nodes - 4, attributes, mesh);
  }
}

}  // namespace

std::array<std::filesystem::path, 2> tetgen_pair(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const bool capitals = extension.size() > 1 && std::isupper(static_cast<unsigned char>(extension[1]));
  const auto beside = [&](const char* small, const char* capital) {
    const auto with = [&](const char* other) { return std::filesystem::path(file).replace_extension(other); };
    const std::filesystem::path likely = with(capitals ? capital : small),
                                other = with(capitals ? small : capital);
    return !std::filesystem::exists(likely) && std::filesystem::exists(other) ? other : likely;
  };
  std::array<std::filesystem::path, 2> pair = {beside(".node", ".NODE"), beside(".ele", ".ELE")};
  const bool is_node = extension.size() == 5;
  pair[is_node ? 0 : 1] = file;
  return pair;
}

RawMesh read_tetgen(const std::filesystem::path& file) {
  RawMesh mesh;
  mesh.source = file.string();
  const auto [node_file, element_file] = tetgen_pair(file);
  for (const std::filesystem::path& part : {node_file, element_file}) {
    if (const std::string found = foreign_kind(part); !found.empty())
      throw InputError(part.string() + ": found " + found + ", expected TetGen's .node and .ele (text)");
  }
  FileCursor nodes(node_file);
  const std::int64_t first = read_nodes(nodes, mesh);
  FileCursor elements(element_file);
  read_tetrahedra(elements, first, mesh);
  return mesh;
}

}  // namespace omentum::geometry
