#include "organ_tools/numbering_option.h"

namespace omentum::organ_tools {

void add_numbering_option(runtime::CommandLine& line, geometry::Numbering& numbering) {
  const auto take = [&numbering](const std::string& text) -> std::string {
    if (text != "file" && text != "position") return "found " + text + ", expected file or position";
    numbering = text == "file" ? geometry::Numbering::kFile : geometry::Numbering::kPosition;
    return {};
  };
  line.option(
          "--numbering", take,
          "what node and tetrahedron numbers mean, in tables and messages: file, the mesh file's own (Gmsh's "
          "tags, .node and .ele indices, VTK from 0; default), or position, places in the file from 0")
      .type_name("KIND");
}

}  // namespace omentum::organ_tools
