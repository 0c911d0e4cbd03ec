#include "haptic_node/spread_contact.h"

#include "physics/contact_problem.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic {
namespace {

constexpr int kMaxUnknowns = 3 * ContactNodes::kSlots;

// The nodes that the remaining contacts impose; a shared node obeys the contact that moves it furthest.
int impose(std::span<const SpreadContact> contacts, const std::array<bool, physics::kMaxContacts>& dropped,
           std::span<SpreadForce> result, double* u) {
  int count = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (dropped[i]) continue;
    for (int v = 0; v < contacts[i].count; ++v) {
      const Vec3 imposed = contacts[i].alpha[v] * contacts[i].displacement;
      int at = 0;
      while (at < count && result[at].slot != contacts[i].slot[v]) ++at;
      Eigen::Map<Vec3> u_at(u + 3 * at);
      if (at < count && imposed.squaredNorm() <= u_at.squaredNorm()) continue;
      result[at] = {contacts[i].slot[v], static_cast<int>(i), Vec3::Zero()};
      u_at = imposed;
      count = std::max(count, at + 1);
    }
  }
  return count;
}

void fill(const ContactNodes& nodes, std::span<const SpreadForce> imposed, double* C) {
  const int n = static_cast<int>(imposed.size());
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b <= a; ++b) {
      const Eigen::Map<const Eigen::Matrix3f> block(nodes.block(imposed[a].slot, imposed[b].slot));
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) C[(3 * a + i) * kMaxUnknowns + 3 * b + j] = block(i, j);
      }
    }
    // components that are held by themselves have no compliance
    for (int i = 0; i < 3; ++i) C[(3 * a + i) * (kMaxUnknowns + 1)] += physics::kContactCompliance_m_n;
  }
}

// Row-wise Cholesky in place, then both substitutions. Eigen's blocked one may allocate at this size.
void solve_positive(double* L, int n, double* x) {
  for (int i = 0; i < n; ++i) {
    double* row = L + i * kMaxUnknowns;
    for (int j = 0; j <= i; ++j) {
      const double* other = L + j * kMaxUnknowns;
      double sum = row[j];
      for (int k = 0; k < j; ++k) sum -= row[k] * other[k];
      row[j] = i == j ? std::sqrt(sum) : sum / other[j];
    }
    for (int k = 0; k < i; ++k) x[i] -= row[k] * x[k];
    x[i] /= row[i];
  }
  for (int i = n - 1; i >= 0; --i) {
    x[i] /= L[i * (kMaxUnknowns + 1)];
    for (int k = 0; k < i; ++k) x[k] -= L[i * kMaxUnknowns + k] * x[i];
  }
}

}  // namespace

SpreadWorkspace::SpreadWorkspace() : factor(kMaxUnknowns * kMaxUnknowns), f(kMaxUnknowns) {}

int solve_spread(const ContactNodes& nodes, std::span<const SpreadContact> contacts, SpreadWorkspace& work,
                 std::span<SpreadForce> result) noexcept {
  std::array<bool, physics::kMaxContacts> dropped{};
  // every round drops a contact or is the last
  for (std::size_t round = 0; round <= contacts.size(); ++round) {
    const int count = impose(contacts, dropped, result, work.f.data());
    fill(nodes, result.first(count), work.factor.data());
    solve_positive(work.factor.data(), 3 * count, work.f.data());
    std::array<double, physics::kMaxContacts> pull{};
    for (int a = 0; a < count; ++a) {
      result[a].force = Eigen::Map<const Vec3>(work.f.data() + 3 * a);
      const SpreadContact& contact = contacts[result[a].contact];
      if (!contact.may_pull) pull[result[a].contact] += result[a].force.dot(contact.normal);
    }
    const auto worst = std::max_element(pull.begin(), pull.end());
    if (*worst <= 0) return count;
    dropped[worst - pull.begin()] = true;
  }
  return 0;
}

}  // namespace omentum::haptic
