// A node's whole loop where nothing but the test moves it.
#pragma once

#include "scripted_pace.h"

#include <string>
#include <utility>

namespace omentum::test {

/// Makes a node's loop, and runs it on a scripted pace up to its first wait.
///
///     FakeBus bus;
///     StagedLoop<HapticLoop> node(1000, options, bus.opener());
///     node.pass(1.0);
///     EXPECT_EQ(node.end(), "");
template <class Loop>
class StagedLoop {
 public:
  /// `arguments`: the loop's own, but for its pace.
  template <class... Arguments>
  explicit StagedLoop(double rate_hz, Arguments&&... arguments)
      : pace_(rate_hz), loop_(std::forward<Arguments>(arguments)..., pace_) {
    pace_.run([this] { loop_.run(); });
  }
  ~StagedLoop() { static_cast<void>(end()); }
  StagedLoop(const StagedLoop&) = delete;
  StagedLoop& operator=(const StagedLoop&) = delete;

  /// ScriptedPace::tick and pass.
  bool tick(int count = 1) { return pace_.tick(count); }
  bool pass(double seconds) { return pace_.pass(seconds); }
  /// Ends it, if it did not end by itself. Why it must not go on; empty where nothing was wrong.
  std::string end() {
    try {
      pace_.finish();
    } catch (const std::exception& refusal) {
      return refusal.what();
    }
    return {};
  }

  ScriptedPace& pace() { return pace_; }
  const ScriptedPace& pace() const { return pace_; }
  Loop& loop() { return loop_; }

 private:
  ScriptedPace pace_;
  Loop loop_;
};

}  // namespace omentum::test
