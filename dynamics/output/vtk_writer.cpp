// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/vtk_writer.hpp"

#include "dynamics/output/file.hpp"
#include "dynamics/output/text.hpp"
#include "dynamics/output/vtk_blocks.hpp"

#include <bit>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace plekton::dynamics {
namespace {

static_assert(sizeof(geometry::Vec3) == 3 * sizeof(double),
              "points are written as they lie in memory");

template <class T>
constexpr std::string_view vtk_type() noexcept {
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
}

constexpr std::string_view kEnd = "\n  </AppendedData>\n</VTKFile>\n";

/// @throws std::invalid_argument for an array of another length
void require_length(const DataArray& array, std::size_t got, std::size_t count) {
  if (got == array.components * count) return;
  throw std::invalid_argument("array \"" + array.name + "\": " + std::to_string(got) +
                              " numbers; expected " + std::to_string(array.components) +
                              " for each of " + std::to_string(count) + " points or cells");
}

/// The two parts of a file, growing side by side: an array adds its description to one and its
/// bytes to the other.
struct Document {
  std::string xml;
  std::string appended;
  std::size_t unpacked = 0;  // bytes of all arrays

  template <class T>
  void add_array(std::string_view name, std::size_t components, std::span<const T> values) {
    xml.append("        <DataArray type=\"").append(vtk_type<T>());
    xml.append("\" Name=\"").append(xml_escaped(name));
    xml.append("\" NumberOfComponents=\"").append(std::to_string(components));
    xml.append("\" format=\"appended\" offset=\"")
        .append(std::to_string(appended.size()))
        .append("\"/>\n");
    appended += compressed_blocks(std::as_bytes(values));
    unpacked += values.size_bytes();
  }

  void add_arrays(std::string_view section, const std::vector<DataArray>& arrays,
                  std::size_t count) {
    xml.append("      <").append(section).append(">\n");
    for (const DataArray& array : arrays) {
      std::visit(
          [&](const auto& values) {
            require_length(array, values.size(), count);
            add_array(array.name, array.components, std::span(values));
          },
          array.values);
    }
    xml.append("      </").append(section).append(">\n");
  }

  void add_cells(std::string_view section, const CellList& cells) {
    xml.append("      <").append(section).append(">\n");
    add_array("connectivity", 1, std::span(cells.connectivity));
    add_array("offsets", 1, std::span(cells.offsets));
    xml.append("      </").append(section).append(">\n");
  }

  void add_points(const std::vector<geometry::Vec3>& points) {
    xml.append("      <Points>\n");
    const double* first = points.empty() ? nullptr : points.front().data();
    add_array("Points", 3, std::span(first, 3 * points.size()));
    xml.append("      </Points>\n");
  }
};

std::string piece_tag(const PolyData& data) {
  std::string tag = "    <Piece NumberOfPoints=\"" + std::to_string(data.points.size());
  tag += "\" NumberOfVerts=\"" + std::to_string(data.vertices.size());
  tag += "\" NumberOfLines=\"" + std::to_string(data.lines.size());
  tag += "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(data.polygons.size());
  return tag += "\">\n";
}

/// ParaView shows the field "TimeValue" as the time of a file that is opened without its
/// collection.
std::string time_field(double time) {
  std::string field =
      "    <FieldData>\n"
      "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">";
  append_number(field, time);
  return field += "</DataArray>\n    </FieldData>\n";
}

Document document(const PolyData& data) {
  constexpr bool kLittleEndian = std::endian::native == std::endian::little;
  Document document;
  document.xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"";
  document.xml += kLittleEndian ? "LittleEndian" : "BigEndian";
  document.xml += "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <PolyData>\n";
  document.xml += time_field(data.time);
  document.xml += piece_tag(data);
  document.add_arrays("PointData", data.point_arrays, data.points.size());
  document.add_arrays("CellData", data.cell_arrays, data.cell_count());
  document.add_points(data.points);
  document.add_cells("Verts", data.vertices);
  document.add_cells("Lines", data.lines);
  document.add_cells("Polys", data.polygons);
  document.xml += "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n   _";
  return document;
}

}  // namespace

void CellList::add(std::initializer_list<std::int32_t> cell) {
  connectivity.insert(connectivity.end(), cell);
  offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
}

void write_vtp(const std::filesystem::path& file, const PolyData& data) {
  const Document content = document(data);
  OutputFile out(file);
  out.write(content.xml);
  out.write(content.appended);
  out.write(kEnd);
  out.commit();
}

VtpSize vtp_size(const PolyData& data) {
  const Document content = document(data);
  const std::size_t described = content.xml.size() + kEnd.size();
  return {described + content.appended.size(), described + content.unpacked};
}

}  // namespace plekton::dynamics
