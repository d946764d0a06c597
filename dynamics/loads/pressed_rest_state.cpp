// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/pressed_rest_state.hpp"

#include "dynamics/loads/surface_pressure.hpp"
#include "dynamics/loads/surface_pressure_check.hpp"
#include "dynamics/structure/sheet_kernel.hpp"
#include "dynamics/structure/stretched_facet.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace plekton::dynamics {
namespace {

using geometry::Positions;

constexpr double kShift = 1e-12;            // c, far above rounding, far below what is stiff
constexpr double kLargestImbalance = 1e-8;  // beyond it a node is told
constexpr double kSmallestStretch = 0.5;
constexpr double kLargestStretch = 1.5;

/// @throws std::invalid_argument of these words and numbers
[[noreturn]] void refuse(const auto&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

std::string node_at(NodeId node, Positions x) {
  const Vec3& place = x[index_of(node)];
  std::ostringstream text;
  text << "node " << index_of(node) << " at (" << place[0] << ", " << place[1] << ", " << place[2]
       << ") m";
  return text.str();
}

/// A facet of a sheet where it is drawn.
struct DrawnSheet {
  const SheetFacet* facet;
  ShapeGradients shape;
  Eigen::Matrix<double, 3, 2> axes;  // in the plane, unit
  Eigen::Matrix2d force;             // N/m, along these

  /// N, of the force on a corner in the plane.
  Vec3 pull(std::size_t corner) const {
    return axes * (-shape.area * (force * shape.gradients[corner]));
  }
};

/// A bar or beam where it is drawn.
struct DrawnBar {
  const BeamBond* bond;
  Vec3 direction;    // unit, from a to b
  double stiffness;  // N/m
  double force;      // N, pulling
};

std::vector<DrawnSheet> drawn_sheets(const PressedPart& part, const Scene& scene) {
  std::vector<DrawnSheet> sheets;
  for (std::size_t i = part.first_sheet; i < scene.sheet_facets.size(); ++i) {
    const SheetFacet& facet = scene.sheet_facets[i];
    const ShapeGradients shape = shape_gradients(facet.corners);
    std::array<Vec3, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = scene.state.position[index_of(facet.nodes[k])];
    // At rest as drawn, the gradient of the deformation is the two axes.
    sheets.push_back({&facet, shape, deformation_gradient(shape, x), Eigen::Matrix2d::Zero()});
  }
  return sheets;
}

std::vector<DrawnBar> drawn_bars(const PressedPart& part, const Scene& scene) {
  std::vector<DrawnBar> bars;
  for (std::size_t i = part.first_bond; i < scene.bonds.size(); ++i) {
    const BeamBond& bond = scene.bonds[i];
    const Vec3 chord = scene.state.position[index_of(bond.nodes[1])] -
                       scene.state.position[index_of(bond.nodes[0])];
    bars.push_back({&bond, chord / bond.length,
                    bond.section.young_modulus * bond.section.area / bond.length, 0.0});
  }
  return bars;
}

/// K u = f of a structure as it is drawn. The unknowns are the free translations of its nodes.
class DrawnStructure {
 public:
  DrawnStructure(double pressure, const PressedPart& part, const Scene& scene)
      : scene_(scene),
        sheets_(drawn_sheets(part, scene)),
        bars_(drawn_bars(part, scene)),
        load_(scene.state.size(), Vec3::Zero()),
        scale_(scene.state.size(), 0.0) {
    for (std::size_t i = part.first_facet; i < scene.elements.facets.size(); ++i) {
      const auto& nodes = scene.elements.facets[i].nodes;
      const Vec3 push = pressure * area_share(nodes, scene.state.position);
      for (const NodeId node : nodes) {
        load_[index_of(node)] += push;
        scale_[index_of(node)] += push.norm();
      }
    }
    number_unknowns();
  }

  /// Finds the forces of the elements. @returns the largest imbalance, and where it is
  std::pair<double, NodeId> balance() {
    if (count_ == 0) return {0.0, NodeId{-1}};
    const Eigen::SparseMatrix<double> matrix = shifted_stiffness();
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    Eigen::VectorXd displacement = Eigen::VectorXd::Zero(matrix.rows());
    std::pair<double, NodeId> worst = worst_imbalance();
    constexpr int kMost = 100;
    for (int round = 0; round < kMost && solver.info() == Eigen::Success; ++round) {
      displacement += solver.solve(on_unknowns(left_over()));
      strain(displacement);
      const auto before = std::exchange(worst, worst_imbalance());
      if (worst.first > 0.5 * before.first && round > 0) break;
    }
    return worst;
  }

  const std::vector<DrawnSheet>& sheets() const noexcept { return sheets_; }
  const std::vector<DrawnBar>& bars() const noexcept { return bars_; }

 private:
  using Entries = std::vector<Eigen::Triplet<double>>;

  void number_unknowns() {
    std::vector<bool> is_in(scene_.state.size(), false);
    for (const DrawnSheet& sheet : sheets_)
      for (const NodeId node : sheet.facet->nodes) is_in[index_of(node)] = true;
    for (const DrawnBar& bar : bars_)
      for (const NodeId node : bar.bond->nodes) is_in[index_of(node)] = true;
    unknowns_.assign(scene_.state.size(), {-1, -1, -1});
    for (std::size_t node = 0; node < is_in.size(); ++node) {
      for (int axis = 0; axis < 3; ++axis) {
        if (is_in[node] && !holds_along(scene_.properties.held[node], axis))
          unknowns_[node][static_cast<std::size_t>(axis)] = count_++;
      }
    }
  }

  void add_block(NodeId a, NodeId b, const Mat3& block, Entries& entries) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const int row = unknowns_[index_of(a)][i];
      for (std::size_t j = 0; j < 3 && row >= 0; ++j) {
        const int column = unknowns_[index_of(b)][j];
        if (column >= 0)
          entries.emplace_back(row, column,
                               block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      }
    }
    if (a != b) return;
    for (const int unknown : unknowns_[index_of(a)])
      if (unknown >= 0) entries.emplace_back(unknown, unknown, kShift * block.trace() / 3.0);
  }

  /// Of plane stress: the force on corner i by a displacement of corner j, in the plane.
  static void add_sheet(const DrawnSheet& sheet, const auto& add) {
    const SheetSection& section = sheet.facet->section;
    const double nu = section.poisson_ratio;
    const double stiffness = sheet.shape.area * section.tensile_stiffness / (1.0 - nu * nu);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2& g = sheet.shape.gradients[i];
      for (std::size_t j = 0; j < 3; ++j) {
        const Vec2& h = sheet.shape.gradients[j];
        const Eigen::Matrix2d block =
            0.5 * (1.0 - nu) * (g.dot(h) * Eigen::Matrix2d::Identity() + h * g.transpose()) +
            nu * g * h.transpose();
        add(sheet.facet->nodes[i], sheet.facet->nodes[j],
            stiffness * sheet.axes * block * sheet.axes.transpose());
      }
    }
  }

