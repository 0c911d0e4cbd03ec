// Small tables of numbers as users write them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace omentum::organ {

/// A line of a CSV file that holds something.
struct CsvLine {
  std::string where;                // "FILE:LINE", for messages
  std::vector<std::string> fields;  // without blanks around them
};

/// The lines of a CSV file; empty ones, those that begin with '#', a byte order mark and a header
/// (a first line of names: fields that begin with a letter, but are not nan or inf) are left out. Throws
/// geometry::InputError when the file cannot be read or holds no line.
std::vector<CsvLine> read_csv(const std::filesystem::path& file);

/// The fields of "a, b, c".
std::vector<std::string> split_fields(const std::string& line);

/// A whole field as a finite number, or nothing.
std::optional<double> parse_number(const std::string& field);
std::optional<std::int32_t> parse_integer(const std::string& field);

}  // namespace omentum::organ
