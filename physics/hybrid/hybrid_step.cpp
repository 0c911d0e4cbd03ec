#include "physics/hybrid/hybrid_step.h"

#include <algorithm>

namespace omentum::physics {

namespace {

using geometry::NodeId;
using geometry::TetId;

// What differs from a node's weight by less is that weight, summed in another order.
constexpr double kRounding = 1e-9;

std::size_t at(NodeId n) {
  return 3 * static_cast<std::size_t>(n);
}

}  // namespace

HybridStep::HybridStep(HybridBody body, double step_s, int most_compliance_nodes)
    : node_(body.split.dynamic.node),
      own_node_(body.split.dynamic.own_node),
      own_tetrahedron_(body.split.dynamic.own_tetrahedron),
      connection_(body.split, body.surface, body.tie),
      surface_of_(own_node_.size()),
      viscosity_s_(body.inertia.stiffness_damping_s),
      part_(body.compliance, {connection_.nodes().begin(), connection_.nodes().end()}, sag_of(body)),
      dynamic_(dynamic_step_of(body, connection_, part_.stiffness(), step_s, most_compliance_nodes)),
      mass_(own_node_.size()),
      own_(state_at_rest(node_.size())),
      own_external_(own_.u.size()),
      own_yield_(own_.u.size()),
      own_ahead_(own_.u.size()),
      f_c_(3 * connection_.nodes().size()),
      w_c_(f_c_.size()),
      w_(3 * static_cast<std::size_t>(part_.mobile_count())),
      known_(most_compliance_nodes) {
  weights_ = std::move(body.weights);
  find_mass();
  removed_.reserve(body.split.dynamic.tetrahedron.size());
  for (std::int32_t s = 0; s < part_.mobile_count(); ++s) {
    const NodeId n = body.split.precomputed.node[body.surface.node[static_cast<std::size_t>(s)]];
    surface_node_.push_back(n);
    if (!own_node_[n].valid()) surface_of_[n] = SurfaceId(s);
  }
  loaded_.reserve(surface_node_.size());
  loads_.reserve(surface_node_.size());
  const auto most = static_cast<std::size_t>(most_compliance_nodes);
  touched_.reserve(most);
  turned_.reserve(most);
  support_.reserve(connection_.leaders().size() + most);
  led_.resize(3 * connection_.leaders().size());
  passed_on_.resize(static_cast<Eigen::Index>(f_c_.size()), 3 * most_compliance_nodes);
  held_.resize(3 * most_compliance_nodes, 3 * most_compliance_nodes);
  rows_.resize(9 * support_.capacity() * most);
}

void HybridStep::gather(std::span<const double> whole, std::span<double> own) const noexcept {
  for (std::size_t d = 0; d < node_.size(); ++d)
    std::copy_n(whole.data() + at(node_[d]), 3, own.data() + 3 * d);
}

void HybridStep::scatter(std::span<const double> own, std::span<double> whole) const noexcept {
  for (std::size_t d = 0; d < node_.size(); ++d)
    std::copy_n(own.data() + 3 * d, 3, whole.data() + at(node_[d]));
}

void HybridStep::find_mass() noexcept {
  for (std::size_t d = 0; d < node_.size(); ++d) mass_[node_[d]] = dynamic_->mass()[d];
}

// On the precomputed part's own surface, beside what always acts.
void HybridStep::collect_loads(std::span<const double> forces, Sag sag) noexcept {
  loaded_.clear();
  loads_.clear();
  for (std::size_t s = 0; s < surface_node_.size(); ++s) {
    const NodeId n = surface_node_[s];
    if (!surface_of_[n].valid()) continue;
    Vec3 f(forces.data() + at(n));
    const Vec3 weight = sag == Sag::kWith ? Vec3(weights_.data() + at(n)) : Vec3::Zero().eval();
    f -= weight;
    if (f.norm() <= kRounding * weight.norm()) continue;
    loaded_.emplace_back(s);
    loads_.push_back(f);
  }
}

// All forces as the dynamic part's nodes feel them, into own_external_.
void HybridStep::condense(std::span<const double> forces, Sag sag) noexcept {
  collect_loads(forces, sag);
  gather(forces, own_external_);
  part_.condense(loads(), sag, f_c_);
  connection_.add_gathered(f_c_, own_external_);
}

// w_c = u_c + b v_c, which the precomputed part has to follow.
void HybridStep::lead(std::span<const double> u, std::span<const double> v) noexcept {
  connection_.lead(u, v, viscosity_s_, w_c_);
}

// Nodes that are held to be somewhere are there, beyond what floats make of it: no gap at the border.
void HybridStep::follow(Sag sag) noexcept {
  part_.follow(w_c_, loads(), sag, f_c_, w_);
  for (std::size_t k = 0; k < connection_.nodes().size(); ++k)
    std::copy_n(w_c_.data() + 3 * k, 3, w_.data() + 3 * static_cast<std::size_t>(connection_.nodes()[k]));
}

bool HybridStep::step(BodyState& state, std::span<const double> external) noexcept {
  return move(state, external, &LargeStep::step);
}

bool HybridStep::step_again(BodyState& state, std::span<const double> external) noexcept {
  return move(state, external, &LargeStep::step_again);
}

bool HybridStep::move(BodyState& state, std::span<const double> external, Step step) noexcept {
  gather(state.u, own_.u);
  gather(state.v, own_.v);
  condense(external, Sag::kWith);
  if (!(dynamic_.get()->*step)(own_, own_external_)) return false;
  scatter(own_.u, state.u);
  scatter(own_.v, state.v);
  lead(own_.u, own_.v);
  follow(Sag::kWith);
  for (std::size_t s = 0; s < surface_node_.size(); ++s) {
    if (!surface_of_[surface_node_[s]].valid()) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t c = at(surface_node_[s]) + i;
      state.v[c] = (w_[3 * s + i] - state.u[c]) / (step_s() + viscosity_s_);
      state.u[c] += step_s() * state.v[c];
    }
  }
  return true;
}