  Eigen::SparseMatrix<double> shifted_stiffness() const {
    Entries entries;
    entries.reserve(81 * sheets_.size() + 36 * bars_.size());
    const auto add = [&](NodeId a, NodeId b, const Mat3& block) {
      add_block(a, b, block, entries);
    };
    for (const DrawnSheet& sheet : sheets_) add_sheet(sheet, add);
    for (const DrawnBar& bar : bars_) {
      const Mat3 block = bar.stiffness * bar.direction * bar.direction.transpose();
      const auto [a, b] = bar.bond->nodes;
      add(a, a, block);
      add(b, b, block);
      add(a, b, -block);
      add(b, a, -block);
    }
    Eigen::SparseMatrix<double> matrix(count_, count_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// What the elements carry after a displacement.
  void strain(const Eigen::VectorXd& displacement) {
    const auto way = [&](NodeId node) {
      Vec3 u = Vec3::Zero();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (const int k = unknowns_[index_of(node)][axis]; k >= 0)
          u[static_cast<Eigen::Index>(axis)] = displacement[k];
      }
      return u;
    };
    for (DrawnSheet& sheet : sheets_) {
      const auto& nodes = sheet.facet->nodes;
      const Vec3 origin = way(nodes[0]);
      const Eigen::Matrix2d gradient =
          sheet.axes.transpose() *
          ((way(nodes[1]) - origin) * sheet.shape.gradients[1].transpose() +
           (way(nodes[2]) - origin) * sheet.shape.gradients[2].transpose());
      const Eigen::Matrix2d e = 0.5 * (gradient + gradient.transpose());
      const SheetSection& section = sheet.facet->section;
      const double nu = section.poisson_ratio;
      sheet.force = section.tensile_stiffness / (1.0 - nu * nu) *
                    ((1.0 - nu) * e + nu * e.trace() * Eigen::Matrix2d::Identity());
    }
    for (DrawnBar& bar : bars_) {
      const auto [a, b] = bar.bond->nodes;
      bar.force = bar.stiffness * bar.direction.dot(way(b) - way(a));
    }
  }

  /// N, by node: of the pressure and the elements.
  std::vector<Vec3> left_over() const {
    std::vector<Vec3> forces = load_;
    for (const DrawnSheet& sheet : sheets_)
      for (std::size_t i = 0; i < 3; ++i) forces[index_of(sheet.facet->nodes[i])] += sheet.pull(i);
    for (const DrawnBar& bar : bars_) {
      forces[index_of(bar.bond->nodes[0])] += bar.force * bar.direction;
      forces[index_of(bar.bond->nodes[1])] -= bar.force * bar.direction;
    }
    return forces;
  }

  Eigen::VectorXd on_unknowns(const std::vector<Vec3>& forces) const {
    Eigen::VectorXd result(count_);
    for (std::size_t node = 0; node < forces.size(); ++node) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (const int k = unknowns_[node][axis]; k >= 0)
          result[k] = forces[node][static_cast<Eigen::Index>(axis)];
      }
    }
    return result;
  }

  /// Nodes without facets are measured by the largest of the others.
  std::pair<double, NodeId> worst_imbalance() const {
    const double largest = *std::max_element(scale_.begin(), scale_.end());
    const std::vector<Vec3> forces = left_over();
    std::pair<double, NodeId> worst{0.0, NodeId{-1}};
    for (std::size_t node = 0; node < forces.size(); ++node) {
      const Vec3 free = forces[node].cwiseProduct(free_axes(scene_.properties.held[node]));
      const double imbalance = free.norm() / (scale_[node] > 0.0 ? scale_[node] : largest);
      if (imbalance > worst.first) worst = {imbalance, geometry::id_at<NodeId>(node)};
    }
    return worst;
  }

  const Scene& scene_;
  std::vector<DrawnSheet> sheets_;
  std::vector<DrawnBar> bars_;
  std::vector<Vec3> load_;     // N, by node
  std::vector<double> scale_;  // N, by node: the pressure times its share of the area
  std::vector<std::array<int, 3>> unknowns_;  // by node; -1 where it is held, or not of this
  int count_ = 0;
};

