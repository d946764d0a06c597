// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/readers.hpp"
#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/soup_builder.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

/// What becomes of an element of the file.
enum class ElementUse { triangle, quadrangle, curved_surface, skip };

// Numbers of the element types: Gmsh reference manual, "MSH file format", and for the higher orders
// gmsh's own list (GmshDefines.h).
ElementUse use_of(std::int64_t type) noexcept {
  if (type == 2) return ElementUse::triangle;
  if (type == 3) return ElementUse::quadrangle;
  const bool second_order = type == 9 || type == 10 || type == 16;
  const bool higher_order = (type >= 20 && type <= 25) || (type >= 36 && type <= 61);
  return second_order || higher_order ? ElementUse::curved_surface : ElementUse::skip;
}

class GmshReader {
 public:
  GmshReader(std::string_view text, const std::string& name)
      : text_(text, name), soup_(name, 0), name_(name) {}

  PolygonSoup read() && {
    while (!text_.at_end()) {
      const std::string section(text_.word("a section such as $Nodes"));
      const bool is_gmsh = version_ != Version::unknown;
      if (!section.starts_with('$'))
        text_.fail("a section such as $Nodes", quoted(section, is_gmsh));
      require(is_gmsh || section == "$MeshFormat" || section == "$Comments", "$MeshFormat");
      if (section == "$MeshFormat")
        read_format();
      else if (section == "$Nodes")
        read_nodes();
      else if (section == "$Elements")
        read_elements();
      else
        skip_section(section);
    }
    require(has_nodes_, "$Nodes");
    return std::move(soup_).finish();
  }

 private:
  enum class Version { unknown, v2_2, v4_1 };

  struct Node {
    std::int64_t number;   ///< in the file
    std::size_t position;  ///< among the points
    std::size_t line;
  };

  void require(bool met, const char* section) {
    if (!met)
      throw MeshError(name_ + ": no section " + section +
                      " where one is needed; the file is cut off or of another kind; save the mesh "
                      "again");
  }

  void read_format() {
    const std::string_view version = text_.word("the version of the format");
    if (version == "2.2")
      version_ = Version::v2_2;
    else if (version == "4.1")
      version_ = Version::v4_1;
    else
      text_.fail("version 2.2 or 4.1 of the format (gmsh: -format msh22 or msh41)",
                 quoted(version));
    if (text_.integer("0 for ASCII") != 0)
      throw MeshError(name_ + ": line " + std::to_string(text_.line()) +
                      ": a binary .msh file; expected ASCII; save the mesh again as ASCII "
                      "(gmsh: option Mesh.Binary = 0)");
    text_.integer("the size of a number");
    end_section("$EndMeshFormat");
  }

  void end_section(std::string_view expected) {
    const std::string_view word = text_.word(expected);
    if (word != expected) text_.fail(expected, quoted(word));
  }

  /// Groups, entities, results: lines of any content up to the closing one.
  void skip_section(const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    text_.rest_of_line();
    while (!text_.at_end()) {
      std::string_view line = text_.rest_of_line();
      line = line.substr(0, line.find_last_not_of(" \t") + 1);
      if (line == end) return;
    }
    text_.fail(end, "the end of the file");
  }

  std::size_t count(const char* what) {
    const std::int64_t number = text_.integer(what);
    if (number < 0) text_.fail(what, std::to_string(number));
    return static_cast<std::size_t>(number);
  }

  void read_nodes() {
    if (std::exchange(has_nodes_, true)) text_.fail("one section $Nodes", "a second one");
    if (version_ == Version::v2_2) {
      const std::size_t nodes = count("the number of nodes");
      for (std::size_t i = 0; i < nodes; ++i) read_point(text_.integer("the number of a node"));
    } else {
      const std::size_t blocks = count("the number of blocks of nodes");
      text_.rest_of_line();  // Totals, which the blocks repeat.
      for (std::size_t block = 0; block < blocks; ++block) read_node_block();
    }
    soup_.expect_points(soup_.point_count());
    order_nodes();
    end_section("$EndNodes");
  }

