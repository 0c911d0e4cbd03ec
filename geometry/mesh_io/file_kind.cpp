#include "geometry/mesh_io/file_kind.h"

#include "geometry/mesh_io/byte_order_mark.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>

namespace omentum::geometry {
namespace {

constexpr std::size_t kHead = 1024;

struct Signature {
  std::string_view bytes;
  const char* words;
  std::size_t at = 0;
};

constexpr Signature kSignatures[] = {
    {"\x1f\x8b", "gzip-compressed data (gunzip unpacks it)"},
    {"BZh", "bzip2-compressed data"},
    {"\xfd"
     "7zXZ",
     "xz-compressed data"},
    {"\x28\xb5\x2f\xfd", "zstd-compressed data"},
    {"PK\x03\x04", "a zip archive"},
    {"7z\xbc\xaf\x27\x1c", "a 7z archive"},
    {"\x89HDF\r\n", "HDF5 data (an organ file, netCDF-4, ExodusII, MED ...)"},
    {"CDF\x01", "netCDF data (ExodusII ...)"},
    {"CDF\x02", "netCDF data (ExodusII ...)"},
    {"CDF\x05", "netCDF data (ExodusII ...)"},
    {"\xff\xfe", "UTF-16 text (save it as UTF-8)"},
    {"\xfe\xff", "UTF-16 text (save it as UTF-8)"},
    {"\x89PNG", "a PNG picture"},
    {"\xff\xd8\xff", "a JPEG picture"},
    {"%PDF", "a PDF document"},
    {"\x7f"
     "ELF",
     "a program"},
    {"solid ", "an STL surface"},
    {"ply\n", "a PLY surface"},
    {"ply\r", "a PLY surface"},
    {"OFF\n", "an OFF surface"},
    {"OFF\r", "an OFF surface"},
    {"(0 \"", "a Fluent mesh"},
    {"(1 \"", "a Fluent mesh"},
    {"(2 3)", "a Fluent mesh"},
    {"ISO-10303-21", "a STEP file"},
    {"NRRD0", "an NRRD volume"},
    {"DICM", "a DICOM file", 128},
    {"n+1", "a NIfTI volume", 344},
    {"version https://git-lfs", "a Git LFS pointer (git lfs pull fetches the file itself)"},
};

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

// The name of the first element of XML or HTML; empty where there is none.
std::string root_element(std::string_view text) {
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    const std::string_view name = text.substr(at + 1);
    if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0]))) continue;  // <?xml, <!--
    const auto end = std::ranges::find_if_not(
        name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == ':'; });
    return {name.begin(), end};
  }
  return {};
}

// An 80-byte title, the number of triangles, and 50 bytes of each.
bool is_binary_stl(std::string_view head, std::uintmax_t file_size) {
  constexpr std::size_t kTitle = 80, kTriangle = 50;
  std::uint32_t triangles = 0;
  if (head.size() < kTitle + sizeof triangles) return false;
  std::memcpy(&triangles, head.data() + kTitle, sizeof triangles);
  return triangles > 0 && file_size == kTitle + sizeof triangles + std::uintmax_t{kTriangle} * triangles;
}

// The first line that says something, where `comment` begins those that do not.
std::string_view first_line(std::string_view text, std::string_view comment) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size()));
    if (!without_blanks(line).empty() && !line.starts_with(comment)) return line;
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return {};
}

std::string foreign_text(std::string_view head) {
  if (without_blanks(first_line(head, "#")).starts_with("MeshVersionFormatted"))
    return "a MEDIT mesh (gmsh FILE -save -o NAME.msh converts it)";
  for (const char* keyword : {"v ", "vn ", "o ", "g ", "mtllib "}) {
    if (first_line(head, "#").starts_with(keyword)) return "an OBJ surface";
  }
  const std::string_view line = first_line(head, "**");
  if (line.size() > 1 && line[0] == '*' && std::isalpha(static_cast<unsigned char>(line[1])))
    return "an Abaqus or LS-DYNA input file";
  return {};
}

}  // namespace

std::string file_head(const std::filesystem::path& file) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(file, unreadable)) return {};
  std::ifstream in(file, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return head.starts_with(kByteOrderMark) ? head.substr(kByteOrderMark.size()) : head;
}

std::optional<MeshKind> mesh_kind(std::string_view head) {
  head = without_blanks(head);
  for (const char* section : {"$MeshFormat", "$NOD", "$Comments", "$PhysicalNames"}) {
    if (head.starts_with(section)) return MeshKind::kGmsh;
  }
  if (head.starts_with("# vtk DataFile")) return MeshKind::kVtkLegacy;
  if (head.starts_with("<") && root_element(head) == "VTKFile") return MeshKind::kVtkXml;
  return std::nullopt;
}

std::string foreign_kind(std::string_view head, std::uintmax_t file_size) {
  if (mesh_kind(head)) return {};
  for (const Signature& known : kSignatures) {
    if (head.size() > known.at && head.substr(known.at).starts_with(known.bytes)) return known.words;
  }
  if (is_binary_stl(head, file_size)) return "an STL surface";
  const std::string_view text = without_blanks(head);
  if (!text.starts_with("<")) return foreign_text(head);
  const std::string root = root_element(text);
  if (root.empty()) return {};  // behind a long comment, perhaps
  return root == "html" || root == "HTML" ? "a web page" : "XML of another kind (<" + root + ">)";
}

std::string foreign_separator(std::string_view field) {
  constexpr std::pair<char, const char*> kOthers[] = {
      {';', "';'"}, {'\t', "tabs"}, {'|', "'|'"}, {' ', "blanks"}};
  for (const auto& [other, words] : kOthers) {
    if (field.find(other) != std::string_view::npos) return words;
  }
  return {};
}

std::string foreign_kind(const std::filesystem::path& file) {
  std::error_code unreadable;
  const std::uintmax_t size = std::filesystem::file_size(file, unreadable);
  return unreadable ? std::string() : foreign_kind(file_head(file), size);
}

}  // namespace omentum::geometry
