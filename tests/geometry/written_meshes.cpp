#include "tests/geometry/written_meshes.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <lz4.h>
#include <lzma.h>
#include <zlib.h>

namespace omentum::geometry {
namespace {

// The label of a tetrahedron; what writers put without any is 0.
std::int32_t label(const RawMesh& m, std::size_t t) {
  return m.regions.empty() ? 0 : m.regions[t];
}

std::string gmsh_1(const RawMesh& m) {
  Bytes out;
  out.text("$NOD\n", m.positions.size(), "\n");
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    out.text(10 * i + 7, m.positions[i].x(), m.positions[i].y(), m.positions[i].z(),
             "\n");  // numbers with gaps
  }
  out.text("$ENDNOD\n$ELM\n", m.tetrahedra.size() + 1, "\n1 2 1 1 3 7 17 27\n");  // a triangle, to be ignored
  std::size_t number = 5;
  for (const auto& t : m.tetrahedra) {
    out.text(number, "4", label(m, number - 5), "1 4", 10 * t[0] + 7, 10 * t[1] + 7, 10 * t[2] + 7,
             10 * t[3] + 7, "\n");
    ++number;
  }
  return out.text("$ENDELM\n").content;
}

std::string gmsh_2_text(const RawMesh& m) {
  Bytes out;
  out.text(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"liver\"\n$EndPhysicalNames\n$Nodes\n",
      m.positions.size(), "\r\n");
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    out.text(i + 1, m.positions[i].x(), m.positions[i].y(), m.positions[i].z(), "\r\n");
  }
  out.text("$EndNodes\n$Elements\n", m.tetrahedra.size() + 2, "\n1 15 2 0 1 1\n2 1 3 0 1 5 1 2\n");
  std::size_t number = 3;
  for (const auto& t : m.tetrahedra) {
    out.text(number, "4 2", label(m, number - 3), "1", t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1, "\n");
    ++number;
  }
  return out.text("$EndElements\n").content;
}

std::string gmsh_2_binary(const RawMesh& m) {
  Bytes out;
  out.text("$MeshFormat\n2.2 1 8\n")
      .value<std::int32_t>(1)
      .text("\n$EndMeshFormat\n$Nodes\n", m.positions.size(), "\n");
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    out.value(static_cast<std::int32_t>(i + 1))
        .value(m.positions[i].x())
        .value(m.positions[i].y())
        .value(m.positions[i].z());
  }
  out.text("\n$EndNodes\n$Elements\n", m.tetrahedra.size() + 1, "\n");
  for (const std::int32_t v : {2, 1, 2, 1, 0, 1, 1, 2, 3}) out.value(v);  // a group of one triangle
  for (const std::int32_t v : {4, static_cast<std::int32_t>(m.tetrahedra.size()), 2}) out.value(v);
  std::int32_t number = 9;
  for (const auto& t : m.tetrahedra) {
    const std::int32_t region = label(m, static_cast<std::size_t>(number - 9));
    for (const std::int32_t v : {number++, region, 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1}) out.value(v);
  }
  return out.text("\n$EndElements\n").content;
}

// Two node blocks, the second with parametric coordinates of a surface; one block of triangles, one of
// tetrahedra.
// The manual's "MSH file format version 4.0 (legacy)": tags before dimensions, numbers of 32 bits next to
// their coordinates. The binary file's entities hold the bytes of "$End" where they mean nothing.
const double kEndMark = std::bit_cast<double>(std::array{'$', 'E', 'n', 'd', '$', 'E', 'n', '\x3f'});

