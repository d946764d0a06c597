// SPDX-License-Identifier: GPL-3.0-or-later
// Writes what the generators make to a folder, as Wavefront OBJ: facets of meshes, lines of nets.
#include <plekton/geometry/mesh/generate/generators.hpp>
#include <plekton/geometry/mesh/generate/lattice.hpp>
#include <plekton/geometry/mesh/io/mesh_file.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>

using namespace plekton::geometry;

namespace {

void write_lines(const std::filesystem::path& path, const Lattice& lattice) {
  std::ofstream out(path);
  for (const Vec3& x : lattice.points) out << "v " << x.transpose() << '\n';
  for (const LatticeEdge& edge : lattice.edges)
    out << "l " << index_of(edge.nodes[0]) + 1 << ' ' << index_of(edge.nodes[1]) + 1 << '\n';
  if (!out.flush()) throw MeshError(path.string() + ": cannot be written; check the folder");
}

void write_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const Mesh& mesh) {
    write_mesh_file(folder / (std::string(name) + ".obj"), mesh, MeshFormat::obj);
    std::cout << name << ": " << mesh.points.size() << " nodes, " << mesh.facets.size()
              << " facets\n";
  };
  const auto write_net = [&](const char* name, const Lattice& lattice) {
    write_lines(folder / (std::string(name) + ".obj"), lattice);
    std::cout << name << ": " << lattice.points.size() << " nodes, " << lattice.edges.size()
              << " bars\n";
  };
  write("sheet_diagonal", plane_sheet({1.0, 1.0, 8, 8, SheetPattern::diagonal}));
  write("sheet_alternating", plane_sheet({1.0, 1.0, 8, 8, SheetPattern::alternating}));
  write("sheet_cross", plane_sheet({1.0, 1.0, 8, 8, SheetPattern::cross}));
  write("tube", tube({0.35, 1.0, 20, 9}));
  write("sphere", icosphere(0.5, 3));
  write("box", box_shell({1.0, 0.7, 0.5}, {8, 6, 4}));
  write_net("biaxial_geogrid", biaxial_geogrid({0.04, 0.04, 9, 9, 2}));
  write_net("uniaxial_geogrid", uniaxial_geogrid({0.025, 0.22, 15, 2, 4}));
  write_net("hexagonal_net", hexagonal_net({0.08, 0.04, 0.04, 7, 8}));
  write_net("ring_net", ring_net({0.3, 4, 3, 4}));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    write_all(argc > 1 ? argv[1] : "out/generators");
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
