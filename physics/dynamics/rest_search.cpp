#include "physics/dynamics/rest_search.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace omentum::physics {

namespace {

using Values = std::vector<double>;

// Pairs of steps and changes of force that are remembered: more did not shorten searches.
constexpr std::size_t kMemory = 12;
constexpr double kSufficient = 1e-4;  // Armijo's part of the decrease that the slope promises
constexpr int kMostHalvings = 50;
constexpr int kMostIdle = 200;  // steps that do not halve the imbalance: it has met the forces' rounding

double dot(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += a[c] * b[c];
  return sum;
}

double largest(const Values& values) {
  double found = 0;
  for (const double value : values) found = std::max(found, std::abs(value));
  return found;
}

void add(Values& to, double scale, const Values& values) {
  for (std::size_t c = 0; c < to.size(); ++c) to[c] += scale * values[c];
}

struct Pair {
  Values step, change;  // of u and of the gradient
  double inverse;       // 1 / (step . change)
};

class Search {
 public:
  Search(ForceLaw& law, KeptFactor& factor, std::span<const double> external, Values& u)
      : law_(law),
        factor_(factor),
        external_(external.begin(), external.end()),
        u_(u),
        gradient_(u.size()),
        direction_(u.size()) {
    look();
  }

  double imbalance() const { return largest(gradient_) / force_; }

  // One step downhill; false where there is none.
  bool descend() {
    aim();
    double slope = dot(gradient_, direction_);
    if (!(slope < 0)) {
      pairs_.clear();
      aim();
      slope = dot(gradient_, direction_);
    }
    return std::isfinite(slope) && go(slope);
  }

 private:
  // Energy and gradient at u, and the largest force so far.
  void look() {
    law_.forces(u_, gradient_);
    force_ = std::max({force_, largest(gradient_), largest(external_)});
    for (std::size_t c = 0; c < u_.size(); ++c)
      gradient_[c] = factor_.is_held(c) ? 0.0 : -gradient_[c] - external_[c];
    energy_ = law_.energy(u_) - dot(external_, u_);
  }

  // direction = - (what the pairs make of A^-1) gradient.
  void aim() {
    Values q = gradient_;
    std::vector<double> parts;
    for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair) {
      parts.push_back(pair->inverse * dot(pair->step, q));
      add(q, -parts.back(), pair->change);
    }
    factor_.solve(q, direction_);
    for (const Pair& pair : pairs_) {
      const double part = pair.inverse * dot(pair.change, direction_);
      add(direction_, parts.back() - part, pair.step);
      parts.pop_back();
    }
    for (double& d : direction_) d = -d;
  }

  bool go(double slope) {
    const Values start = u_, before = gradient_;
    const double energy = energy_;
    // where energies differ by their rounding only, forces decide what rest is
    const double rounding = 1e-13 * std::abs(energy);
    double t = 1;
    for (int i = 0; i < kMostHalvings; ++i, t /= 2) {
      u_ = start;
      add(u_, t, direction_);
      look();
      if (energy_ <= energy + kSufficient * t * slope + rounding) {
        remember(start, before);
        return true;
      }
    }
    u_ = start;
    look();
    return false;
  }

  void remember(const Values& start, const Values& before) {
    Pair pair{u_, gradient_, 0};
    add(pair.step, -1, start);
    add(pair.change, -1, before);
    const double curvature = dot(pair.step, pair.change);
    if (curvature <= 0) return;  // the inverse stiffness would not stay positive
    pair.inverse = 1 / curvature;
    pairs_.push_back(std::move(pair));
    if (pairs_.size() > kMemory) pairs_.pop_front();
  }

  ForceLaw& law_;
  KeptFactor& factor_;
  Values external_;
  Values& u_;
  Values gradient_, direction_;
  std::deque<Pair> pairs_;
  double energy_ = 0, force_ = std::numeric_limits<double>::min();
};

}  // namespace

bool search_rest(ForceLaw& law, KeptFactor& factor, std::span<const double> external, std::vector<double>& u,
                 const RestOptions& options) {
  Search search(law, factor, external, u);
  double best = search.imbalance();
  int idle = 0;
  for (int i = 0; i < options.most_iterations && idle < kMostIdle; ++i) {
    if (search.imbalance() <= options.balance) return true;
    if (!search.descend()) break;
    const bool better = search.imbalance() < best / 2;
    idle = better ? 0 : idle + 1;
    if (better) best = search.imbalance();
  }
  return search.imbalance() <= options.rounding;
}

}  // namespace omentum::physics
