#include "physics/hybrid/interface_map.h"

#include "geometry/closest_points.h"

#include <limits>
#include <map>

namespace omentum::physics {

namespace {

using Triangle = std::array<std::int32_t, 3>;

// Each edge of a face in so many pieces: what is integrated has kinks at the other mesh's edges.
constexpr int kPieces = 8;
// Of a place on a face, the share of the corner behind it.
constexpr double kNoWeight = 1e-12;

// Places in the coarse tissue, by tetrahedra behind its boundary.
class Behind {
 public:
  Behind(const geometry::TetraMesh& mesh, const geometry::Surface& boundary)
      : mesh_(mesh), boundary_(boundary) {}

  const geometry::Tetrahedron& nearest(const Vec3& p) const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t found = 0;
    for (std::size_t f = 0; f < boundary_.triangles.size(); ++f) {
      const geometry::Triangle& t = boundary_.triangles[f];
      const double squared =
          geometry::closest_point_on_triangle(p, corner(t[0]), corner(t[1]), corner(t[2])).squared_distance;
      if (squared >= least) continue;
      least = squared;
      found = f;
    }
    return mesh_.tetrahedra[boundary_.tetrahedron[found]];
  }
  Eigen::Vector4d weights(const geometry::Tetrahedron& t, const Vec3& p) const {
    Eigen::Matrix4d corners;
    for (int i = 0; i < 4; ++i) corners.col(i) << mesh_.positions[t[static_cast<std::size_t>(i)]], 1;
    return corners.partialPivLu().solve(Eigen::Vector4d(p.x(), p.y(), p.z(), 1));
  }

 private:
  const Vec3& corner(geometry::SurfaceId s) const { return mesh_.positions[boundary_.node[s]]; }

  const geometry::TetraMesh& mesh_;
  const geometry::Surface& boundary_;
};

// Sums of weights by row and node; the nodes become columns.
class Rows {
 public:
  explicit Rows(std::size_t count) : count_(static_cast<Eigen::Index>(count)) {}

  void add(Eigen::Index row, const geometry::Tetrahedron& t, const Eigen::Vector4d& weights) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (std::abs(weights[static_cast<Eigen::Index>(i)]) <= kNoWeight * weights.cwiseAbs().maxCoeff())
        continue;
      auto [found, fresh] = columns_.try_emplace(t[i]);
      if (fresh) found->second = Eigen::VectorXd::Zero(count_);
      found->second[row] += weights[static_cast<Eigen::Index>(i)];
    }
  }
  InterfaceMap map() const {
    InterfaceMap map{{}, Eigen::MatrixXd(count_, static_cast<Eigen::Index>(columns_.size()))};
    for (const auto& [node, column] : columns_) {
      map.P.col(static_cast<Eigen::Index>(map.masters.size())) = column;
      map.masters.push_back(node);
    }
    return map;
  }

 private:
  Eigen::Index count_;
  std::map<NodeId, Eigen::VectorXd> columns_;
};

double area_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a).norm() / 2;
}

// Calls visit(barycentric coordinates, share of the face) at points that integrate quadratic functions over
// each piece of a face.
template <class Visit>
void for_each_point(Visit&& visit) {
  const double share = 1.0 / (3 * kPieces * kPieces);
  const auto piece = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d((a + b) / 2), Eigen::Vector3d((b + c) / 2), Eigen::Vector3d((c + a) / 2)})
      visit(p, share);
  };
  const auto at = [](int i, int j) -> Eigen::Vector3d {
    return Eigen::Vector3d(i, j, kPieces - i - j) / kPieces;
  };
  for (int i = 0; i < kPieces; ++i) {
    for (int j = 0; i + j < kPieces; ++j) {
      piece(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i + j + 1 < kPieces) piece(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

}  // namespace

InterfaceMap tie_pointwise(const geometry::TetraMesh& coarse, const geometry::Surface& boundary,
                           std::span<const Vec3> slaves) {
  const Behind behind(coarse, boundary);
  Rows rows(slaves.size());
  for (std::size_t s = 0; s < slaves.size(); ++s) {
    const geometry::Tetrahedron& t = behind.nearest(slaves[s]);
    rows.add(static_cast<Eigen::Index>(s), t, behind.weights(t, slaves[s]));
  }
  return rows.map();
}

InterfaceMap tie_by_mortar(const geometry::TetraMesh& coarse, const geometry::Surface& boundary,
                           std::span<const Vec3> slaves, std::span<const Triangle> faces) {
  const Behind behind(coarse, boundary);
  Rows rows(slaves.size());
  const auto count = static_cast<Eigen::Index>(slaves.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(count, count);
  for (const Triangle& face : faces) {
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return slaves[static_cast<std::size_t>(face[i])];
    };
    const double area = area_of(corner(0), corner(1), corner(2));
    for_each_point([&](const Eigen::Vector3d& phi, double share) {
      const Vec3 p = phi[0] * corner(0) + phi[1] * corner(1) + phi[2] * corner(2);
      const geometry::Tetrahedron& t = behind.nearest(p);
      const Eigen::Vector4d weights = behind.weights(t, p);
      for (std::size_t i = 0; i < 3; ++i) {
        const double w = share * area * phi[static_cast<Eigen::Index>(i)];
        rows.add(face[i], t, w * weights);
        for (std::size_t j = 0; j < 3; ++j) M(face[i], face[j]) += w * phi[static_cast<Eigen::Index>(j)];
      }
    });
  }
  InterfaceMap map = rows.map();
  map.P = M.ldlt().solve(map.P).eval();
  return map;
}

AddedStiffness tied(const InterfaceMap& map, const Eigen::MatrixXd& S) {
  const Eigen::Index masters = map.P.cols();
  Eigen::MatrixXd K(3 * masters, 3 * masters), SP(S.rows(), 3 * masters);
  for (Eigen::Index c = 0; c < SP.cols(); ++c) {
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(3 * masters);
    unit[c] = 1;
    SP.col(c) = S * spread(map, unit);
  }
  for (Eigen::Index c = 0; c < SP.cols(); ++c) K.col(c) = gathered(map, SP.col(c));
  return {map.masters, (K + K.transpose()) / 2};
}

Eigen::VectorXd gathered(const InterfaceMap& map, const Eigen::VectorXd& f) {
  using ByNode = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Eigen::Map<const ByNode> forces(f.data(), map.P.rows(), 3);
  const ByNode sums = map.P.transpose() * forces;
  return Eigen::Map<const Eigen::VectorXd>(sums.data(), sums.size());
}

Eigen::VectorXd spread(const InterfaceMap& map, const Eigen::VectorXd& u) {
  using ByNode = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const ByNode places = map.P * Eigen::Map<const ByNode>(u.data(), map.P.cols(), 3);
  return Eigen::Map<const Eigen::VectorXd>(places.data(), places.size());
}

}  // namespace omentum::physics
