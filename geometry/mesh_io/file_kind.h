// What a file is, judged by its first bytes: names lie, and a message that says what was found saves an hour.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace omentum::geometry {

/// The formats of meshes that are known by their first bytes.
enum class MeshKind { kGmsh, kVtkLegacy, kVtkXml };

/// The beginning of a file, at most 1 KiB, without UTF-8's byte order mark; empty where it cannot be read.
std::string file_head(const std::filesystem::path& file);

/// Which kind of mesh `head` begins, if one that is read here.
std::optional<MeshKind> mesh_kind(std::string_view head);

/// In words what `head` begins where it is none of the texts that are read here: "gzip-compressed data", "an
/// STL surface", "XML of another kind (<svg>)"; empty where it is not recognized. `file_size`: of the whole
/// file, bytes, by which a binary STL is known.
std::string foreign_kind(std::string_view head, std::uintmax_t file_size);

/// The same of a file; empty where it cannot be read.
std::string foreign_kind(const std::filesystem::path& file);

/// In words what separates the fields of a table where a comma should: `field` is what stands before the
/// first comma of a line. Empty where it is one field.
std::string foreign_separator(std::string_view field);

}  // namespace omentum::geometry