/// Sets the sizes at rest.
class RestSizes {
 public:
  explicit RestSizes(Positions x) : x_(x) {}

  double largest_stretch() const noexcept { return largest_stretch_; }

  void set(const DrawnSheet& drawn, SheetFacet& facet) {
    const NodeId node = facet.nodes[0];
    const double stress = principal_values(drawn.force)[0] / facet.section.thickness;
    if (stress > facet.section.strength)
      refuse("the sheet at ", place(node), " would tear: its stress is ", stress,
             " Pa, its strength ", facet.section.strength, " Pa");
    const auto stretched = stretched_facet(facet, drawn.force);
    if (!stretched) refuse_strain(node);
    for (const double stretch : stretched->stretches) take(stretch, node);
    facet = stretched->facet;
  }

  void set(const DrawnBar& drawn, BeamBond& bond) {
    const double stiffness = bond.section.young_modulus * bond.section.area;
    set_stretch(1.0 + drawn.force / stiffness, bond);
  }

  /// @param rounding  N, below which a wire may seem to push
  void set(const DrawnBar& drawn, const WireCurve& curve, double rounding, BeamBond& bond) {
    if (drawn.force < -rounding)
      refuse("the wire at ", place(bond.nodes[0]), " would have to push with ", -drawn.force,
             " N, but wires only pull");
    const std::optional<double> strain = curve.strain_at(std::max(0.0, drawn.force));
    if (!strain)
      refuse("the wire at ", place(bond.nodes[0]), " would break: it carries ", drawn.force, " N");
    set_stretch(1.0 + *strain, bond);
  }

  void require_strong(const DrawnBar& drawn, const BondStrength& strength) const {
    const double stress = drawn.force / drawn.bond->section.area;
    if (std::abs(stress) <= strength.yield_stress && stress <= strength.strength) return;
    refuse("the bar or beam at ", place(drawn.bond->nodes[0]), " would ",
           stress > strength.strength ? "break" : "yield", ": its stress is ", stress,
           " Pa, its yield stress ", strength.yield_stress, " Pa, its strength ", strength.strength,
           " Pa");
  }

 private:
  void set_stretch(double stretch, BeamBond& bond) {
    take(stretch, bond.nodes[0]);
    bond.length /= stretch;
  }

  [[noreturn]] void refuse_strain(NodeId node) const {
    refuse("at ", place(node),
           " it would be strained by more than 50 %; lower the pressure, make it stiffer, or draw "
           "it with more curvature there");
  }

  void take(double stretch, NodeId node) {
    if (!(stretch >= kSmallestStretch && stretch <= kLargestStretch)) refuse_strain(node);
    if (std::abs(stretch - 1.0) > std::abs(largest_stretch_ - 1.0)) largest_stretch_ = stretch;
  }

  std::string place(NodeId node) const { return node_at(node, x_); }

  Positions x_;
  double largest_stretch_ = 1.0;
};

