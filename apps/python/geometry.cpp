// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/arrays.hpp"
#include "apps/python/interpreter_lock.hpp"
#include "geometry/base/largest_coordinate.hpp"
#include "geometry/queries.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <optional>

namespace plekton::python {
namespace {

using geometry::CellId;
using geometry::NodeId;
using geometry::Probe;
using geometry::Proximity;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What is nearest to something asked. Without any: cell -1, infinitely far.
struct NearestRow {
  std::int32_t cell = -1;
  double gap = kInfinity;
  std::array<double, 3> normal{};
  std::array<double, 3> point{};
  std::uint8_t feature_kind = 0;
  std::int32_t feature = -1;
};

struct HitRow {
  std::int32_t cell = -1;
  double t = kInfinity;
  std::array<double, 3> point{};
  std::array<double, 3> normal{};
};

struct PairRow {
  std::uint8_t kind_a;
  std::int32_t a;
  std::uint8_t kind_b;
  std::int32_t b;
  double gap;
  std::array<double, 3> normal;
  std::array<double, 3> point_a;
  std::array<double, 3> point_b;
};

// What is handed in.

/// Elements by rows of node numbers; of None none.
/// @throws std::invalid_argument for numbers that no node can have
template <class Element>
std::vector<Element> elements_of(const py::object& given, double radius, const char* name) {
  std::vector<Element> elements;
  if (given.is_none()) return elements;
  constexpr std::size_t kCorners = std::tuple_size_v<decltype(Element::nodes)>;
  const Whole rows = whole_numbers(given, name);
  require_rows(rows, static_cast<py::ssize_t>(kCorners), name);
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    Element element{{}, radius};
    for (std::size_t k = 0; k < kCorners; ++k) {
      const std::int64_t node = rows.at(i, static_cast<py::ssize_t>(k));
      if (node < 0 || node > std::numeric_limits<std::int32_t>::max())
        throw std::invalid_argument(fmt::format("{}[{}]: there is no node {}", name, i, node));
      element.nodes[k] = NodeId{static_cast<std::int32_t>(node)};
    }
    elements.push_back(element);
  }
  return elements;
}

std::vector<Probe> balls_of(const Numbers& centres, const Numbers& radius) {
  const auto points = vectors_of(centres, "points");
  const auto radii = numbers_of(radius, points.size(), "radius");
  std::vector<Probe> probes;
  for (std::size_t i = 0; i < points.size(); ++i)
    probes.push_back(Probe::ball(points[i], radii[i]));
  return probes;
}

/// Of numbers that a ray can have.
/// @throws std::invalid_argument naming the first that has others
std::vector<geometry::Ray> rays_of(const Numbers& origins, const Numbers& directions,
                                   const Numbers& t_end) {
  const auto from = vectors_of(origins, "origins");
  const auto along = vectors_of(directions, "directions");
  if (from.size() != along.size())
    throw std::invalid_argument(
        fmt::format("rays: got {} origins and {} directions", from.size(), along.size()));
  const auto ends = numbers_of(t_end, from.size(), "t_end");
  std::vector<geometry::Ray> rays;
  for (std::size_t i = 0; i < from.size(); ++i) {
    rays.push_back({from[i], along[i], ends[i]});
    if (geometry::can_hit(rays.back())) continue;
    if (!(from[i].allFinite() && from[i].cwiseAbs().maxCoeff() < geometry::kLargestCoordinate))
      throw std::invalid_argument(
          fmt::format("origins[{}]: got ({:g}, {:g}, {:g}) m; coordinates must be finite and below "
                      "1e75",
                      i, from[i][0], from[i][1], from[i][2]));
    if (!(ends[i] >= 0.0))
      throw std::invalid_argument(fmt::format(
          "t_end[{}]: got {:g}; it must be at least 0, in lengths of the direction", i, ends[i]));
    throw std::invalid_argument(
        fmt::format("directions[{}]: got ({:g}, {:g}, {:g}); the length must be from 1e-150 to "
                    "1e150",
                    i, along[i][0], along[i][1], along[i][2]));
  }
  return rays;
}

/// Counts those who read something without Python's lock. Begins and ends with the lock.
class Reading {
 public:
  explicit Reading(int& count) : count_(count) { ++count_; }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() { --count_; }

 private:
  int& count_;
};

/// Facets and bars over points, and what can be asked of them.
class PySurface {
 public:
  PySurface(const Numbers& points, const py::object& facets, const py::object& bars, double radius)
      : surface_(elements_of<geometry::Cylinder>(bars, radius, "bars"),
                 elements_of<geometry::Facet>(facets, radius, "facets"),
                 static_cast<std::size_t>(points.ndim() > 0 ? points.shape(0) : 0)),
        query_(surface_, vectors_of(points, "points")) {}
  PySurface(const PySurface&) = delete;
  PySurface& operator=(const PySurface&) = delete;

  void move(const Numbers& points) {
    if (readers_ > 0)
      throw std::logic_error(
          "another thread asks this surface; move it when that has its answer, or give each thread "
          "a surface of its own");
    query_.move(vectors_of(points, "points"));
  }
  std::size_t size() const noexcept { return surface_.cell_count(); }
  bool is_closed() const noexcept { return query_.is_closed(); }

