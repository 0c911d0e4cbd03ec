// Whether the organs' time keeps up with the clock's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace omentum::deform {

/// Time that organs lived through over the time that went by. One thread; nothing allocates.
class TimeAccount {
 public:
  /// How many calls of note() `recent` looks back.
  static constexpr std::size_t kRecent = 10;

  /// `lived_s`: of the slowest organ since its start; 0 where none has a time of its own. What went by since
  /// the last call counts, unless `stood_still`: then neither time did.
  void note(std::int64_t now_ns, double lived_s, bool stood_still) noexcept;

  /// Over the last calls; 0 while they stand still, and where no organ has a time of its own.
  double recent() const noexcept;
  /// Since the start; 0 likewise.
  double overall() const noexcept { return lived_ > 0 ? lived_ / passed_ : 0; }

 private:
  struct Mark {
    double passed_s = 0, lived_s = 0;
  };

  std::int64_t last_ns_ = 0;  // 0: never
  double passed_ = 0, lived_ = 0, last_lived_ = 0;
  bool stands_still_ = true;
  std::array<Mark, kRecent> marks_{};  // a ring
  std::size_t oldest_ = 0;
};

}  // namespace omentum::deform
