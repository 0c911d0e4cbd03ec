#include "organ_tools/force_map/map_file.h"

#include "files/whole_file.h"

#include <bit>
#include <cstdint>

namespace omentum::force_map {

namespace {

constexpr int kTriangle = 5;  // VTK's number

// Raw data behind the XML: numbers that are none have no text that all readers know.
class Vtu {
 public:
  template <class T>
  std::string array(const std::string& attributes, const std::vector<T>& values) {
    std::string tag = "<DataArray " + attributes + " format=\"appended\" offset=\"" +
                      std::to_string(data_.size()) + "\"/>\n";
    const std::uint64_t bytes = values.size() * sizeof(T);
    data_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    data_.append(reinterpret_cast<const char*>(values.data()), bytes);
    return tag;
  }
  const std::string& data() const { return data_; }

 private:
  std::string data_;
};

}  // namespace

void write_map(const std::filesystem::path& file, const organ::Organ& organ,
               std::span<const MapArray> arrays) {
  static_assert(std::endian::native == std::endian::little, "what the file says of itself");
  Vtu vtu;
  const geometry::Surface& surface = organ.surface;
  std::vector<double> positions;
  std::vector<std::int64_t> numbers, corners, ends;
  for (const geometry::NodeId n : surface.node) {
    const Vec3& p = organ.mesh.positions[n];
    positions.insert(positions.end(), {p.x(), p.y(), p.z()});
    numbers.push_back(organ.mesh.node_numbers[static_cast<std::size_t>(organ.mesh.file_node[n])]);
  }
  for (const geometry::Triangle& t : surface.triangles) {
    corners.insert(corners.end(), t.begin(), t.end());
    ends.push_back(std::ssize(corners));
  }
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\"><UnstructuredGrid><Piece NumberOfPoints=\"" +
      std::to_string(surface.node.size()) + "\" NumberOfCells=\"" + std::to_string(surface.triangles.size()) +
      "\">\n<PointData>\n" + vtu.array("type=\"Int64\" Name=\"node_number\"", numbers);
  for (const MapArray& array : arrays) {
    text += vtu.array("type=\"Float64\" Name=\"" + array.name + "\"",
                      std::vector<double>(array.values.begin(), array.values.end()));
  }
  text += "</PointData>\n<Points>" + vtu.array("type=\"Float64\" NumberOfComponents=\"3\"", positions) +
          "</Points>\n<Cells>" + vtu.array("type=\"Int64\" Name=\"connectivity\"", corners) +
          vtu.array("type=\"Int64\" Name=\"offsets\"", ends) +
          vtu.array("type=\"UInt8\" Name=\"types\"", std::vector<std::uint8_t>(ends.size(), kTriangle)) +
          "</Cells>\n</Piece></UnstructuredGrid>\n<AppendedData encoding=\"raw\">_" + vtu.data() +
          "</AppendedData></VTKFile>\n";
  files::write_whole(file, text);
}

}  // namespace omentum::force_map
