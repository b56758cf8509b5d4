// What:   a well-formed XML document as a tree of elements.
// Source: XML 1.0, read by expat.  Prefixes of element names are dropped, so that undeclared ones do no harm.
// Cost:   the text twice in memory.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace inkgrid {

struct XmlElement {
  std::string tag;                                              // without its prefix
  std::vector<std::pair<std::string, std::string>> attributes;  // names as they are written
  std::string text;                                             // what stands directly in it
  std::vector<XmlElement> children;

  // The value of an attribute, or a null pointer.
  const std::string* find(std::string_view name) const;
};

// `name` is only for messages.  Throws Error{file} where the text is not well-formed or nested more than 500 deep.
XmlElement parse_xml(std::string_view text, const std::string& name);

}  // namespace inkgrid
