// SVG files as text, for tests that read them.
#pragma once

#include <string>

#include "inkgrid/compare.h"

namespace inkgrid::testing {

// A page of 400 x 300 px, of a clean drawing with a pen of 4 px.
inline SvgText page(const std::string& content, const std::string& attributes = "viewBox='0 0 400 300' data-pen='4'") {
  return {"page.svg", "<svg xmlns='http://www.w3.org/2000/svg' " + attributes + ">" + content + "</svg>"};
}

inline std::string stroke(const std::string& data, const std::string& attributes = "") {
  return "<path fill='none' stroke='black' d='" + data + "' " + attributes + "/>";
}

// One stroke a path.
template <class... Data>
SvgText strokes(const Data&... data) {
  return page((stroke(data) + ... + std::string{}));
}

}  // namespace inkgrid::testing