std::string gmsh_4_0(const RawMesh& m, bool binary) {
  const std::size_t n = m.positions.size(), half = n / 2;
  Bytes out;
  const auto integer = [&](std::size_t v) { binary ? out.value(static_cast<std::int32_t>(v)) : out.text(v); };
  const auto size = [&](std::size_t v) { binary ? out.value<std::uint64_t>(v) : out.text(v); };
  const auto real = [&](double v) { binary ? out.value(v) : out.text(v); };
  out.text("$MeshFormat\n4 ", binary ? "1" : "0", " 8\n");
  if (binary) out.value<std::int32_t>(1).text("\n");
  out.text("$EndMeshFormat\n");
  const auto box = [&] {
    for (int i = 0; i < 6; ++i) real(i == 0 ? kEndMark : 0);
  };
  out.text("$Entities\n");
  for (const std::size_t count : {1u, 0u, 0u, 2u}) size(count);
  integer(1), box(), size(0);
  for (const std::size_t volume : {1u, 2u}) {
    const std::int32_t region = label(m, volume == 1 ? 0 : m.tetrahedra.size() - 1);
    integer(volume), box(), size(region != 0);
    if (region != 0) integer(static_cast<std::size_t>(region));
    size(0);
  }
  out.text("\n$EndEntities\n");
  out.text("$Nodes\n");
  size(2), size(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i == 0) integer(1), integer(3), integer(0), size(half);
    if (i == half) integer(1), integer(2), integer(1), size(n - half);
    integer(i + 1);
    for (int k = 0; k < 3; ++k) real(m.positions[i][k]);
    if (i >= half) real(0.5), real(0.5);
  }
  out.text("\n$EndNodes\n$Elements\n");
  const std::size_t of_first = std::ranges::count(m.regions, label(m, 0));  // without labels none
  size(3), size(m.tetrahedra.size() + 1);
  integer(1), integer(2), integer(2), size(1), integer(1), integer(1), integer(2), integer(3);
  integer(1), integer(3), integer(4), size(of_first);
  std::size_t number = 2;
  for (const auto& t : m.tetrahedra) {
    if (number == of_first + 2) integer(2), integer(3), integer(4), size(m.tetrahedra.size() - of_first);
    integer(number++);
    for (const std::int32_t v : t) integer(static_cast<std::size_t>(v) + 1);
  }
  return out.text("\n$EndElements\n").content;
}

std::string gmsh_4_1(const RawMesh& m, bool binary) {
  const std::size_t n = m.positions.size(), half = n / 2;
  Bytes out;
  const auto integer = [&](std::int32_t v) { binary ? out.value(v) : out.text(v); };
  const auto size = [&](std::size_t v) { binary ? out.value<std::uint64_t>(v) : out.text(v); };
  const auto real = [&](double v) { binary ? out.value(v) : out.text(v); };
  const auto sizes = [&](std::initializer_list<std::size_t> values) {
    for (const std::size_t v : values) size(v);
  };
  out.text("$MeshFormat\n4.1 ", binary ? "1" : "0", " 8\n");
  if (binary) out.value<std::int32_t>(1).text("\n");
  out.text("$EndMeshFormat\n$Entities\n");
  sizes({1, 0, 0, 2});
  integer(1), real(kEndMark), real(0), real(0), size(0);
  for (const std::int32_t volume : {1, 2}) {
    const std::int32_t region = label(m, volume == 1 ? 0 : m.tetrahedra.size() - 1);
    integer(volume);
    for (int i = 0; i < 6; ++i) real(i);
    size(region != 0);
    if (region != 0) integer(region);
    size(1), integer(-3);
  }
  out.text("\n$EndEntities\n$Nodes\n");
  sizes({2, n, 1, n});
  for (const bool second : {false, true}) {
    const std::size_t first = second ? half : 0, last = second ? n : half;
    integer(second ? 2 : 3), integer(1), integer(second), size(last - first);
    for (std::size_t i = first; i < last; ++i) size(i + 1);
    for (std::size_t i = first; i < last; ++i) {
      for (int k = 0; k < 3; ++k) real(m.positions[i][k]);
      if (second) real(0.5), real(0.25);
    }
  }
  out.text("\n$EndNodes\n$Elements\n");
  const std::size_t of_first = std::ranges::count(m.regions, label(m, 0));  // without labels none
  sizes({3, m.tetrahedra.size() + 1, 1, m.tetrahedra.size() + 1});
  integer(2), integer(1), integer(2), sizes({1, 1, 1, 2, 3});
  integer(3), integer(1), integer(4), size(of_first);
  std::size_t number = 77;
  for (const auto& t : m.tetrahedra) {
    if (number == of_first + 77) integer(3), integer(2), integer(4), size(m.tetrahedra.size() - of_first);
    size(number++);
    for (const std::int32_t v : t) size(static_cast<std::size_t>(v) + 1);
  }
  return out.text("\n$EndElements\n").content;
}

std::string vtk_text(const RawMesh& m) {
  Bytes out;
  out.text("# vtk DataFile Version 2.0\nexample\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ",
           m.positions.size(), " double\n");
  for (const Vec3& p : m.positions) out.text(p.x(), p.y(), p.z(), "\n");
  out.text("\nCELLS ", m.tetrahedra.size() + 1, 5 * m.tetrahedra.size() + 4, "\n3 0 1 2\n");
  for (const auto& t : m.tetrahedra) out.text("4", t[0], t[1], t[2], t[3], "\n");
  out.text("CELL_TYPES ", m.tetrahedra.size() + 1, "\n5\n");
  for (std::size_t t = 0; t < m.tetrahedra.size(); ++t) out.text("10\n");
  if (m.regions.empty()) return out.text("CELL_DATA 1\nSCALARS x float 1\nLOOKUP_TABLE default\n0\n").content;
  out.text("POINT_DATA ", m.positions.size(), "\nVECTORS region double\n");
  for (const Vec3& p : m.positions) out.text(p.x(), p.y(), p.z());
  out.text("\nCELL_DATA ", m.tetrahedra.size() + 1,
           "\nSCALARS material_ids float\nLOOKUP_TABLE default\n0\n");
  for (const std::int32_t region : m.regions) out.text(region);
  return out.text("\n").content;
}