  py::array nearest(const Numbers& points, const Numbers& radius, int threads) const {
    const auto probes = balls_of(points, radius);
    std::vector<NearestRow> rows;
    {
      const Reading reading(readers_);
      const WithoutLock free;
      geometry::ThreadPool pool(threads);
      for (const auto& found : query_.nearest(probes, pool))
        rows.push_back(found ? row_of(*found) : NearestRow{});
    }
    return array_of(rows);
  }

  py::array rays(const Numbers& origins, const Numbers& directions, const Numbers& t_end,
                 int threads) const {
    const auto rays = rays_of(origins, directions, t_end);
    std::vector<HitRow> rows;
    {
      const Reading reading(readers_);
      const WithoutLock free;
      geometry::ThreadPool pool(threads);
      for (const auto& hit : query_.first_hits(rays, pool))
        rows.push_back(hit ? HitRow{static_cast<std::int32_t>(hit->cell), hit->t, plain(hit->point),
                                    plain(hit->normal)}
                           : HitRow{});
    }
    return array_of(rows);
  }

  py::array_t<std::int8_t> side(const Numbers& points) const {
    std::vector<std::int8_t> sides;
    for (const Vec3& point : vectors_of(points, "points"))
      sides.push_back(static_cast<std::int8_t>(1 - static_cast<int>(query_.side_of(point))));
    return array_of(sides);
  }

  py::array_t<double> signed_distance(const Numbers& points) const {
    std::vector<double> distances;
    for (const Vec3& point : vectors_of(points, "points"))
      distances.push_back(query_.signed_distance(point).distance);
    return array_of(distances);
  }

  py::object nearest_surface(const PySurface& other) const {
    const auto found = query_.nearest(other.query_);
    if (!found) return py::none();
    const Proximity& proximity = found->proximity;
    return py::make_tuple(static_cast<std::int32_t>(found->a), static_cast<std::int32_t>(found->b),
                          proximity.gap, array_of(proximity.normal));
  }

 private:
  NearestRow row_of(const geometry::NearestCell& found) const {
    const Proximity& proximity = found.proximity;
    return {static_cast<std::int32_t>(found.cell),
            proximity.gap,
            plain(proximity.normal),
            plain(position(proximity.b, query_.positions())),
            static_cast<std::uint8_t>(proximity.b.feature.kind),
            proximity.b.feature.id};
  }

  geometry::Surface surface_;
  geometry::SurfaceQuery query_;
  mutable int readers_ = 0;  ///< other threads that are in nearest() or rays()
};

/// Kind and number of an element, as the rows of pairs have them: 0 a sphere, 1 a facet, 2 a bar.
std::pair<std::uint8_t, std::int32_t> name_of(const geometry::ElementId& element,
                                              const geometry::Surface& surface) {
  if (element.kind == geometry::ElementId::Kind::sphere) return {std::uint8_t{0}, element.id};
  const CellId cell{element.id};
  const bool is_facet = geometry::index_of(cell) < surface.face_count();
  return {static_cast<std::uint8_t>(is_facet ? 1 : 2),
          static_cast<std::int32_t>(surface.place_of(cell))};
}

template <class Element>
void require_points(const std::vector<Element>& elements, std::size_t count, const char* name) {
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const NodeId node : elements[i].nodes)
      if (geometry::index_of(node) >= count)
        throw std::invalid_argument(fmt::format("{}[{}]: there is no point {}; there are {}", name,
                                                i, geometry::index_of(node), count));
}

py::array pairs(double largest_gap, const std::optional<Numbers>& centres, const Numbers& radii,
                const std::optional<Numbers>& points, const py::object& facets,
                const py::object& bars, double radius, bool within_structures, int threads) {
  std::vector<Vec3> x;
  if (points) x = vectors_of(*points, "points");
  geometry::Elements elements;
  elements.facets = elements_of<geometry::Facet>(facets, radius, "facets");
  elements.cylinders = elements_of<geometry::Cylinder>(bars, radius, "bars");
  require_points(elements.facets, x.size(), "facets");
  require_points(elements.cylinders, x.size(), "bars");
  if (centres) {
    const auto places = vectors_of(*centres, "centres");
    const auto all = numbers_of(radii, places.size(), "radii");
    for (std::size_t i = 0; i < places.size(); ++i) {
      elements.spheres.push_back({{geometry::id_at<NodeId>(x.size())}, all[i]});
      x.push_back(places[i]);
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i].allFinite()) continue;
    const std::size_t first = points ? static_cast<std::size_t>(points->shape(0)) : 0;
    throw std::invalid_argument(
        i < first ? fmt::format("points[{}]: got no number; expected finite ones", i)
                  : fmt::format("centres[{}]: got no number; expected finite ones", i - first));
  }
  std::vector<PairRow> rows;
  {
    const WithoutLock free;
    geometry::ProximityQuery query(std::move(elements), x.size(),
                                   {largest_gap, true, within_structures}, threads);
    const auto found = query.find(x);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const geometry::ElementPair& pair = query.found_elements()[i];
      const auto [kind_a, a] = name_of(pair.a, query.surface());
      const auto [kind_b, b] = name_of(pair.b, query.surface());
      rows.push_back({kind_a, a, kind_b, b, found[i].gap, plain(found[i].normal),
                      plain(position(found[i].a, x)), plain(position(found[i].b, x))});
    }
  }
  return array_of(rows);
}

