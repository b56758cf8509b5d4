// What:   the numbers, lengths and transformations that SVG writes as text.
// Source: SVG 1.1, sections 4.2 (lengths), 7.6 (transform), 7.8 (preserveAspectRatio).
// Differs: units that need a font are taken for pixels.
// Cost:   one pass over the text.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "inkgrid/vec2.h"

namespace inkgrid {

// p -> x p.x + y p.y + origin
struct Affine {
  Vec2 x{1, 0};
  Vec2 y{0, 1};
  Vec2 origin;

  Vec2 operator()(Vec2 p) const { return p.x * x + p.y * y + origin; }
  // First `inner`, then this one.
  Affine operator*(const Affine& inner) const {
    return {(*this)(inner.x) - origin, (*this)(inner.y) - origin, (*this)(inner.origin)};
  }
};

// A width and a height.
struct Extent {
  double width = 0;
  double height = 0;
};

std::string_view trimmed(std::string_view text);

// The number that the text begins with, which is taken off it.
std::optional<double> take_number(std::string_view& text);

// Every number in the text, whatever stands between them.
std::vector<double> numbers_in(std::string_view text);

// Pixels; "12mm", "3pt", "40%" of `whole`.  Nothing where there is no number, or no whole for a percentage.
std::optional<double> length_in_pixels(std::string_view text, std::optional<double> whole = std::nullopt);

// The attribute `transform`; what is not understood is left out.
Affine parse_transform(std::string_view text);

// The part {x, y, width, height} of the plane, laid into a page as preserveAspectRatio says.
Affine view_box_transform(const std::array<double, 4>& box, Extent page, std::string_view preserve_aspect_ratio);

}  // namespace inkgrid