// Of cells, as binary VTK files hold them: arrays of a field, one of which gives the labels.
void add_vtk_labels(const RawMesh& m, Bytes& out) {
  constexpr auto big = std::endian::big;
  if (m.regions.empty()) return;
  out.text("\nCELL_DATA ", m.tetrahedra.size(), "\nFIELD FieldData 2\nquality 2 ", m.tetrahedra.size(),
           "float\n");
  for (std::size_t i = 0; i < 2 * m.tetrahedra.size(); ++i) out.value(0.5f, big);
  out.text("\nRegion 1 ", m.tetrahedra.size(), "short\n");
  for (const std::int32_t region : m.regions) out.value(static_cast<std::int16_t>(region), big);
}

std::string vtk_binary(const RawMesh& m) {
  constexpr auto big = std::endian::big;
  Bytes out;
  out.text("# vtk DataFile Version 3.0\nexample\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS ",
           m.positions.size(), "float\n");
  for (const Vec3& p : m.positions) {
    for (int i = 0; i < 3; ++i) out.value(static_cast<float>(p[i]), big);
  }
  out.text("\nCELLS ", m.tetrahedra.size(), 5 * m.tetrahedra.size(), "\n");
  for (const auto& t : m.tetrahedra) {
    out.value<std::int32_t>(4, big);
    for (const std::int32_t v : t) out.value(v, big);
  }
  out.text("\nCELL_TYPES ", m.tetrahedra.size(), "\n");
  for (std::size_t t = 0; t < m.tetrahedra.size(); ++t) out.value<std::int32_t>(10, big);
  add_vtk_labels(m, out);
  return out.text("\n").content;
}

// As VTK itself writes: a field before the points, and what it knows of an array's range behind them.
std::string vtk_with_fields(const RawMesh& m, bool binary) {
  std::string plain = binary ? vtk_binary(m) : vtk_text(m);
  Bytes field;
  field.text("FIELD FieldData 2\nTIME 1 1 double\n");
  binary ? field.value(0.25, std::endian::big) : field.text(0.25);
  field.text("\nlabels 2 3 int\n");
  for (std::int32_t i = 0; i < 6; ++i) binary ? field.value(i, std::endian::big) : field.text(i);
  plain.insert(plain.find("POINTS"), field.text("\n").content);
  const std::string range =
      "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0.5 CELLS \n\n";
  return plain.insert(plain.find("\nCELLS") + 1, range);
}

