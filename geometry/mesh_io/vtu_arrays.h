// The data arrays of a VTK XML file, whatever way they are written.
#pragma once

#include "geometry/mesh_io/block_codec.h"

#include <pugixml.hpp>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace omentum::geometry {

/// Decodes arrays written as text, base64 in place, or appended (base64 or raw), plain or
/// compressed. Every function throws InputError naming the file and the array.
class VtuArrays {
 public:
  explicit VtuArrays(const std::filesystem::path& file);

  /// <VTKFile>.
  pugi::xml_node root() const { return root_; }
  std::vector<double> reals(pugi::xml_node array) const;
  std::vector<std::int64_t> integers(pugi::xml_node array) const;

  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  // An array's coded bytes, what follows them, and how they are coded.
  struct Coded {
    std::string_view text;
    bool base64;
  };

  template <class T>
  std::vector<T> values(pugi::xml_node array) const;
  template <class T, class Stored>
  T as(Stored value) const;
  template <class T>
  std::vector<T> parse_text(pugi::xml_node array) const;
  template <class T>
  std::vector<T> convert(const std::string& bytes, std::string_view type) const;

  Coded coded(pugi::xml_node array) const;
  std::string bytes_of(Coded data) const;
  std::string inflate_blocks(Coded data) const;
  std::string first_bytes(Coded data, std::size_t count) const;
  std::size_t header_word(std::string_view bytes, std::size_t index) const;

  std::string name_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::string appended_;  // behind the underscore of <AppendedData>
  bool appended_base64_ = false;
  BlockCodec codec_ = BlockCodec::kNone;
  std::size_t word_size_ = 4;  // of headers, bytes
  std::endian order_ = std::endian::little;
};

}  // namespace omentum::geometry