void HybridStep::foresee(const BodyState& state, std::span<const double> external,
                         std::span<double> u) noexcept {
  gather(state.u, own_.u);
  gather(state.v, own_.v);
  condense(external, Sag::kWith);
  dynamic_->foresee(own_, own_external_, own_ahead_);
  for (std::size_t c = 0; c < own_ahead_.size(); ++c) own_.v[c] = (own_ahead_[c] - own_.u[c]) / step_s();
  lead(own_ahead_, own_.v);
  follow(Sag::kWith);
  std::ranges::copy(state.u, u.begin());
  scatter(own_ahead_, u);
  const double share = step_s() / (step_s() + viscosity_s_);
  for (std::size_t s = 0; s < surface_node_.size(); ++s) {
    if (!surface_of_[surface_node_[s]].valid()) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t c = at(surface_node_[s]) + i;
      u[c] += share * (w_[3 * s + i] - state.u[c]);
    }
  }
}

void HybridStep::yield_to(std::span<const double> forces, std::span<double> yield) noexcept {
  condense(forces, Sag::kWithout);
  gather(yield, own_yield_);
  dynamic_->yield_to(own_external_, own_yield_);
  const double share = step_s() / (step_s() + viscosity_s_);
  connection_.lead(own_yield_, own_yield_, 0, w_c_);
  for (double& w : w_c_) w /= share;
  follow(Sag::kWithout);
  std::ranges::fill(yield, 0.0);
  scatter(own_yield_, yield);
  for (std::size_t s = 0; s < surface_node_.size(); ++s) {
    if (!surface_of_[surface_node_[s]].valid()) continue;
    for (std::size_t i = 0; i < 3; ++i) yield[at(surface_node_[s]) + i] = share * w_[3 * s + i];
  }
}

double HybridStep::elastic_energy(std::span<const double> u) noexcept {
  gather(u, own_.u);
  return dynamic_->elastic_energy(own_.u);
}

double HybridStep::work(std::span<const double> external, std::span<const double> v) noexcept {
  condense(external, Sag::kWith);
  gather(v, own_.v);
  return dynamic_->work(own_external_, own_.v);
}

bool HybridStep::remove(std::span<const TetId> tetrahedra) noexcept {
  known_.forget();
  removed_.clear();
  for (const TetId t : tetrahedra)
    if (own_tetrahedron_[t].valid()) removed_.push_back(own_tetrahedron_[t]);
  const bool sound = dynamic_->remove(removed_);
  find_mass();
  return sound;
}

void HybridStep::restore() noexcept {
  known_.forget();
  dynamic_->restore();
  find_mass();
}

// Each touched node's displacement by those of dynamic nodes, and these nodes: leaders first.
void HybridStep::find_rows(std::span<const NodeId> nodes) noexcept {
  touched_.clear();
  support_.assign(connection_.leaders().begin(), connection_.leaders().end());
  for (const NodeId n : nodes)
    if (!own_node_[n].valid()) touched_.push_back(surface_of_[n]);
  part_.passed_on(touched_, passed_on_.leftCols(static_cast<Eigen::Index>(3 * touched_.size())));
  const std::size_t width = 3 * nodes.size();
  std::ranges::fill(rows_, 0.0F);
  Eigen::Index column = 0;  // of B
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    const NodeId own = own_node_[nodes[p]];
    if (!own.valid()) {
      for (std::size_t i = 0; i < 3; ++i, ++column) {
        connection_.gather(std::span(passed_on_.col(column).data(), f_c_.size()), led_);
        for (std::size_t m = 0; m < led_.size(); ++m)
          rows_[m * width + 3 * p + i] = static_cast<float>(led_[m]);
      }
      continue;
    }
    const auto found = static_cast<std::size_t>(std::ranges::find(support_, own) - support_.begin());
    if (found == support_.size()) support_.push_back(own);
    for (std::size_t i = 0; i < 3; ++i) rows_[(3 * found + i) * width + 3 * p + i] = 1;
  }
}

// What the precomputed part's own nodes yield among themselves.
void HybridStep::add_yield_held(std::span<const NodeId> nodes, std::span<float> block) noexcept {
  const auto size = static_cast<Eigen::Index>(3 * touched_.size());
  part_.yield_held(touched_, passed_on_.leftCols(size), held_.topLeftCorner(size, size));
  const double share = step_s() / (step_s() + viscosity_s_);
  const std::size_t width = 3 * nodes.size();
  Eigen::Index a = 0;
  for (std::size_t p = 0; p < width; ++p) {
    if (own_node_[nodes[p / 3]].valid()) continue;
    Eigen::Index b = 0;
    for (std::size_t q = 0; q < width; ++q)
      if (!own_node_[nodes[q / 3]].valid()) block[p * width + q] += static_cast<float>(share * held_(a, b++));
    ++a;
  }
}

// What is known is of the rest shape. A column of the precomputed part's goes by the connection's leaders
// alone, which do not turn; each other node's turns with it.
void HybridStep::compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept {
  if (!known_.find(nodes, block)) {
    find_rows(nodes);
    const std::size_t width = 3 * nodes.size();
    dynamic_->project_at_rest(support_, std::span(rows_).first(3 * support_.size() * width), block);
    add_yield_held(nodes, block);
    known_.keep(nodes, block);
  }
  turned_.clear();
  for (const NodeId n : nodes) turned_.push_back(own_node_[n]);
  dynamic_->turn(turned_, block);
}

}  // namespace omentum::physics
