// What a bench found, as a list that programs read (docs/design.md, "Report").
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace omentum::bench {

/// One figure. What there is not is left out of the file.
struct Entry {
  std::string
      name;  // unique over all benches: what, then its cases, from the coarsest: net_energy/liver/4/45
  double value = 0;
  std::string unit;                   // "us", "N", ...; "1" for a ratio or a count
  std::optional<double> limit{};      // the target of the issue that asked for the figure, in `unit`
  std::optional<double> reference{};  // what it is compared with, in `unit`
  std::optional<double> ratio{};      // value over reference
};

/// The figures of one program, which takes `--json FILE`. One thread's.
///
///     Results results(argc, argv);  // before the program reads its other arguments
///     results.add({.name = "force_step_n/liver", .value = 0.013, .unit = "N", .limit = 0.02});
///     results.write();
class Results {
 public:
  /// Takes `--json FILE` (or `--json=FILE`) out of the arguments. Ends the program with code 2, and a line,
  /// when FILE is missing.
  Results(int& argc, char** argv);

  /// A figure of the same name is replaced: a bench may measure more than once.
  void add(Entry entry);
  /// Sets reference and ratio of `name` to the figure `to`; nothing where one of them was not measured.
  void compare(const std::string& name, const std::string& to);
  /// Sets the target of `name`; nothing where that was not measured.
  void limit(const std::string& name, double limit);
  const std::vector<Entry>& entries() const { return entries_; }

  /// Writes the list to FILE; nothing without `--json`. Throws std::runtime_error.
  void write() const;

 private:
  Entry* find(const std::string& name);

  std::filesystem::path file_;
  std::vector<Entry> entries_;
};

}  // namespace omentum::bench
