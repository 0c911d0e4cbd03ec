#include "organ/csv.h"

#include "geometry/mesh_io/file_kind.h"
#include "geometry/tetra_mesh.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>

namespace omentum::organ {

namespace {

// What spreadsheets put in front of UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

template <class T>
std::optional<T> parse_whole(const std::string& field) {
  // std::from_chars takes no plus sign
  const char* first = field.data() + (field.size() > 1 && field[0] == '+' ? 1 : 0);
  const char* const last = field.data() + field.size();
  T value{};
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc{} || end != last || first == last) return std::nullopt;
  return value;
}

// What some programs put around names, or around all.
std::string unquoted(const std::string& field) {
  const bool quoted = field.size() > 1 && field.front() == '"' && field.back() == '"';
  return quoted ? field.substr(1, field.size() - 2) : field;
}

// The next comma, or the end of the line; what is in quotes is one.
std::size_t end_of_field(const std::string& line, std::size_t begin) {
  bool quoted = false;
  for (std::size_t i = begin; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == ',' && !quoted) return i;
  }
  return line.size();
}

CsvLine split_line(const std::filesystem::path& file, int number, const std::string& text) {
  CsvLine line{file.string() + ":" + std::to_string(number), split_fields(text)};
  std::ranges::transform(line.fields, line.fields.begin(), unquoted);
  return line;
}

// A name of a column, not a number gone wrong.
bool is_name(const std::string& name) {
  if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0]))) return false;
  return !parse_whole<double>(name);
}

// "Node ID" as "nodeid".
std::string bare(const std::string& field) {
  std::string name;
  for (const char c : field) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

constexpr std::string_view kNumbering = "numbering:";

// What a comment says of the table's numbers, if anything.
std::optional<geometry::Numbering> stated_numbering(const std::string& comment) {
  const std::size_t at = comment.find(kNumbering);
  if (at == std::string::npos) return std::nullopt;
  std::istringstream rest(comment.substr(at + kNumbering.size()));
  std::string word;
  rest >> word;
  if (word == "file") return geometry::Numbering::kFile;
  if (word == "position") return geometry::Numbering::kPosition;
  return std::nullopt;
}

// A pipe is opened once, and not looked into.
std::ifstream open_text(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file))
    throw geometry::InputError(file.string() + ": cannot be read; expected a CSV file");
  if (const std::string found = geometry::foreign_kind(file); !found.empty())
    throw geometry::InputError(file.string() + ": found " + found + "; expected a CSV file");
  return in;
}

void require_commas(const CsvLine& line, bool is_header) {
  const std::string found = geometry::foreign_separator(line.fields[0]);
  if (found.empty() || (is_header && found == "blanks")) return;  // "Node ID"
  throw geometry::InputError(line.where + ": found fields separated by " + found +
                             "; expected ',' (and '.' in numbers)");
}

void require_width(const CsvTable& table, const CsvLine& line) {
  if (table.header && table.header->fields.size() == line.fields.size()) return;
  require_commas(line, false);
  if (!table.header) return;
  throw geometry::InputError(line.where + ": found " + std::to_string(line.fields.size()) +
                             " fields; expected " + std::to_string(table.header->fields.size()) +
                             ", as in the header");
}

}  // namespace

std::optional<double> parse_number(const std::string& field) {
  const auto value = parse_whole<double>(field);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parse_integer(const std::string& field) {
  return parse_whole<std::int64_t>(field);
}

std::optional<std::vector<double>> parse_numbers(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& field : split_fields(text)) {
    const std::optional<double> number = parse_number(field);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::string> split_fields(const std::string& line) {
  constexpr const char* kBlanks = " \t\r";
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = end_of_field(line, begin);
    const std::string field = line.substr(begin, comma - begin);
    const std::size_t first = field.find_first_not_of(kBlanks);
    const std::size_t last = field.find_last_not_of(kBlanks);
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
    begin = comma + 1;
  }
  return fields;
}

CsvTable read_csv(const std::filesystem::path& file) {
  std::ifstream in = open_text(file);
  CsvTable table;
  std::string text;
  bool first = true;
  for (int number = 1; std::getline(in, text); ++number) {
    if (number == 1 && text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    CsvLine line = split_line(file, number, text);
    if (line.fields[0].empty() && line.fields.size() == 1) continue;
    if (line.fields[0].starts_with('#')) {
      if (const auto said = stated_numbering(text)) table.numbering = said;
      continue;
    }
    const bool header = first && std::ranges::all_of(line.fields, is_name);
    first = false;
    if (header) {
      require_commas(line, true);
      table.header = std::move(line);
      continue;
    }
    require_width(table, line);
    table.lines.push_back(std::move(line));
  }
  if (table.lines.empty()) throw geometry::InputError(file.string() + ": holds no numbers");
  return table;
}

std::string numbering_comment(geometry::Numbering numbering) {
  return "# " + std::string(kNumbering) +
         (numbering == geometry::Numbering::kFile ? " file (the mesh file's own node numbers)\n"
                                                  : " position (places in the mesh file, from 0)\n");
}

std::size_t find_column(const CsvLine& header, std::span<const char* const> names, const char* expected) {
  std::vector<std::size_t> found;
  std::string text;
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    text += (i == 0 ? "" : ",") + header.fields[i];
    const std::string name = bare(header.fields[i]);
    if (std::ranges::any_of(names, [&](const char* known) { return name == known; })) found.push_back(i);
  }
  if (found.size() == 1) return found[0];
  throw geometry::InputError(header.where + ": found " + (found.empty() ? "the header '" : "several in '") +
                             text + "'; expected one column " + expected);
}

}  // namespace omentum::organ
