// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::geometry {

/// An element of an XML file. Its views are into the bytes that were read.
struct XmlElement {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;  ///< as written, unescaped
  std::string_view text;      ///< from its start tag to the next tag
  std::size_t depth = 0;      ///< 0 for the root
  std::size_t line = 1;       ///< of its start tag
  std::size_t text_line = 1;  ///< of its text

  /// Value of an attribute; empty if there is none.
  std::string_view attribute(std::string_view key) const noexcept;
};

/// The elements of an XML file in the order of their start tags, so what is inside an element
/// follows it at greater depth. Declarations and comments are passed over. Reading stops at an
/// element AppendedData, whose text is then the rest of the bytes: it holds anything. Linear in the
/// size.
/// @param root  Name of the outermost element.
/// @throws MeshError for another root or none, for tags that do not close or match, and for more
/// than 64 levels.
std::vector<XmlElement> read_xml(std::string_view bytes, const std::string& name,
                                 std::string_view root);

/// Positions of the children of an element.
/// @param name  Only children of this name.
std::vector<std::size_t> children_of(const std::vector<XmlElement>& elements, std::size_t parent,
                                     std::string_view name);

}  // namespace plekton::geometry
