#include "organ_tools/tissue_compare/figures.h"

#include "files/whole_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace omentum::tissue_compare {

namespace {

constexpr std::size_t kGap = 2;  // spaces between columns

// `cell` at the right of its column.
std::string right(const std::string& cell, std::size_t width) {
  return std::string(kGap + width - std::min(width, cell.size()), ' ') + cell;
}

}  // namespace

std::string table(const std::string& title, const std::vector<std::string>& columns,
                  const std::vector<Row>& rows) {
  std::size_t head = 0;
  std::vector<std::size_t> widths;
  for (const std::string& column : columns) widths.push_back(column.size());
  for (const Row& row : rows) {
    head = std::max(head, row.what.size());
    for (std::size_t c = 0; c < row.cells.size(); ++c) widths[c] = std::max(widths[c], row.cells[c].size());
  }
  std::string text = title + "\n" + std::string(head, ' ');
  for (std::size_t c = 0; c < columns.size(); ++c) text += right(columns[c], widths[c]);
  for (const Row& row : rows) {
    text += "\n" + row.what + std::string(head - row.what.size(), ' ');
    for (std::size_t c = 0; c < row.cells.size(); ++c) text += right(row.cells[c], widths[c]);
  }
  return text + "\n";
}

std::string number_text(double value, const std::string& unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g%s%s", value, unit.empty() ? "" : " ", unit.c_str());
  return text;
}

void write_figures(const std::filesystem::path& file, const std::vector<Figure>& figures) {
  nlohmann::json list = nlohmann::json::array();
  for (const Figure& figure : figures)
    list.push_back({{"name", figure.name}, {"value", figure.value}, {"unit", figure.unit}});
  files::write_whole(file, list.dump(2) + '\n');
}

}  // namespace omentum::tissue_compare
