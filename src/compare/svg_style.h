// What:   which elements of an SVG file are painted, and how wide.
// Source: SVG 1.1, section 6 (attributes, style attribute, style sheets).
// Differs: of CSS, only simple selectors (tag, .class, #id and their combinations) are understood, the last one of a chain
//          stands for all of it, and later rules win whatever their specificity.
// Cost:   a pass over the rules an element.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/xml.h"

namespace inkgrid {

// Values as they are written.
struct SvgStyle {
  std::string stroke = "none";
  std::string fill = "black";
  std::string stroke_width = "1";
  std::string visibility = "visible";
  std::string display = "inline";
};

using Declarations = std::vector<std::pair<std::string, std::string>>;

struct CssRule {
  std::string tag;                 // empty: any
  std::vector<std::string> marks;  // ".class", "#id": all of them
  Declarations declarations;
};

std::vector<CssRule> parse_css(std::string_view text);

// What the element has of itself, over what it inherits.
SvgStyle style_of(const XmlElement& element, const SvgStyle& inherited, const std::vector<CssRule>& rules);

bool is_paint(std::string_view value);

}  // namespace inkgrid
