// Numbers by property and model: a table for people, a list for programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace omentum::tissue_compare {

/// One number. Its name says what, then of which model: "error/bending/spring-mass".
struct Figure {
  std::string name;
  double value;
  std::string unit;  // "us", "ns", "%", "s"; "1" for a ratio
};

/// One row of a table: what, then a text for each column.
struct Row {
  std::string what;
  std::vector<std::string> cells;
};

/// The rows under a title, columns aligned, "" at the head's first place. Ends in a line break.
std::string table(const std::string& title, const std::vector<std::string>& columns,
                  const std::vector<Row>& rows);

/// printf's "%.3g" and unit.
std::string number_text(double value, const std::string& unit = "");

/// A JSON list of {"name", "value", "unit"}, whole or not at all. Throws std::runtime_error.
void write_figures(const std::filesystem::path& file, const std::vector<Figure>& figures);

}  // namespace omentum::tissue_compare
