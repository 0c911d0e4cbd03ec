#include "geometry/mesh_io/block_codec.h"

#include <lz4.h>
#include <lzma.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <limits>

namespace omentum::geometry {
namespace {

struct CodecFacts {
  BlockCodec codec;
  std::string_view vtk_name;
  // What it can shrink at most, a little more: a larger claim is a broken file, not a reason to allocate.
  std::size_t largest_ratio;
};

constexpr std::array<CodecFacts, 3> kCodecs = {{{BlockCodec::kZlib, "vtkZLibDataCompressor", 1040},
                                                {BlockCodec::kLz4, "vtkLZ4DataCompressor", 256},
                                                {BlockCodec::kLzma, "vtkLZMADataCompressor", 16384}}};

// What an honest block's dictionary needs with a wide margin, bytes; VTK's blocks are 32 KiB.
constexpr std::uint64_t kLzmaMemory = std::uint64_t{1} << 28;

bool inflate_zlib(std::string_view block, std::string& out) {
  uLongf size = out.size();
  return uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(block.data()),
                    block.size()) == Z_OK &&
         size == out.size();
}

bool inflate_lz4(std::string_view block, std::string& out) {
  constexpr auto kLargest = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (block.size() > kLargest || out.size() > kLargest) return false;
  const int size = LZ4_decompress_safe(block.data(), out.data(), static_cast<int>(block.size()),
                                       static_cast<int>(out.size()));
  return size >= 0 && static_cast<std::size_t>(size) == out.size();
}

bool inflate_lzma(std::string_view block, std::string& out) {
  std::uint64_t memory = kLzmaMemory;
  std::size_t in_at = 0, out_at = 0;
  return lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(block.data()),
                                   &in_at, block.size(), reinterpret_cast<std::uint8_t*>(out.data()), &out_at,
                                   out.size()) == LZMA_OK &&
         out_at == out.size();
}

}  // namespace

std::optional<BlockCodec> block_codec(std::string_view vtk_name) {
  if (vtk_name.empty()) return BlockCodec::kNone;
  for (const CodecFacts& facts : kCodecs) {
    if (facts.vtk_name == vtk_name) return facts.codec;
  }
  return std::nullopt;
}

std::optional<std::string> decode_block(BlockCodec codec, std::string_view block, std::size_t size) {
  for (const CodecFacts& facts : kCodecs) {
    if (facts.codec == codec && size / facts.largest_ratio > block.size()) return std::nullopt;
  }
  std::string out(size, '\0');
  const bool whole = codec == BlockCodec::kZlib  ? inflate_zlib(block, out)
                     : codec == BlockCodec::kLz4 ? inflate_lz4(block, out)
                                                 : inflate_lzma(block, out);
  return whole ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace omentum::geometry
