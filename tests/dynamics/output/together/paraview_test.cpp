// SPDX-License-Identifier: GPL-3.0-or-later
// What ParaView itself says about our files. It starts slowly, so one start opens them all.
#include "dynamics/output/pvd_series.hpp"
#include "dynamics/output/scene_frame.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace plekton::dynamics::paraview_test {
namespace {

using geometry::NodeId;
using geometry::Vec3;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

/// What a shell command prints, errors too.
std::string output_of(const std::string& command) {
  std::string output;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return "cannot run " + command;
  std::array<char, 4096> buffer;
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), size);
  ::pclose(pipe);
  return output;
}

void write_grains(const TemporaryFolder& folder, double time, const std::string& name) {
  const std::array<Vec3, 2> x = {Vec3(0, 0, time), Vec3(1, 0, time)};
  const std::array<geometry::Sphere, 2> spheres = {geometry::Sphere{{NodeId{0}}, 0.5},
                                                   geometry::Sphere{{NodeId{1}}, 0.25}};
  const std::array<std::int64_t, 2> ids = {10, 20};
  write_vtp(folder / name, grains_frame({{x, x, x, x}, spheres, ids}, time));
}

void write_surface(const TemporaryFolder& folder, double time, const std::string& name) {
  const std::array<Vec3, 4> x = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const std::array<geometry::Cylinder, 2> cylinders = {
      geometry::Cylinder{{NodeId{0}, NodeId{1}}, 0.5},
      geometry::Cylinder{{NodeId{0}, NodeId{3}}, 0.5}};
  const std::array<double, 2> tension = {3.0, 4.0};
  const std::array<geometry::Facet, 1> facets = {
      geometry::Facet{{NodeId{0}, NodeId{1}, NodeId{2}}, 0.5}};
  write_vtp(folder / name, surface_frame({{x, x, x, x}, cylinders, tension, facets}, time));
}

void write_contacts(const TemporaryFolder& folder, double time, const std::string& name) {
  contact::ContactRecord contact;
  contact.id = 7;
  contact.a = {contact::BodyKind::sphere, 3, geometry::Feature(NodeId{5})};
  contact.b = {contact::BodyKind::plane, 2, {}};
  contact.point_a = Vec3(0, 0, 0);
  contact.point_b = Vec3(0, 0, 1);
  contact.point = Vec3(0, 0, 0.5);
  contact.normal = Vec3(0, 0, 1);
  contact.normal_force = Vec3(0, 0, 5);
  contact.tangential_force = Vec3(3, 4, 0);
  contact.moment = Vec3(2, 0, 0);
  contact.gap = -0.5;
  contact.is_slipping = true;
  write_vtp(folder / name, contacts_frame(std::span(&contact, 1), time));
}

/// More than one block in each array.
void write_many_points(const TemporaryFolder& folder, const std::string& name) {
  constexpr std::int32_t kCount = 100'000;
  PolyData data;
  std::vector<std::int32_t> numbers;
  for (std::int32_t i = 0; i < kCount; ++i) {
    data.points.emplace_back(i, 0.0, 0.0);
    data.vertices.add({i});
    numbers.push_back(i % 2);
  }
  data.point_arrays = {{"odd", 1, numbers}};
  write_vtp(folder / name, data);
}

/// Cells: vertices + lines + polygons. Arrays, of points and of cells: name:components:sum of the
/// values.
constexpr const char* kExpected =
    R"(Körner <1> & "2".vtp: time 0.25 points 2 in 0..1 0..0 0.25..0.25 cells 2+0+0 [radius:1:0.75,velocity:3:1.5,angular_velocity:3:1.5,force:3:1.5,id:1:30] []
contacts.vtp: time 0.25 points 2 in 0..0 0..0 0..1 cells 0+1+0 [] [id:1:7,kind_a:1:0,body_a:1:3,feature_a:1:5,kind_b:1:4,body_b:1:2,feature_b:1:-1,point:3:0.5,normal:3:1,gap:1:-0.5,normal_force:3:5,normal_force_magnitude:1:5,tangential_force:3:7,tangential_force_magnitude:1:5,moment:3:2,is_bonded:1:0,is_slipping:1:1]
many.vtp: time 0 points 100000 in 0..99999 0..0 0..0 cells 100000+0+0 [odd:1:50000] []
no_contacts.vtp: time 0.5 points 0 in nothing cells 0+0+0 [] [id:1:0,kind_a:1:0,body_a:1:0,feature_a:1:0,kind_b:1:0,body_b:1:0,feature_b:1:0,point:3:0,normal:3:0,gap:1:0,normal_force:3:0,normal_force_magnitude:1:0,tangential_force:3:0,tangential_force_magnitude:1:0,moment:3:0,is_bonded:1:0,is_slipping:1:0,group_a:1:0,material_a:1:0,group_b:1:0,material_b:1:0]
no_grains.vtp: time 0.5 points 0 in nothing cells 0+0+0 [radius:1:0,velocity:3:0,angular_velocity:3:0,force:3:0,id:1:0] []
no_surface.vtp: time 0.5 points 0 in nothing cells 0+0+0 [velocity:3:0,angular_velocity:3:0,force:3:0,node:1:0] [radius:1:0,tension:1:0]
surface.vtp: time 0.25 points 4 in 0..1 0..1 0..1 cells 0+2+1 [velocity:3:3,angular_velocity:3:3,force:3:3,node:1:6] [radius:1:1.5,tension:1:10]
séries & <all>.pvd: 0.25 s: 3 parts, 8 points; 0.5 s: 3 parts, 4 points
)";

TEST(ParaView, OpensEveryKindOfFile) {
  if (std::system("command -v pvpython > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "pvpython is not installed (package paraview), so ParaView was not asked about "
                    "our files";
  }
  const TemporaryFolder folder;
  const std::string special = "Körner <1> & \"2\".vtp";
  write_grains(folder, 0.25, special);
  write_surface(folder, 0.25, "surface.vtp");
  write_contacts(folder, 0.25, "contacts.vtp");
  write_many_points(folder, "many.vtp");
  write_vtp(folder / "no_grains.vtp", grains_frame({}, 0.5));
  write_vtp(folder / "no_surface.vtp", surface_frame({}, 0.5));
  write_vtp(folder / "no_contacts.vtp", contacts_frame({}, 0.5));
  PvdSeries series(folder / "séries & <all>.pvd");
  series.add({{0.25, "grains & \"co\"", folder / special},
              {0.25, "surface", folder / "surface.vtp"},
              {0.25, "contacts", folder / "contacts.vtp"}});
  series.add({{0.5, "grains & \"co\"", folder / "no_grains.vtp"},
              {0.5, "surface", folder / "surface.vtp"},
              {0.5, "contacts", folder / "no_contacts.vtp"}});

  const std::string seen = output_of("pvpython --force-offscreen-rendering " PLEKTON_SOURCE_DIR
                                     "/tests/support/open_in_paraview.py " +
                                     folder.path().string());

  EXPECT_THAT(seen, HasSubstr(kExpected));
  EXPECT_THAT(seen, Not(HasSubstr("ERR|")));  // how VTK marks its complaints
}

}  // namespace
}  // namespace plekton::dynamics::paraview_test