  /// First the numbers of all nodes of a block, then their positions.
  void read_node_block() {
    for (const char* what : {"the dimension of a block", "the entity of a block",
                             "0, or 1 for parametric coordinates"})
      text_.integer(what);
    const std::size_t nodes = count("the number of nodes of a block");
    std::vector<std::int64_t> numbers;
    for (std::size_t i = 0; i < nodes; ++i)
      numbers.push_back(text_.integer("the number of a node"));
    for (const std::int64_t number : numbers) read_point(number);
  }

  void read_point(std::int64_t number) {
    Vec3 point;
    for (double& coordinate : point) coordinate = text_.number("a coordinate of a node");
    const std::size_t line = text_.line();
    text_.rest_of_line();  // Parametric coordinates.
    nodes_.push_back({number, soup_.point_count(), line});
    soup_.add_point(point, line);
  }

  /// Sorts the nodes for node_numbered().
  void order_nodes() {
    // Of nodes with one number the first in the file comes first, and is the one that elements get.
    const auto key = [](const Node& node) { return std::pair(node.number, node.position); };
    std::ranges::sort(nodes_, {}, key);
    for (std::size_t k = 1; k < nodes_.size(); ++k)
      if (nodes_[k].number == nodes_[k - 1].number)
        soup_.add_problem("node " + std::to_string(nodes_[k].number) + " is there twice",
                          nodes_[k].line);
  }

  /// The node of a number; nullptr if the file has none.
  const Node* node_numbered(std::int64_t number) const {
    const auto found = std::ranges::lower_bound(nodes_, number, {}, &Node::number);
    return found != nodes_.end() && found->number == number ? &*found : nullptr;
  }

  void read_elements() {
    require(has_nodes_, "$Nodes");
    if (version_ == Version::v2_2) {
      const std::size_t elements = count("the number of elements");
      for (std::size_t i = 0; i < elements; ++i) {
        const std::int64_t number = text_.integer("the number of an element");
        const std::int64_t type = text_.integer("the type of an element");
        const std::size_t tags = count("the number of tags of an element");
        for (std::size_t k = 0; k < tags; ++k) text_.integer("a tag of an element");
        read_element(number, type);
      }
    } else {
      const std::size_t blocks = count("the number of blocks of elements");
      text_.rest_of_line();
      for (std::size_t block = 0; block < blocks; ++block) read_element_block();
    }
    end_section("$EndElements");
  }

  void read_element_block() {
    for (const char* what : {"the dimension of a block", "the entity of a block"})
      text_.integer(what);
    const std::int64_t type = text_.integer("the type of the elements of a block");
    const std::size_t elements = count("the number of elements of a block");
    for (std::size_t i = 0; i < elements; ++i)
      read_element(text_.integer("the number of an element"), type);
  }

  void read_element(std::int64_t number, std::int64_t type) {
    const std::size_t line = text_.line();
    switch (use_of(type)) {
      case ElementUse::skip:
        text_.rest_of_line();
        soup_.skip_elements(1);
        return;
      case ElementUse::curved_surface:
        text_.rest_of_line();
        soup_.add_problem("element " + std::to_string(number) + " of type " + std::to_string(type) +
                              " is curved; expected triangles and quadrangles of first order",
                          line);
        return;
      case ElementUse::triangle:
        return read_corners(number, 3);
      case ElementUse::quadrangle:
        return read_corners(number, 4);
    }
  }

  void read_corners(std::int64_t number, std::size_t corner_count) {
    corners_.clear();
    for (std::size_t k = 0; k < corner_count; ++k) {
      const std::int64_t corner = text_.integer("a node of an element");
      const Node* node = node_numbered(corner);
      if (node == nullptr) {
        soup_.add_problem("element " + std::to_string(number) + " names node " +
                              std::to_string(corner) + ", which the file does not have",
                          text_.line());
        continue;
      }
      corners_.push_back(static_cast<std::int64_t>(node->position));
    }
    soup_.add_polygon(corners_, text_.line());
  }

  TextScanner text_;
  SoupBuilder soup_;
  std::string name_;
  Version version_ = Version::unknown;
  bool has_nodes_ = false;
  /// By number once all are there. A hash table would take quadratic time for numbers chosen so
  /// that they share a bucket.
  std::vector<Node> nodes_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

PolygonSoup read_gmsh(std::string_view text, const std::string& name) {
  return GmshReader(text, name).read();
}

}  // namespace plekton::geometry
