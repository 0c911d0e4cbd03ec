// The newest contact of every tool with every organ: checked as it arrives, faded when its sender falls
// silent.
#pragma once

#include "deform_node/cut_book.h"
#include "deform_node/organ_models.h"
#include "physics/surface_compliance.h"
#include "runtime/faults.h"
#include "runtime/mailbox.h"
#include "scene/scene.h"
#include "transport/messages.h"

#include <array>
#include <atomic>
#include <memory>
#include <vector>

namespace omentum::deform {

inline constexpr int kMaxTools = msg::MAX_TOOLS;
inline constexpr int kMaxNodesPerTool = msg::MAX_CONTACT_NODES;
inline constexpr int kMaxLoadedNodes = kMaxTools * kMaxNodesPerTool;

/// Contacts come at 250 Hz, and at once when one begins or ends; when none came for this long haptic_node is
/// gone, not late, s.
inline constexpr double kContactStale_s = 0.1;
/// The organ then comes back to rest within this: slow enough to be seen as a release, not as a jump, s.
inline constexpr double kContactFade_s = 0.3;

/// The share of a contact's force that still counts: 1 while fresh, then linear to 0.
double staleness_gain(double age_s) noexcept;

/// How a Contact's node numbers are read for one organ.
struct OrganNumbers {
  std::vector<NodeId> node_of_file;        // [nodes of the mesh file] invalid where the mesh has none
  std::vector<SurfaceId> surface_of_node;  // [N] of the uncut surface; invalid inside
  std::vector<bool> pinned;                // [N] nothing moves these
  double reach_m = 0;                      // farther no contact moves a node (contact_reach.h)
  // Not owned. With them a contact's nodes are of the surface that they are of, and what its forces would do
  // is checked; an organ without may be cut, which bares any node, and only what is claimed is checked.
  const physics::SurfaceCompliance* compliance = nullptr;
};

/// What a scene lets its contacts claim.
struct ContactBounds {
  std::uint32_t tools = 0;  // bit t: the scene has tool t
  double max_force_n = 0;   // on a hand; for the tissue see node_common/contact_bounds.h
};
ContactBounds bounds_of(const scene::Scene& scene);

/// Why a Contact is dropped.
enum class Rejection { kNone, kTool, kOrgan, kTopologyVersion, kLengths, kNode, kForce, kReach, kEdge };
const char* describe(Rejection rejection) noexcept;

/// A checked Contact with the mesh's nodes, of fixed size: it crosses threads without memory being taken.
struct HeldContact {
  msg::Echo cause{};
  std::int64_t received_ns = 0;  // this process's steady clock; 0: none came yet
  bool grasps = false;
  int count = 0;
  std::array<NodeId, kMaxNodesPerTool> nodes{};
  std::array<Vec3, kMaxNodesPerTool> displacements{};
  std::array<Vec3, kMaxNodesPerTool> forces{};
};

/// Translates `contact` into `held`, whose received_ns is set by the caller. Nodes that are held fixed are
/// left out: they cannot move, and a triangle at a support has some. The version is not looked at. Pure.
[[nodiscard]] Rejection check_contact(const msg::Contact& contact, const std::vector<OrganNumbers>& organs,
                                      const ContactBounds& bounds, HeldContact& held) noexcept;

/// The versions of an organ that contacts may be with. Nodes keep their numbers while an organ is cut, so
/// that a contact may be some cuts behind; with the organ before a reset nobody is in contact any more.
struct TopologyVersions {
  std::atomic<std::uint64_t> oldest{0}, newest{0};

  /// One without nodes says nothing of any version.
  bool hold(const msg::Contact& contact) const noexcept {
    return contact.nodes.empty() || (contact.topology_version >= oldest.load(std::memory_order_relaxed) &&
                                     contact.topology_version <= newest.load(std::memory_order_relaxed));
  }
};

/// Contacts with an organ as it was before a reset were sent by who had not heard of it: no fault, until they
/// still come kContactStale_s after the first of them. One thread.
class SentBeforeReset {
 public:
  /// Whether a contact that came now and is none of `versions` is one of those.
  bool take(const msg::Contact& contact, const TopologyVersions& versions, std::int64_t now_ns) noexcept;

 private:
  std::uint64_t oldest_ = 0;  // after the reset that they did not hear of
  std::int64_t first_ns_ = 0;
};

/// Contacts on their way from the receiving thread to the loop, one of each tool with each organ: who goes
/// from one to another lets go of the first by an empty contact, or by telling it none. take() and the loop's
/// methods may run at the same time on one thread each; neither waits or allocates.
class ContactBook {
 public:
  /// Dropped contacts are raised in `faults`, which must outlive the book.
  ContactBook(std::vector<OrganNumbers> organs, const ContactBounds& bounds, runtime::FaultList& faults);

  /// Receiving thread. What is told of a cut counts also where the nodes are another version's.
  void take(const msg::Contact& contact, std::int64_t now_ns) noexcept;

  /// Loop: the organ is cut by now / is another one by now, as after a reset.
  void now_at(std::uint32_t organ, std::uint64_t topology_version) noexcept;
  void begins_at(std::uint32_t organ, std::uint64_t topology_version) noexcept;

  /// Loop: looks at what arrived and fades what is old. Everything below refers to this moment.
  void advance(std::int64_t now_ns) noexcept;
  /// Loop: what the tools do to one organ; valid until the next advance().
  std::span<const ToolLoad> loads(std::uint32_t organ) noexcept;
  /// Loop: what their cutting edges swept of it since the advance() before; valid as loads are.
  std::span<const CutStroke> cuts(std::uint32_t organ) const noexcept;
  /// Loop: the newest pose of each tool that the loads take into account.
  std::span<const msg::Echo> echoes() const noexcept {
    return {echoes_.data(), static_cast<std::size_t>(echo_count_)};
  }
  /// Loop: forgets every contact received up to `now_ns`.
  void forget(std::int64_t now_ns) noexcept;
  /// Loop: forgets what was swept up to `now_ns`: another node cut it.
  void forget_cuts(std::int64_t now_ns) noexcept;

 private:
  /// One tool with one organ.
  struct Page {
    runtime::Mailbox<HeldContact> newest;
    double gain = 0;
    std::array<Vec3, kMaxNodesPerTool> faded_forces{};
  };
  struct OrganPages {
    TopologyVersions versions;
    SentBeforeReset late;  // receiving thread
    CutBook cuts;
    std::array<Page, kMaxTools> tools;
    std::array<ToolLoad, kMaxTools> loads{};
  };

  void advance(Page& page, std::int64_t now_ns) noexcept;
  void gather_echoes() noexcept;

  std::vector<OrganNumbers> organs_;
  ContactBounds bounds_;
  runtime::FaultList& faults_;
  HeldContact draft_;                               // receiving thread
  std::vector<std::unique_ptr<OrganPages>> pages_;  // [organs]
  std::int64_t forget_until_ns_ = 0;
  std::array<msg::Echo, kMaxTools> echoes_{};
  int echo_count_ = 0;
};

}  // namespace omentum::deform
