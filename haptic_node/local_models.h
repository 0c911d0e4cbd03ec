// Local models on their way from the wire to the bodies that tools touch.
#pragma once

#include "haptic_node/haptic_setup.h"
#include "haptic_node/local_body.h"
#include "runtime/clock.h"
#include "runtime/faults.h"
#include "runtime/woken_thread.h"
#include "transport/messages.h"

#include <atomic>
#include <mutex>

namespace omentum::haptic {

/// A patch of which nothing newer came for so long is gone, s: a hand would press what nobody moves any more.
inline constexpr double kModelSilence_s = 0.2;

/// How local models fared.
struct LocalModelCounts {
  std::uint64_t heard = 0, dropped = 0, gone = 0;
};

/// Each tool has a place with each organ that is felt by local models, and touches no other tool's patch: so
/// nothing is felt twice. What is no model of this scene, comes late, or is of an older version than the
/// patch was already at, is dropped and raised as a fault: of a version patches know their own alone, because
/// they are told one by one, and one tool's may be a cut behind another's. Bodies are made on a thread of
/// their own.
class LocalModels {
 public:
  /// All outlive this. `start`: how the making thread is made; `clock`: HapticState's.
  LocalModels(const HapticSetup& setup, std::vector<BodyDoor>& doors, runtime::FaultList& faults,
              const runtime::Clock& clock, const runtime::StartWork& start);

  /// Receiving thread.
  void hear(const msg::LocalModel& model);
  /// Any thread, several times in kModelSilence_s: patches that are not told any more go.
  void look() noexcept { making_->wake(); }
  /// Any thread.
  LocalModelCounts counts() const noexcept;

 private:
  struct Heard {
    msg::LocalModel model;
    std::int64_t arrival_ns = 0;
  };
  // in the order of their arrival
  class Waiting {
   public:
    /// Receiving thread. False: the oldest had to go for it.
    bool push(Heard heard);
    /// Making thread: all, which wait no more.
    std::vector<Heard> take();

   private:
    std::mutex mutex_;
    std::vector<Heard> heard_;
  };
  // one tool's with one organ; numbers are the making thread's, and of samples that are models
  struct Patch {
    std::size_t organ = 0, tool = 0, place = 0;
    Waiting waiting;
    std::int64_t heard_ns = 0;  // 0: never
    std::uint64_t seq = 0, version = 0;
    std::int64_t made_ns = 0;  // arrival of what stands there; 0: nothing does
  };
  struct Organ {
    const LocalOrgan* known = nullptr;
    std::vector<std::unique_ptr<Patch>> patches;  // [tools]
  };

  Patch* patch_of(const msg::LocalModel& model);
  static const char* too_late(const Heard& heard, const Patch& patch);
  std::optional<LocalPatch> accept(const Heard& heard, Patch& patch);
  void drop(const std::string& why);
  void make();
  void make(Patch& patch);
  void empty(Patch& patch);

  const HapticSetup& setup_;
  std::vector<BodyDoor>& doors_;
  runtime::FaultList& faults_;
  const runtime::Clock& clock_;
  std::vector<Organ> organs_;  // [organs]
  std::atomic<std::uint64_t> heard_{0}, dropped_{0}, gone_{0};
  std::unique_ptr<runtime::WokenWork> making_;  // last: it uses what is above
};

/// The patch that a message tells of; it need not be one (reason_against).
LocalPatch patch_of_message(const msg::LocalModel& model);

/// Why a patch is none of this organ: a node that its mesh file does not have, or that is farther from its
/// rest than tissue gets (node_common/organ_reach.h).
std::optional<std::string> reason_against(const LocalPatch& patch, const LocalOrgan& organ);

}  // namespace omentum::haptic
