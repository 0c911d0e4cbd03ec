#include "geometry/mesh_io/vtu_arrays.h"

#include "geometry/tetra_mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>

namespace omentum::geometry {
namespace {

constexpr std::string_view kBase64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// The first `count` bytes that the text codes, or fewer. Padding ends a piece, behind which another one may
// follow: some writers code the header, or each block, apart, and others all of it in one. Blanks and line
// breaks code nothing.
std::string decode_base64(std::string_view text, std::size_t count) {
  std::string bytes;
  bytes.reserve(std::min(count, text.size()));
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (bytes.size() == count) break;
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    if (c == '=') {
      held = 0;
      continue;
    }
    const std::size_t value = kBase64.find(c);
    if (value == std::string_view::npos) break;
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    if ((held += 6) < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>((bits >> held) & 0xff));
  }
  return bytes;
}

template <class T>
T load(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> buffer;
  std::memcpy(buffer.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(buffer.begin(), buffer.end());
  return std::bit_cast<T>(buffer);
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(file)) {
    throw InputError(file.string() + ": no such file; expected a mesh file");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  if (text.view().empty()) throw InputError(file.string() + ": is empty; expected a mesh file");
  return std::move(text).str();
}

}  // namespace

VtuArrays::VtuArrays(const std::filesystem::path& file) : name_(file.string()) {
  std::string text = read_file(file);
  // Raw appended data is not XML: it is cut out before the parser sees it.
  const std::size_t tag = text.find("<AppendedData");
  if (tag != std::string::npos) {
    const std::size_t open_end = text.find('>', tag);
    const std::size_t start = open_end == std::string::npos ? open_end : text.find('_', open_end);
    if (start == std::string::npos)
      fail("<AppendedData> without data", "an underscore and the data behind it");
    appended_base64_ = text.substr(tag, open_end - tag).find("base64") != std::string::npos;
    appended_ = text.substr(start + 1);
    text = text.substr(0, tag) + "</VTKFile>";
  }
  const pugi::xml_parse_result parsed = document_.load_buffer(text.data(), text.size());
  if (!parsed)
    fail(std::string(parsed.description()) + " at byte " + std::to_string(parsed.offset), "well-formed XML");
  root_ = document_.child("VTKFile");
  if (std::string_view(root_.attribute("type").value()) != "UnstructuredGrid") {
    fail("type '" + std::string(root_.attribute("type").value()) + "'",
         "<VTKFile type=\"UnstructuredGrid\">");
  }
  const std::string_view compressor = root_.attribute("compressor").value();
  const std::optional<BlockCodec> codec = block_codec(compressor);
  if (!codec)
    fail(std::string(compressor), "vtkZLibDataCompressor, vtkLZ4DataCompressor or vtkLZMADataCompressor");
  codec_ = *codec;
  if (std::string_view(root_.attribute("header_type").value()) == "UInt64") word_size_ = 8;
  if (std::string_view(root_.attribute("byte_order").value()) == "BigEndian") order_ = std::endian::big;
}

void VtuArrays::fail(const std::string& found, const std::string& expected) const {
  throw InputError(name_ + ": found " + found + ", expected " + expected);
}

std::vector<double> VtuArrays::reals(pugi::xml_node array) const {
  return values<double>(array);
}
std::vector<std::int64_t> VtuArrays::integers(pugi::xml_node array) const {
  return values<std::int64_t>(array);
}

template <class T>
std::vector<T> VtuArrays::values(pugi::xml_node array) const {
  if (std::string_view(array.attribute("format").value()) == "ascii") return parse_text<T>(array);
  return convert<T>(bytes_of(coded(array)), array.attribute("type").value());
}

template <class T>
std::vector<T> VtuArrays::parse_text(pugi::xml_node array) const {
  constexpr std::string_view kSpace = " \t\r\n";
  std::vector<T> result;
  std::string_view text = array.child_value();
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
    if (text.empty()) return result;
    const std::size_t length = std::min(text.find_first_of(kSpace), text.size());
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + length, value);
    if (error != std::errc{} || end != text.data() + length) {
      fail("no number as value " + std::to_string(result.size()) + " of array " +
               array.attribute("Name").value(),
           "numbers only");
    }
    result.push_back(value);
    text.remove_prefix(length);
  }
}