/// Corners of a moving primitive at one end of its way. @throws std::invalid_argument
geometry::Core core_of(const Numbers& corners, const char* name) {
  const auto points = vectors_of(corners, name);
  if (points.empty() || points.size() > 3)
    throw std::invalid_argument(
        fmt::format("{}: got {} corners; expected 1 of a ball, 2 of a bar or 3 of a facet", name,
                    points.size()));
  geometry::Core core{{points.back(), points.back(), points.back()}, points.size()};
  for (std::size_t i = 0; i < points.size(); ++i) core.x[i] = points[i];
  return core;
}

py::object first_contact(const Numbers& a_from, const Numbers& a_to, double radius_a,
                         const Numbers& b_from, const Numbers& b_to, double radius_b) {
  const auto found =
      geometry::first_contact({core_of(a_from, "a_from"), core_of(a_to, "a_to"), radius_a},
                              {core_of(b_from, "b_from"), core_of(b_to, "b_to"), radius_b});
  if (!found) return py::none();
  return py::make_tuple(found->t, found->proximity.gap, array_of(found->proximity.normal));
}

}  // namespace

void bind_geometry(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(NearestRow, cell, gap, normal, point, feature_kind, feature);
  PYBIND11_NUMPY_DTYPE(HitRow, cell, t, point, normal);
  PYBIND11_NUMPY_DTYPE(PairRow, kind_a, a, kind_b, b, gap, normal, point_a, point_b);
  py::class_<PySurface>(
      module, "Surface",
      "Thick facets and bars over shared points, and what is nearest to something, what a ray "
      "hits, what is inside. Cells are the facets, then the bars that are no sides of facets.")
      .def(py::init<const Numbers&, const py::object&, const py::object&, double>(),
           py::arg("points"), py::arg("facets") = py::none(), py::arg("bars") = py::none(),
           py::arg("radius") = 0.0,
           "points in m, (N, 3); facets (M, 3) and bars (K, 2) by the numbers of their points; "
           "radius in m, half "
           "the thickness of all.")
      .def("move", &PySurface::move, py::arg("points"), "Puts the points elsewhere (m).")
      .def("__len__", &PySurface::size)
      .def_property_readonly("is_closed", &PySurface::is_closed, "Whether it encloses something.")
      .def("nearest", &PySurface::nearest, py::arg("points"), py::arg("radius") = 0.0,
           py::arg("threads") = 1,
           "The nearest cell to each point, or to balls of a radius (m): cell, gap (m, negative: "
           "overlap), normal "
           "(towards the cell), point (m, of its core), feature_kind (0 node, 1 edge, 2 face) and "
           "feature.")
      .def("rays", &PySurface::rays, py::arg("origins"), py::arg("directions"),
           py::arg("t_end") = kInfinity, py::arg("threads") = 1,
           "Where each ray first enters: cell (-1: nowhere), t in lengths of its direction, point "
           "(m), normal (outward).")
      .def("side", &PySurface::side, py::arg("points"),
           "1 outside, 0 on, -1 inside of a closed surface without thickness; exact.")
      .def("signed_distance", &PySurface::signed_distance, py::arg("points"),
           "m, to a closed surface without thickness, negative inside.")
      .def("nearest_surface", &PySurface::nearest_surface, py::arg("other"),
           "The nearest cells of two surfaces: (own cell, other cell, gap in m, normal), or None.");
  module.def(
      "pairs", &pairs, py::arg("largest_gap"), py::kw_only(), py::arg("centres") = py::none(),
      py::arg("radii") = 0.0, py::arg("points") = py::none(), py::arg("facets") = py::none(),
      py::arg("bars") = py::none(), py::arg("radius") = 0.0, py::arg("within_structures") = false,
      py::arg("threads") = 1,
      "All pairs of spheres (centres, radii), facets and bars (of a radius, over points) that are "
      "nearer than a "
      "gap (m): kind_a, a, kind_b, b (0 sphere, 1 facet, 2 bar, and its number), gap (m), normal "
      "from a to b, "
      "point_a and point_b (m, of the cores). Cells that share a point are no pair, nor, unless "
      "within_structures, are those of one connected structure.");
  module.def("first_contact", &first_contact, py::arg("a_from"), py::arg("a_to"),
             py::arg("radius_a"), py::arg("b_from"), py::arg("b_to"), py::arg("radius_b"),
             "When two moving balls, bars or facets (1, 2 or 3 corners in m, before and after) "
             "first touch: (t from 0 to "
             "1, never too late, gap in m and normal there), or None.");
}

}  // namespace plekton::python
