// What is cut of a scene's organs, in a file: a deform_node that is started again goes on with it.
#pragma once

#include "deform_node/organ_cuts.h"
#include "deform_node/served_organ.h"
#include "deform_node/tick_snapshot.h"
#include "runtime/faults.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace omentum::deform {

/// What a journal belongs to; another scene's says nothing of this one's organs.
struct JournalScene {
  struct Organ {
    std::string name, hash;            // of its file
    std::size_t tetrahedra = 0;        // whose bits a journal has; 0: it cannot be cut
    std::vector<std::uint8_t> kept{};  // [T] other than 0: precomputed, nothing takes it away; empty: none is
  };
  std::string hash;  // SceneInfo.hash
  std::vector<Organ> organs;
};

JournalScene journal_scene(const std::string& scene_hash, const std::vector<ServedOrgan>& organs);

/// What a journal says of each organ; in version 0 it says nothing.
struct JournalContents {
  std::vector<OrganCuts> organs;
  /// Why it cannot be used, in one line with file and place; empty: it can, or there is none. With a flaw the
  /// organs are whole, in a version above all that the file names, or above all that a session reaches.
  std::string flaw;
};

/// JSON with both bit sets as hexadecimal digits; `cuts` are one for each organ.
std::string journal_text(const JournalScene& scene, std::span<const OrganCuts> cuts);
/// Of a file as anybody may have left it. Throws nothing but std::bad_alloc.
JournalContents read_journal(const std::filesystem::path& file, const JournalScene& scene);

/// The journal of a running node. read() and keep() may be on one thread each: the file is replaced whole.
class CutJournal {
 public:
  /// `faults` outlives it. Touches no file yet.
  CutJournal(std::filesystem::path file, JournalScene scene, runtime::FaultList& faults);

  /// For each organ what the last one who served left of it. A flaw is said on stderr, and is a fault.
  std::vector<OrganCuts> read() const;

  /// The publishing thread, before a topology leaves: what anybody was told is then in the file. Writes when
  /// some organ is in another version than before; where that fails it is a fault, and tried again.
  void keep(std::span<const OrganSnapshot> organs);

 private:
  std::filesystem::path file_;
  JournalScene scene_;
  runtime::FaultList& faults_;
  std::vector<OrganCuts> kept_;
  bool is_due_ = true;
};

}  // namespace omentum::deform