/// @throws std::invalid_argument where no shape of this could stand
void require_pressable(const PressedPart& part, const Scene& scene) {
  const std::span<const geometry::Facet> facets =
      std::span(scene.elements.facets).subspan(part.first_facet);
  if (facets.empty()) refuse("it has no facets for a pressure to act on");
  if (const auto two = opposite_neighbours(facets))
    refuse(
        "facets ", (*two)[0], " and ", (*two)[1],
        " are neighbours but face opposite ways, and pressure acts along their normals; swap two "
        "corners of one of them");
  if (are_closed(facets)) return;
  const auto is_held = [&](NodeId node) {
    return !free_axes(scene.properties.held[index_of(node)]).isOnes(0.0);
  };
  for (const geometry::Facet& facet : facets)
    if (std::any_of(facet.nodes.begin(), facet.nodes.end(), is_held)) return;
  refuse(
      "its surface is open and none of its nodes is held, so the pressure pushes it away; close "
      "it, or hold it");
}

void require_balanced(const std::pair<double, NodeId>& worst, Positions x) {
  if (worst.first <= kLargestImbalance) return;
  refuse(
      "it cannot stand under this pressure as it is drawn: ", 100.0 * worst.first,
      " % of the force on ", node_at(worst.second, x),
      " is left over, where it is flat, or free at a rim; draw it curved there, hold it, or leave "
      "this out and let a stage with damping settle it");
}

/// The law of each bond, by its place from the first one on; null where it has none.
std::vector<const BondLaw*> laws_of(const PressedPart& part, const Scene& scene) {
  std::vector<const BondLaw*> laws(scene.bonds.size() - part.first_bond, nullptr);
  for (const BondLaw& law : scene.bond_laws)
    for (const std::size_t bond : law.bonds)
      if (bond >= part.first_bond) laws[bond - part.first_bond] = &law;
  return laws;
}

double largest_force(const std::vector<DrawnBar>& bars) {
  double largest = 0.0;
  for (const DrawnBar& bar : bars) largest = std::max(largest, std::abs(bar.force));
  return largest;
}

/// Share of the area or length that is pushed by more than what rounding leaves.
double compressed_part(const DrawnStructure& drawn) {
  double all = 0.0, compressed = 0.0, largest = largest_force(drawn.bars());
  for (const DrawnSheet& sheet : drawn.sheets())
    largest = std::max(largest, sheet.force.lpNorm<Eigen::Infinity>());
  const auto count = [&](double size, double force) {
    all += size;
    if (force < -kLargestImbalance * largest) compressed += size;
  };
  for (const DrawnSheet& sheet : drawn.sheets())
    count(sheet.shape.area, principal_values(sheet.force)[1]);
  if (drawn.sheets().empty())
    for (const DrawnBar& bar : drawn.bars()) count(bar.bond->length, bar.force);
  return all > 0.0 ? compressed / all : 0.0;
}

}  // namespace

PressedRest rest_under_pressure(double pressure, const PressedPart& part, Scene& scene) {
  require_pressable(part, scene);
  DrawnStructure drawn(pressure, part, scene);
  const auto worst = drawn.balance();
  require_balanced(worst, scene.state.position);

  const auto first_sheet = static_cast<std::ptrdiff_t>(part.first_sheet);
  const auto first_bond = static_cast<std::ptrdiff_t>(part.first_bond);
  std::vector<SheetFacet> sheets(scene.sheet_facets.begin() + first_sheet,
                                 scene.sheet_facets.end());
  std::vector<BeamBond> bonds(scene.bonds.begin() + first_bond, scene.bonds.end());
  RestSizes sizes(scene.state.position);
  for (std::size_t i = 0; i < sheets.size(); ++i) sizes.set(drawn.sheets()[i], sheets[i]);
  const std::vector<const BondLaw*> laws = laws_of(part, scene);
  const double rounding = kLargestImbalance * largest_force(drawn.bars());
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    const DrawnBar& bar = drawn.bars()[i];
    const auto* const curve = laws[i] ? std::get_if<WireCurve>(&laws[i]->law) : nullptr;
    if (curve)
      sizes.set(bar, *curve, rounding, bonds[i]);
    else
      sizes.set(bar, bonds[i]);
    if (laws[i] && !curve) sizes.require_strong(bar, std::get<BondStrength>(laws[i]->law));
  }
  const PressedRest rest{worst.first, sizes.largest_stretch(), compressed_part(drawn)};
  std::copy(sheets.begin(), sheets.end(), scene.sheet_facets.begin() + first_sheet);
  std::copy(bonds.begin(), bonds.end(), scene.bonds.begin() + first_bond);
  return rest;
}

}  // namespace plekton::dynamics
