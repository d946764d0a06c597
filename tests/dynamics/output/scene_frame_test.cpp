// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/scene_frame.hpp"

#include "dynamics/output/contact_fields.hpp"
#include "dynamics/output/frame_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>

namespace plekton::dynamics::scene_frame_test {
namespace {

using geometry::Cylinder;
using geometry::Facet;
using geometry::NodeId;
using geometry::Sphere;
using geometry::Vec3;
using testing::ElementsAre;
using testing::IsEmpty;

/// Five nodes: position (i, 0, 0), velocity (0, i, 0), angular velocity (0, 0, i), force (-i, 0,
/// 0).
struct FiveNodes {
  std::array<Vec3, 5> position, velocity, angular_velocity, force;

  FiveNodes() {
    for (std::size_t i = 0; i < 5; ++i) {
      const auto x = static_cast<double>(i);
      position[i] = {x, 0.0, 0.0};
      velocity[i] = {0.0, x, 0.0};
      angular_velocity[i] = {0.0, 0.0, x};
      force[i] = {-x, 0.0, 0.0};
    }
  }
  NodesView view() const { return {position, velocity, angular_velocity, force}; }
};

NodeId node(int index) {
  return static_cast<NodeId>(index);
}

const DataArray& array(const std::vector<DataArray>& arrays, const std::string& name) {
  for (const DataArray& array : arrays) {
    if (array.name == name) return array;
  }
  throw std::runtime_error("no array " + name);
}

std::vector<float> floats(const std::vector<DataArray>& arrays, const std::string& name) {
  return std::get<std::vector<float>>(array(arrays, name).values);
}

TEST(GrainsFrame, ShowsEachSphereWithTheStateOfItsNode) {
  const FiveNodes nodes;
  const std::array<Sphere, 2> spheres = {Sphere{{node(3)}, 0.5}, Sphere{{node(1)}, 0.25}};
  const std::array<std::int64_t, 2> ids = {7'000'000'000, 8};

  const PolyData data = grains_frame({nodes.view(), spheres, ids}, 0.5);

  EXPECT_EQ(data.time, 0.5);
  EXPECT_THAT(data.points, ElementsAre(Vec3(3.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0)));
  EXPECT_THAT(data.vertices.connectivity, ElementsAre(0, 1));
  EXPECT_THAT(data.vertices.offsets, ElementsAre(1, 2));
  EXPECT_THAT(floats(data.point_arrays, "radius"), ElementsAre(0.5F, 0.25F));
  EXPECT_THAT(floats(data.point_arrays, "velocity"), ElementsAre(0, 3, 0, 0, 1, 0));
  EXPECT_THAT(floats(data.point_arrays, "angular_velocity"), ElementsAre(0, 0, 3, 0, 0, 1));
  EXPECT_THAT(floats(data.point_arrays, "force"), ElementsAre(-3, 0, 0, -1, 0, 0));
  EXPECT_EQ(array(data.point_arrays, "velocity").components, 3U);
  EXPECT_THAT(std::get<std::vector<std::int64_t>>(array(data.point_arrays, "id").values),
              ElementsAre(7'000'000'000, 8));
}

// Nodes 1 to 4 carry a facet (4, 1, 2) with cylinders along two of its sides, one of them named
// from the other end, and a free cylinder (2, 3); node 0 is a grain's.
TEST(SurfaceFrame, SharesPointsBetweenCylindersAndFacets) {
  const FiveNodes nodes;
  const std::array<Cylinder, 3> cylinders = {Cylinder{{node(2), node(3)}, 0.1},
                                             Cylinder{{node(1), node(4)}, 0.2},
                                             Cylinder{{node(1), node(2)}, 0.2}};
  const std::array<double, 3> tension = {-1.0, 2.0, 4.0};
  const std::array<Facet, 1> facets = {Facet{{node(4), node(1), node(2)}, 0.2}};

  const PolyData data = surface_frame({nodes.view(), cylinders, tension, facets}, 2.0);

  EXPECT_EQ(data.time, 2.0);
  EXPECT_THAT(data.points, ElementsAre(nodes.position[1], nodes.position[2], nodes.position[3],
                                       nodes.position[4]));
  EXPECT_THAT(data.lines.connectivity, ElementsAre(1, 2, 0, 3, 0, 1));
  EXPECT_THAT(data.lines.offsets, ElementsAre(2, 4, 6));
  EXPECT_THAT(data.polygons.connectivity, ElementsAre(3, 0, 1));
  EXPECT_THAT(data.polygons.offsets, ElementsAre(3));
  EXPECT_THAT(std::get<std::vector<std::int32_t>>(array(data.point_arrays, "node").values),
              ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(floats(data.point_arrays, "force"),
              ElementsAre(-1, 0, 0, -2, 0, 0, -3, 0, 0, -4, 0, 0));
  EXPECT_THAT(floats(data.cell_arrays, "radius"), ElementsAre(0.1F, 0.2F, 0.2F, 0.2F));
  EXPECT_THAT(floats(data.cell_arrays, "tension"), ElementsAre(-1, 2, 4, 3));
}

TEST(SurfaceFrame, ShowsNoTensionInAFacetWithoutCylinders) {
  const FiveNodes nodes;
  const std::array<Facet, 1> facets = {Facet{{node(0), node(1), node(2)}, 0.2}};

  const PolyData data = surface_frame({nodes.view(), {}, {}, facets}, 0.0);

  EXPECT_THAT(floats(data.cell_arrays, "tension"), ElementsAre(0));
}

TEST(SurfaceFrame, ShowsTheMembraneForcesOfFacets) {
  const FiveNodes nodes;
  const std::array<Facet, 1> facets = {Facet{{node(0), node(1), node(2)}, 0.2}};
  const std::array<Cylinder, 1> cylinders = {Cylinder{{node(0), node(1)}, 0.2}};
  const std::array<double, 1> tension = {1.0};
  const std::array<PrincipalForces, 1> forces = {PrincipalForces{3.0, -2.0}};

  const PolyData data = surface_frame({nodes.view(), cylinders, tension, facets, forces}, 0.0);

  EXPECT_THAT(floats(data.cell_arrays, "membrane_force_largest"), ElementsAre(0, 3));
  EXPECT_THAT(floats(data.cell_arrays, "membrane_force_smallest"), ElementsAre(0, -2));
}

TEST(SurfaceFrame, ShowsStressesOfCylindersAndTractionsOnFacets) {
  const FiveNodes nodes;
  const std::array<Facet, 1> facets = {Facet{{node(0), node(1), node(2)}, 0.2}};
  const std::array<Cylinder, 1> cylinders = {Cylinder{{node(0), node(1)}, 0.2}};
  const std::array<double, 1> tension = {1.0};
  const std::array<BondStress, 1> stresses = {BondStress{-1.0, 2.0, 3.0}};
  const std::array<FacetTraction, 1> tractions = {FacetTraction{4.0, Vec3(5.0, 6.0, 7.0)}};

  const PolyData data =
      surface_frame({nodes.view(), cylinders, tension, facets, {}, stresses, tractions}, 0.0);

  EXPECT_THAT(floats(data.cell_arrays, "axial_stress"), ElementsAre(-1, 0));
  EXPECT_THAT(floats(data.cell_arrays, "bending_stress"), ElementsAre(2, 0));
  EXPECT_THAT(floats(data.cell_arrays, "torsion_stress"), ElementsAre(3, 0));
  EXPECT_THAT(floats(data.cell_arrays, "contact_pressure"), ElementsAre(0, 4));
  EXPECT_THAT(floats(data.cell_arrays, "contact_shear"), ElementsAre(0, 0, 0, 5, 6, 7));
}

TEST(SceneFrames, TellGroupAndMaterialOfGrainsAndOfCellsByTheirFirstNode) {
  const FiveNodes nodes;
  const std::array<Facet, 1> facets = {Facet{{node(3), node(4), node(1)}, 0.2}};
  const std::array<Cylinder, 1> cylinders = {Cylinder{{node(0), node(1)}, 0.2}};
  const std::array<double, 1> tension{};
  const std::array<Sphere, 1> spheres = {Sphere{{node(2)}, 0.5}};
  const std::array<std::int64_t, 1> id = {7};
  const std::array<std::int32_t, 5> groups = {4, 4, 1, 6, 6};
  const std::array<std::int32_t, 5> materials = {0, 0, 2, 3, 3};
  NodesView view = nodes.view();
  view.group = groups;
  view.material = materials;

  const PolyData surface = surface_frame({view, cylinders, tension, facets}, 0.0);
  const PolyData grains = grains_frame({view, spheres, id}, 0.0);

  const auto whole = [](const std::vector<DataArray>& arrays, const std::string& name) {
    return std::get<std::vector<std::int32_t>>(array(arrays, name).values);
  };
  EXPECT_THAT(whole(surface.cell_arrays, "membrane"), ElementsAre(4, 6));
  EXPECT_THAT(whole(surface.cell_arrays, "material"), ElementsAre(0, 3));
  EXPECT_THAT(whole(grains.point_arrays, "grains"), ElementsAre(1));
  EXPECT_THAT(whole(grains.point_arrays, "material"), ElementsAre(2));
}

contact::ContactRecord contact_of(const Vec3& point_a, const Vec3& point_b,
                                  const Vec3& normal_force, const Vec3& tangential_force,
                                  double gap) {
  contact::ContactRecord row;
  row.point_a = point_a;
  row.point_b = point_b;
  row.point = 0.5 * (point_a + point_b);
  row.normal = (point_b - point_a).normalized();
  row.normal_force = normal_force;
  row.tangential_force = tangential_force;
  row.gap = gap;
  return row;
}

std::vector<std::string> names_of(const std::vector<DataArray>& arrays) {
  std::vector<std::string> names;
  for (const DataArray& array : arrays) names.push_back(array.name);
  return names;
}

template <class Fields>
std::vector<std::string> names_of_fields(const Fields& fields) {
  std::vector<std::string> names;
  for (const OutputField& field : fields) names.emplace_back(field.name);
  return names;
}

// What `plekton list` prints.
TEST(SceneFrames, HaveTheArraysOfTheTablesInTheirOrder) {
  const FiveNodes nodes;
  const std::array<Facet, 1> facets = {Facet{{node(0), node(1), node(2)}, 0.2}};
  const std::array<PrincipalForces, 1> forces{};
  const std::array<FacetTraction, 1> tractions{};
  const std::array<Cylinder, 1> cylinders = {Cylinder{{node(0), node(1)}, 0.2}};
  const std::array<double, 1> tension{};
  const std::array<BondStress, 1> stresses{};
  const std::array<std::int32_t, 5> labels{};
  NodesView with_labels = nodes.view();
  with_labels.group = with_labels.material = labels;

  const PolyData surface =
      surface_frame({with_labels, cylinders, tension, facets, forces, stresses, tractions}, 0.0);

  EXPECT_EQ(names_of(grains_frame({with_labels, {}, {}}, 0.0).point_arrays),
            names_of_fields(frame_fields::kOfGrains));
  EXPECT_EQ(names_of(surface.point_arrays), names_of_fields(frame_fields::kOfNodes));
  EXPECT_EQ(names_of(surface.cell_arrays), names_of_fields(frame_fields::kOfCells));
  EXPECT_EQ(names_of(contacts_frame({}, 0.0).cell_arrays), names_of_fields(contact_fields()));
}

TEST(ContactsFrame, DrawsEachContactBetweenItsCorePoints) {
  std::array<contact::ContactRecord, 2> contacts = {
      contact_of(Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 5), Vec3(3, 4, 0), -0.125),
      contact_of(Vec3(1, 0, 0), Vec3(1, 0, 2), Vec3(0, 0, 2), Vec3(0, 0, 0), -0.25)};
  contacts[1].id = 7'000'000'000;
  contacts[1].b = {contact::BodyKind::structure, 3, geometry::Feature(geometry::EdgeId{9})};

  const PolyData data = contacts_frame(contacts, 1.0);

  EXPECT_THAT(data.points, ElementsAre(Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 0, 2)));
  EXPECT_THAT(data.lines.connectivity, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(data.lines.offsets, ElementsAre(2, 4));
  EXPECT_THAT(floats(data.cell_arrays, "normal_force"), ElementsAre(0, 0, 5, 0, 0, 2));
  EXPECT_THAT(floats(data.cell_arrays, "normal_force_magnitude"), ElementsAre(5, 2));
  EXPECT_THAT(floats(data.cell_arrays, "tangential_force"), ElementsAre(3, 4, 0, 0, 0, 0));
  EXPECT_THAT(floats(data.cell_arrays, "tangential_force_magnitude"), ElementsAre(5, 0));
  EXPECT_THAT(floats(data.cell_arrays, "gap"), ElementsAre(-0.125F, -0.25F));
  EXPECT_THAT(floats(data.cell_arrays, "point"), ElementsAre(0, 0, 0.5F, 1, 0, 1));
  EXPECT_THAT(floats(data.cell_arrays, "normal"), ElementsAre(0, 0, 1, 0, 0, 1));
  const auto whole = [&](const std::string& name) {
    return std::get<std::vector<std::int64_t>>(array(data.cell_arrays, name).values);
  };
  EXPECT_THAT(whole("id"), ElementsAre(0, 7'000'000'000));
  EXPECT_THAT(whole("kind_b"), ElementsAre(0, 2));
  EXPECT_THAT(whole("body_b"), ElementsAre(-1, 3));
  EXPECT_THAT(whole("feature_b"), ElementsAre(-1, 9));
}

TEST(ContactList, HasAColumnForEachNumberOfARow) {
  std::vector<double> row{1.0, 2.0, 3.0};

  fill_contact_row(0.5,
                   contact_of(Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 5), Vec3(3, 4, 0), -0.125),
                   {.group_a = 2, .group_b = 0, .material_a = 1, .material_b = 5}, row);

  const std::vector<CsvColumn> columns = contact_columns();
  ASSERT_EQ(row.size(), columns.size());
  const auto value = [&](const std::string& name) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].name == name) return row[i];
    throw std::runtime_error("no column " + name);
  };
  EXPECT_EQ(value("time"), 0.5);
  EXPECT_EQ(value("normal_force_z"), 5.0);
  EXPECT_EQ(value("tangential_force_magnitude"), 5.0);
  EXPECT_EQ(value("gap"), -0.125);
  EXPECT_EQ(value("group_a"), 2.0);
  EXPECT_EQ(value("material_a"), 1.0);
  EXPECT_EQ(value("group_b"), 0.0);
  EXPECT_EQ(value("material_b"), 5.0);
}

TEST(SceneFrames, KeepTheirArraysWhenThereIsNothingToShow) {
  const PolyData grains = grains_frame({}, 0.0);
  const PolyData surface = surface_frame({}, 0.0);
  const PolyData contacts = contacts_frame({}, 0.0);

  for (const PolyData* data : {&grains, &surface, &contacts}) {
    EXPECT_THAT(data->points, IsEmpty());
    EXPECT_EQ(data->cell_count(), 0U);
  }
  EXPECT_EQ(grains.point_arrays.size(), 5U);
  EXPECT_EQ(surface.cell_arrays.size(), 2U);
  EXPECT_EQ(contacts.cell_arrays.size(), contact_fields().size());
}

TEST(SceneFrames, RefuseResultsThatAreNotOneForEachBody) {
  const FiveNodes nodes;
  const std::array<Facet, 1> facets = {Facet{{node(0), node(1), node(2)}, 0.2}};
  const std::array<Cylinder, 1> cylinders = {Cylinder{{node(0), node(1)}, 0.2}};
  const std::array<Sphere, 1> spheres = {Sphere{{node(2)}, 0.5}};
  const std::array<double, 1> tension{};
  const std::array<PrincipalForces, 2> forces{};
  NodesView short_view = nodes.view();
  short_view.velocity = short_view.velocity.first(4);
  const auto is_refused = [](const char* why) {
    return testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr(why));
  };

  EXPECT_THAT(
      [&] {
        surface_frame({nodes.view(), cylinders, {}, facets}, 0.0);
      },
      is_refused("0 tensions for 1 cylinders"));
  EXPECT_THAT(
      [&] {
        surface_frame({nodes.view(), cylinders, tension, facets, forces}, 0.0);
      },
      is_refused("2 membrane forces for 1 facets"));
  EXPECT_THAT(
      [&] {
        grains_frame({nodes.view(), spheres, {}}, 0.0);
      },
      is_refused("0 ids for 1 spheres"));
  EXPECT_THAT(
      [&] {
        surface_frame({short_view, cylinders, tension, facets}, 0.0);
      },
      is_refused("4 velocity for 5 nodes"));
}

}  // namespace
}  // namespace plekton::dynamics::scene_frame_test
