// One table of a TOML file, read key by key, with messages that name file, line and key.
#pragma once

#include "geometry/types.h"

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace omentum::scene {

using geometry::Vec3;

/// Permitted values of a number; `minimum` itself is permitted unless `above` is set, likewise `maximum` and
/// `below`.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool above = false, below = false;

  bool holds(double value) const;
  std::string words() const;  // "a number above 0", ...
};

inline constexpr Range kAny{};
inline constexpr Range kPositive{.minimum = 0, .above = true};
inline constexpr Range kNotNegative{.minimum = 0};

/// Every reader throws std::runtime_error "FILE:LINE: key: found ..., expected ..." and remembers the key;
/// refuse_unknown_keys() names those that nobody read. start-up only.
class TomlSection {
 public:
  /// `name` is put before the keys in messages, e.g. "tools[1]." or "".
  TomlSection(std::shared_ptr<const toml::table> table, std::filesystem::path file, std::string name);

  bool has(const std::string& key) const { return table_->contains(key); }
  // A key that is absent keeps the value that `value` has; with `required` it is refused.
  enum Need { kOptional, kRequired };
  void read(const std::string& key, double& value, Need need, const Range& range = kAny);
  void read(const std::string& key, std::uint32_t& value, Need need, std::uint32_t maximum);
  void read(const std::string& key, std::string& value, Need need);
  void read(const std::string& key, bool& value, Need need);
  void read(const std::string& key, Vec3& value, Need need);
  void read(const std::string& key, std::optional<Vec3>& value);
  void read(const std::string& key, std::optional<double>& value, const Range& range);
  void read(const std::string& key, std::optional<std::int32_t>& value);
  /// A list of `count` numbers; an absent one stays as `value` is.
  void read(const std::string& key, std::vector<double>& value, std::size_t count);
  void read(const std::string& key, std::vector<Vec3>& value, Need need);
  /// One of `words`.
  void read_word(const std::string& key, std::string& value, Need need,
                 const std::vector<std::string>& words);
  /// A direction: length 1 within 1e-3, then normalized.
  void read_direction(const std::string& key, Vec3& value, Need need);

  /// A [table] or the [[tables]] of this section; an absent table is empty.
  TomlSection section(const std::string& key);
  std::vector<TomlSection> sections(const std::string& key);

  void refuse_unknown_keys() const;
  [[noreturn]] void refuse(const std::string& key, const std::string& found,
                           const std::string& expected) const;
  /// "FILE:LINE", of the key where it is present, else of the table.
  std::string place(const std::string& key) const;

 private:
  const toml::node* find(const std::string& key, Need need, const std::string& expected);
  Vec3 triple(const std::string& key, const toml::node& node) const;
  std::vector<double> numbers(const std::string& key, const toml::node& node, std::size_t count,
                              const std::string& expected) const;

  // shared: every section points into the one document (a copy of a toml::table would lose its line numbers)
  std::shared_ptr<const toml::table> table_;
  std::filesystem::path file_;
  std::string name_;
  std::vector<std::string> known_;
};

/// Parses the file. Throws std::runtime_error with file and line.
TomlSection open_toml(const std::filesystem::path& file);

}  // namespace omentum::scene
