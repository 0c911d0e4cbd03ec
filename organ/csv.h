// Small tables of numbers as users write them.
#pragma once

#include "geometry/file_numbers.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace omentum::organ {

/// A line of a CSV file that holds something.
struct CsvLine {
  std::string where;                // "FILE:LINE", for messages
  std::vector<std::string> fields;  // without blanks and quotes around them
};

struct CsvTable {
  std::optional<CsvLine> header;
  std::vector<CsvLine> lines;                    // at least one; each as wide as the header
  std::optional<geometry::Numbering> numbering;  // that a comment "# numbering: file" (or position) says
};

/// Reads a CSV file. Empty lines, those that begin with '#' and a byte order mark are passed over. A first
/// line all of whose fields begin with a letter, but are not nan or inf, is a header: what
/// reads the table must find its columns in it. Throws geometry::InputError when the file cannot be read, is
/// none (compressed, UTF-16 ...), holds no line of numbers, separates fields by anything but commas, or has a
/// line that is not as wide as its header.
CsvTable read_csv(const std::filesystem::path& file);

/// The comment line, with its end, that says which numbers a table holds.
std::string numbering_comment(geometry::Numbering numbering);

/// The column that has one of `names` (small letters alone: capitals, quotes, blanks and signs of the header
/// do not count). Throws geometry::InputError with the header's place when none has, or several have;
/// `expected`: in words.
std::size_t find_column(const CsvLine& header, std::span<const char* const> names, const char* expected);

/// The fields of "a, b, c"; a comma in quotes is part of one.
std::vector<std::string> split_fields(const std::string& line);

/// A whole field as a finite number, or nothing.
std::optional<double> parse_number(const std::string& field);
std::optional<std::int64_t> parse_integer(const std::string& field);

/// The numbers of "a,b,c", or nothing where a field is none.
std::optional<std::vector<double>> parse_numbers(const std::string& text);

}  // namespace omentum::organ