std::string vtk_5_binary(const RawMesh& m) {
  constexpr auto big = std::endian::big;
  const std::size_t cells = m.tetrahedra.size();
  Bytes out;
  out.text("# vtk DataFile Version 5.1\nexample\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS ",
           m.positions.size(), "double\n");
  for (const Vec3& p : m.positions) {
    for (int i = 0; i < 3; ++i) out.value(p[i], big);
  }
  out.text("\nCELLS ", cells + 1, 4 * cells, "\nOFFSETS vtktypeint64\n");
  for (std::size_t t = 0; t <= cells; ++t) out.value(static_cast<std::int64_t>(4 * t), big);
  out.text("\nCONNECTIVITY vtktypeint64\n");
  for (const auto& t : m.tetrahedra) {
    for (const std::int32_t v : t) out.value<std::int64_t>(v, big);
  }
  out.text("\nCELL_TYPES ", cells, "\n");
  for (std::size_t t = 0; t < cells; ++t) out.value<std::int32_t>(10, big);
  add_vtk_labels(m, out);
  return out.text("\n").content;
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k > bytes.size() - i ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

enum class Packing { kNone, kZlib, kLz4, kLzma };

// How the arrays of a .vtu are coded.
struct VtuCoding {
  std::string format;  // "binary" or "appended"
  bool base64;
  Packing packing;
  bool wide_header;
  bool in_pieces = false;  // the header and each block in base64 of their own, lines broken
};

const char* compressor(Packing packing) {
  constexpr const char* kNames[] = {"", " compressor=\"vtkZLibDataCompressor\"",
                                    " compressor=\"vtkLZ4DataCompressor\"",
                                    " compressor=\"vtkLZMADataCompressor\""};
  return kNames[static_cast<int>(packing)];
}

std::string pack(const std::string& block, Packing packing) {
  std::string packed(compressBound(block.size()) + 1024, '\0');
  const auto* in = reinterpret_cast<const std::uint8_t*>(block.data());
  auto* out = reinterpret_cast<std::uint8_t*>(packed.data());
  std::size_t size = 0;
  if (packing == Packing::kZlib) {
    uLongf written = packed.size();
    compress(out, &written, in, block.size());
    size = written;
  } else if (packing == Packing::kLz4) {
    size = static_cast<std::size_t>(LZ4_compress_default(
        block.data(), packed.data(), static_cast<int>(block.size()), static_cast<int>(packed.size())));
  } else {
    EXPECT_EQ(
        lzma_easy_buffer_encode(6, LZMA_CHECK_CRC32, nullptr, in, block.size(), out, &size, packed.size()),
        LZMA_OK);
  }
  return packed.substr(0, size);
}

std::string coded(const std::string& data, const VtuCoding& how) {
  const auto word = [&](std::size_t v) {
    return how.wide_header ? Bytes().value<std::uint64_t>(v).content
                           : Bytes().value(static_cast<std::uint32_t>(v)).content;
  };
  const auto as_text = [&](const std::string& bytes) { return how.base64 ? base64(bytes) : bytes; };
  if (how.packing == Packing::kNone) {
    if (!how.in_pieces) return as_text(word(data.size()) + data);
    std::string text = as_text(word(data.size())) + as_text(data);
    for (std::size_t at = 76; at < text.size(); at += 77) text.insert(at, "\n");
    return text;
  }
  constexpr std::size_t kBlock = 200;  // so that there are several, the last one shorter
  std::string header, blocks;
  std::size_t count = 0;
  for (std::size_t at = 0; at < data.size(); at += kBlock, ++count) {
    const std::string packed = pack(data.substr(at, kBlock), how.packing);
    header += word(packed.size());
    blocks += how.in_pieces ? as_text(packed) : packed;
  }
  return as_text(word(count) + word(kBlock) + word(data.size() % kBlock) + header) +
         (how.in_pieces ? blocks : as_text(blocks));
}

std::string vtu(const RawMesh& m, const VtuCoding& how) {
  Bytes points, nodes, ends, types;
  for (const Vec3& p : m.positions) {
    for (int i = 0; i < 3; ++i) points.value(static_cast<float>(p[i]));
  }
  for (std::size_t t = 0; t < m.tetrahedra.size(); ++t) {
    for (const std::int32_t v : m.tetrahedra[t]) nodes.value<std::int64_t>(v);
    ends.value(static_cast<std::int32_t>(4 * t + 4));
    types.value<std::uint8_t>(10);
  }
  std::string appended;
  const auto array = [&](const std::string& attributes, const std::string& data) {
    if (how.format == "binary")
      return "<DataArray " + attributes + " format=\"binary\">\n" + coded(data, how) + "\n</DataArray>";
    const std::string tag = "<DataArray " + attributes + " format=\"appended\" offset=\"" +
                            std::to_string(appended.size()) + "\"/>";
    appended += coded(data, how);
    return tag;
  };
  Bytes out;
  out.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" ",
      how.wide_header ? "header_type=\"UInt64\"" : "", compressor(how.packing),
      "><UnstructuredGrid><Piece NumberOfPoints=\"", std::to_string(m.positions.size()),
      "\" NumberOfCells=\"", std::to_string(m.tetrahedra.size()), "\">");
  out.text("<Points>", array("type=\"Float32\" NumberOfComponents=\"3\"", points.content), "</Points>");
  out.text("<Cells>", array("type=\"Int64\" Name=\"connectivity\"", nodes.content),
           array("type=\"Int32\" Name=\"offsets\"", ends.content),
           array("type=\"UInt8\" Name=\"types\"", types.content), "</Cells>");
  if (!m.regions.empty()) {
    Bytes labels;
    for (const std::int32_t region : m.regions) labels.value(static_cast<std::int16_t>(region));
    out.text("<CellData>", array("type=\"Int16\" Name=\"gmsh:physical\"", labels.content), "</CellData>");
  }
  out.text("</Piece></UnstructuredGrid>");
  if (how.format == "appended") {
    out.text("<AppendedData encoding=\"", how.base64 ? "base64" : "raw", "\">\n   _", appended,
             "\n</AppendedData>");
  }
  return out.text("</VTKFile>\n").content;
}

