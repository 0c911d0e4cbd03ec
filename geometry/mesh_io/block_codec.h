// The compressors that VTK offers for the blocks of its XML files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace omentum::geometry {

enum class BlockCodec { kNone, kZlib, kLz4, kLzma };

/// By VTK's name, such as "vtkZLibDataCompressor" (empty: kNone); nothing for another name.
std::optional<BlockCodec> block_codec(std::string_view vtk_name);

/// The `size` bytes that a block codes; nothing when it codes another number of bytes, cannot be read, or
/// claims more than its codec can shrink. Precondition: not kNone.
std::optional<std::string> decode_block(BlockCodec codec, std::string_view block, std::size_t size);

}  // namespace omentum::geometry
