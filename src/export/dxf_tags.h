// What:   the text of a DXF file, pairs of a group code and a value, a line each; and what its two kinds share.
// Source: AutoCAD DXF reference, "Group codes in numerical order".
// Differs: nothing.
// Cost:   linear in the text.
#pragma once

#include <string>
#include <string_view>

#include "export/paper.h"

namespace inkgrid {

inline constexpr const char* kDxfCurveLayer = "CURVES";
inline constexpr const char* kDxfFillLayer = "FILLS";  // outlines of filled areas
inline constexpr int kDxfBlack = 7;                    // black on white, white on black

class DxfTags {
 public:
  void add(int code, std::string_view value) { text_.append(std::to_string(code)).append("\n").append(value).append("\n"); }
  void add(int code, int value) { add(code, std::to_string(value)); }
  void variable(std::string_view name, int code, std::string_view value) {
    add(9, name);
    add(code, value);
  }
  // Group codes code, code + 10, and code + 20 for a z of 0.
  void point(int code, Vec2 p) {
    constexpr int kPlaces = 6;
    add(code, decimal(p.x, kPlaces));
    add(code + 10, decimal(p.y, kPlaces));
    add(code + 20, "0");
  }
  // Printable ASCII; what is else is left out.
  void comment(const std::string& text) {
    std::string line;
    for (const char c : text)
      if (c >= ' ' && c <= '~') line += c;
    add(999, line);
  }
  void begin(std::string_view section) {
    add(0, "SECTION");
    add(2, section);
  }
  void end() { add(0, "ENDSEC"); }

  std::string finished() && {
    add(0, "EOF");
    return std::move(text_);
  }

 private:
  std::string text_;
};

// From the drawing, y down, to DXF, y up, in the unit.
struct DxfFrame {
  double scale;
  double height;  // px

  Vec2 operator()(Vec2 p) const { return scale * Vec2{p.x, height - p.y}; }
};

// The header variables that say where the sheet is.
void add_extents(DxfTags& tags, const Drawing& drawing, const DxfFrame& frame);

// DXF 2000: a spline a curve.
void add_splines_file(DxfTags& tags, const Drawing& drawing, const DxfFrame& frame, LengthUnit unit);

}  // namespace inkgrid