// A stored value as a T that holds the same number.
template <class T, class Stored>
T VtuArrays::as(Stored value) const {
  if constexpr (std::is_integral_v<T> && std::is_floating_point_v<Stored>) {
    // beyond, a double has no whole numbers of its own
    constexpr double kLargest = 9007199254740992.0;
    if (!(std::abs(value) <= kLargest) || value != std::trunc(value))
      fail("the number " + std::to_string(value), "whole numbers");
  } else if constexpr (std::is_integral_v<T>) {
    if (!std::in_range<T>(value)) fail("the number " + std::to_string(value), "one of 63 bits");
  }
  return static_cast<T>(value);
}

template <class T>
std::vector<T> VtuArrays::convert(const std::string& bytes, std::string_view type) const {
  std::vector<T> result;
  const auto all_as = [&]<class Stored>(Stored) {
    if (bytes.size() % sizeof(Stored) != 0)
      fail(std::to_string(bytes.size()) + " bytes", "whole values of " + std::string(type));
    result.reserve(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(Stored)) {
      result.push_back(as<T>(load<Stored>(bytes.data() + i, order_)));
    }
  };
  if (type == "Float32")
    all_as(float{});
  else if (type == "Float64")
    all_as(double{});
  else if (type == "Int8")
    all_as(std::int8_t{});
  else if (type == "UInt8")
    all_as(std::uint8_t{});
  else if (type == "Int16")
    all_as(std::int16_t{});
  else if (type == "UInt16")
    all_as(std::uint16_t{});
  else if (type == "Int32")
    all_as(std::int32_t{});
  else if (type == "UInt32")
    all_as(std::uint32_t{});
  else if (type == "Int64")
    all_as(std::int64_t{});
  else if (type == "UInt64")
    all_as(std::uint64_t{});
  else
    fail("an array of type '" + std::string(type) + "'", "a type such as Float32 or Int64");
  return result;
}

VtuArrays::Coded VtuArrays::coded(pugi::xml_node array) const {
  const std::string_view format = array.attribute("format").value();
  if (format == "binary") {
    std::string_view text = array.child_value();
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return {text, true};
  }
  if (format != "appended") fail("format '" + std::string(format) + "'", "ascii, binary or appended");
  const std::size_t offset = array.attribute("offset").as_ullong();
  if (offset > appended_.size()) fail("offset " + std::to_string(offset), "one inside <AppendedData>");
  return {std::string_view(appended_).substr(offset), appended_base64_};
}

std::string VtuArrays::first_bytes(Coded data, std::size_t count) const {
  if (count > data.text.size()) fail("an array that ends early", std::to_string(count) + " bytes");
  if (!data.base64) return std::string(data.text.substr(0, count));
  std::string bytes = decode_base64(data.text, count);
  if (bytes.size() < count)
    fail("an array that ends early or is not base64", std::to_string(count) + " bytes in base64");
  return bytes;
}

std::size_t VtuArrays::header_word(std::string_view bytes, std::size_t index) const {
  const char* at = bytes.data() + index * word_size_;
  return word_size_ == 8 ? static_cast<std::size_t>(load<std::uint64_t>(at, order_))
                         : load<std::uint32_t>(at, order_);
}

std::string VtuArrays::bytes_of(Coded data) const {
  if (codec_ != BlockCodec::kNone) return inflate_blocks(data);
  const std::size_t size = header_word(first_bytes(data, word_size_), 0);
  if (size > data.text.size())
    fail("an array of " + std::to_string(size) + " bytes", "no more than the file holds");
  return first_bytes(data, word_size_ + size).substr(word_size_);
}

// Header: number of blocks, size of a block, size of the last one (0: whole), then each block's compressed
// size.
std::string VtuArrays::inflate_blocks(Coded data) const {
  const std::size_t blocks = header_word(first_bytes(data, word_size_), 0);
  if (blocks > data.text.size() / word_size_)
    fail(std::to_string(blocks) + " blocks", "no more than the file holds");
  if (blocks == 0) return {};
  const std::size_t header_size = (3 + blocks) * word_size_;
  const std::string header = first_bytes(data, header_size);
  const std::size_t block_size = header_word(header, 1), last_size = header_word(header, 2);
  std::size_t coded_size = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    coded_size += std::min(header_word(header, 3 + b), data.text.size() + 1);
  }
  const std::string coded = first_bytes(data, header_size + coded_size).substr(header_size);
  std::string result;
  std::size_t at = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t in_size = header_word(header, 3 + b);
    const std::size_t out_size = b + 1 == blocks && last_size > 0 ? last_size : block_size;
    const std::optional<std::string> block =
        decode_block(codec_, std::string_view(coded).substr(at, in_size), out_size);
    if (!block)
      fail("a compressed block that does not hold " + std::to_string(out_size) + " bytes", "one that does");
    result += *block;
    at += in_size;
  }
  return result;
}

}  // namespace omentum::geometry
