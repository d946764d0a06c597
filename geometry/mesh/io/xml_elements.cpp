// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/xml_elements.hpp"

#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/mesh.hpp"

#include <algorithm>

namespace plekton::geometry {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";
constexpr std::string_view kEndsOfAName = " \t\r\n/>";
constexpr std::size_t kMostLevels = 64;

class XmlReader {
 public:
  XmlReader(std::string_view bytes, const std::string& name, std::string_view root)
      : bytes_(bytes), name_(name), root_(root) {}

  std::vector<XmlElement> read() && {
    while (pass_to('<')) {
      if (starts("<?")) {
        pass_behind("?>");
      } else if (starts("<!--")) {
        pass_behind("-->");
      } else if (starts("<!")) {
        pass_behind(">");
      } else if (elements_.empty() && !starts_root()) {
        break;
      } else if (starts("</")) {
        read_end_tag();
      } else {
        read_start_tag();
        if (elements_.back().name == "AppendedData") return std::move(elements_);
      }
    }
    if (elements_.empty())
      throw MeshError(name_ + ": line " + std::to_string(line_) + ": expected the root " +
                      std::string(root_) + "; this is " + std::string(kAnotherKind));
    if (!open_.empty())
      fail("the end tag of " + quoted(elements_[open_.back()].name), "the end of the file");
    return std::move(elements_);
  }

 private:
  [[noreturn]] void fail(const std::string& expected, const std::string& got) const {
    throw MeshError(name_ + ": line " + std::to_string(line_) + ": expected " + expected +
                    ", got " + got + "; the file is cut off or damaged; save the mesh again");
  }

  bool starts(std::string_view text) const { return bytes_.substr(at_).starts_with(text); }

  bool starts_root() const {
    const std::string_view tag = bytes_.substr(at_ + 1);
    return tag.substr(0, tag.find_first_of(kEndsOfAName)) == root_;
  }

  void pass(std::size_t end) {
    line_ += static_cast<std::size_t>(std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                 bytes_.begin() + static_cast<std::ptrdiff_t>(end),
                                                 '\n'));
    at_ = end;
  }

  bool pass_to(char c) {
    const std::size_t end = bytes_.find(c, at_);
    pass(std::min(end, bytes_.size()));
    return end != std::string_view::npos;
  }

  void pass_behind(std::string_view text) {
    const std::size_t end = bytes_.find(text, at_);
    if (end == std::string_view::npos) fail(std::string(text), "the end of the file");
    pass(end + text.size());
  }

  void pass_blanks() { pass(std::min(bytes_.find_first_not_of(kXmlBlanks, at_), bytes_.size())); }

  std::string_view word(std::string_view ends) {
    const std::size_t begin = at_;
    pass(std::min(bytes_.find_first_of(ends, at_), bytes_.size()));
    return bytes_.substr(begin, at_ - begin);
  }

  void read_end_tag() {
    pass(at_ + 2);
    const std::string_view name = word(" \t\r\n>");
    if (open_.empty() || elements_[open_.back()].name != name)
      fail(open_.empty() ? "a start tag" : "the end tag of " + quoted(elements_[open_.back()].name),
           "that of " + quoted(name));
    open_.pop_back();
    pass_behind(">");
  }

  void read_start_tag() {
    XmlElement element;
    if (open_.size() == kMostLevels) fail("at most 64 levels of elements", "more");
    element.line = line_;
    element.depth = open_.size();
    pass(at_ + 1);
    element.name = word(kEndsOfAName);
    for (pass_blanks(); !starts(">") && !starts("/>"); pass_blanks())
      element.attributes.push_back(read_attribute());
    const bool is_empty = starts("/>");
    pass(at_ + (is_empty ? 2 : 1));
    element.text_line = line_;
    const std::size_t end = element.name == "AppendedData"
                                ? bytes_.size()
                                : std::min(bytes_.find('<', at_), bytes_.size());
    if (!is_empty) {
      element.text = bytes_.substr(at_, end - at_);
      open_.push_back(elements_.size());
    }
    elements_.push_back(std::move(element));
  }

  std::pair<std::string_view, std::string_view> read_attribute() {
    const std::string_view key = word(" \t\r\n=/><");
    pass_blanks();
    if (key.empty() || !starts("="))
      fail("an attribute and its value", quoted(bytes_.substr(at_, 1)));
    pass(at_ + 1);
    pass_blanks();
    if (!starts("\"") && !starts("'")) fail("a value in quotes", quoted(bytes_.substr(at_, 1)));
    const std::string_view quote = bytes_.substr(at_, 1);
    pass(at_ + 1);
    const std::string_view value = word(quote);
    pass_behind(quote);
    return {key, value};
  }

  std::string_view bytes_;
  std::string name_;
  std::string_view root_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::vector<XmlElement> elements_;
  std::vector<std::size_t> open_;  ///< elements that have not ended yet, outermost first
};

}  // namespace

std::string_view XmlElement::attribute(std::string_view key) const noexcept {
  for (const auto& [name_of_value, value] : attributes)
    if (name_of_value == key) return value;
  return {};
}

std::vector<XmlElement> read_xml(std::string_view bytes, const std::string& name,
                                 std::string_view root) {
  return XmlReader(bytes, name, root).read();
}

std::vector<std::size_t> children_of(const std::vector<XmlElement>& elements, std::size_t parent,
                                     std::string_view name) {
  std::vector<std::size_t> children;
  const std::size_t depth = elements[parent].depth;
  for (std::size_t i = parent + 1; i < elements.size() && elements[i].depth > depth; ++i)
    if (elements[i].depth == depth + 1 && elements[i].name == name) children.push_back(i);
  return children;
}

}  // namespace plekton::geometry