std::string vtu_text(const RawMesh& m) {
  Bytes out;
  out.text("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"",
           std::to_string(m.positions.size()), "\" NumberOfCells=\"", std::to_string(m.tetrahedra.size()),
           "\"><Points><DataArray type=\"Float64\" format=\"ascii\">");
  for (const Vec3& p : m.positions) out.text(p.x(), p.y(), p.z(), "\n");
  out.text("</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">");
  for (const auto& t : m.tetrahedra) out.text(t[0], t[1], t[2], t[3], "\n");
  out.text("</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">");
  for (std::size_t t = 0; t < m.tetrahedra.size(); ++t) out.text(4 * t + 4);
  out.text("</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">");
  for (std::size_t t = 0; t < m.tetrahedra.size(); ++t) out.text("10 ");
  out.text("</DataArray></Cells>");
  if (!m.regions.empty()) {
    out.text("<CellData><DataArray type=\"Int32\" Name=\"Labels\" format=\"ascii\">");
    for (const std::int32_t region : m.regions) out.text(region);
    out.text("</DataArray></CellData>");
  }
  return out.text("</Piece></UnstructuredGrid></VTKFile>").content;
}

}  // namespace

RawMesh example_mesh() {
  RawMesh raw = test::make_raw_box(2, 1, 2, {0.5, 0.25, 1});
  for (Vec3& p : raw.positions) p += Vec3(-0.125, 2.5, 0);
  return raw;
}

RawMesh labelled_mesh() {
  RawMesh raw = example_mesh();
  raw.regions.assign(raw.tetrahedra.size(), 7);
  std::fill_n(raw.regions.begin(), raw.regions.size() / 3, 12);
  return raw;
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {"Gmsh1", ".msh", gmsh_1},
      {"Gmsh2Text", ".msh", gmsh_2_text},
      {"Gmsh2Binary", ".msh", gmsh_2_binary},
      {"Gmsh40Text", ".msh", [](const RawMesh& m) { return gmsh_4_0(m, false); }},
      {"Gmsh40Binary", ".msh", [](const RawMesh& m) { return gmsh_4_0(m, true); }},
      {"Gmsh41Text", ".msh", [](const RawMesh& m) { return gmsh_4_1(m, false); }},
      {"Gmsh41Binary", ".msh", [](const RawMesh& m) { return gmsh_4_1(m, true); }},
      {"VtkText", ".vtk", vtk_text},
      {"VtkBinary", ".vtk", vtk_binary},
      {"VtkTextWithFields", ".vtk", [](const RawMesh& m) { return vtk_with_fields(m, false); }},
      {"VtkBinaryWithFields", ".vtk", [](const RawMesh& m) { return vtk_with_fields(m, true); }},
      {"Vtk5Binary", ".vtk", vtk_5_binary},
      {"VtuText", ".vtu", vtu_text},
      {"VtuBase64", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"binary", true, Packing::kNone, false});
       }},
      {"VtuBase64WideHeader", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"binary", true, Packing::kNone, true});
       }},
      {"VtuBase64Zlib", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"binary", true, Packing::kZlib, false});
       }},
      {"VtuBase64Lz4", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"binary", true, Packing::kLz4, false});
       }},
      {"VtuBase64Lzma", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"binary", true, Packing::kLzma, true});
       }},
      {"VtuBase64HeaderApart", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"binary", true, Packing::kNone, false, true});
       }},
      {"VtuBase64WideHeaderApart", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"binary", true, Packing::kNone, true, true});
       }},
      {"VtuBase64ZlibInPieces", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"binary", true, Packing::kZlib, true, true});
       }},
      {"VtuAppendedBase64", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"appended", true, Packing::kNone, true});
       }},
      {"VtuAppendedBase64HeaderApart", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"appended", true, Packing::kNone, false, true});
       }},
      {"VtuAppendedBase64ZlibInPieces", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"appended", true, Packing::kZlib, false, true});
       }},
      {"VtuAppendedRawLz4", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"appended", false, Packing::kLz4, true});
       }},
      {"VtuAppendedRawLzma", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"appended", false, Packing::kLzma, false});
       }},
      {"VtuAppendedRaw", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"appended", false, Packing::kNone, true});
       }},
      {"VtuAppendedRawZlib", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"appended", false, Packing::kZlib, false});
       }},
      {"VtuAppendedBase64Zlib", ".vtu",
       [](const RawMesh& m) {
         return vtu(m, {"appended", true, Packing::kZlib, true});
       }},
  };
  return all;
}

}  // namespace omentum::geometry
