#include "recording.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace inkgrid::studio {
namespace {

static_assert(std::endian::native == std::endian::little, "the page's arrays are little-endian");

enum Flags { kRim = 1, kGrows = 2, kSquare = 4 };

template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

}  // namespace

void Recording::put(double number) {
  append(bytes_, static_cast<float>(number));
}

void Recording::put_count(std::uint32_t count) {
  append(bytes_, count);
}

void Recording::put(Colour colour) {
  for (const int shift : {16, 8, 0}) bytes_ += static_cast<char>(colour.rgb >> shift & 0xff);
  bytes_ += static_cast<char>(std::lround(255 * colour.alpha));
}

// Begins a batch where the kind changes, and counts.
void Recording::element_of(Kind kind) {
  if (kind != kind_) {
    kind_ = kind;
    append(bytes_, static_cast<std::uint32_t>(kind));
    count_at_ = bytes_.size();
    put_count(0);
  }
  std::uint32_t count = 0;
  std::memcpy(&count, bytes_.data() + count_at_, sizeof count);
  ++count;
  std::memcpy(bytes_.data() + count_at_, &count, sizeof count);
}

void Recording::pixels(const Raster<std::uint8_t>& mask, double side, Colour colour) {
  kind_ = Kind::none;
  element_of(Kind::pixels);
  put_count(static_cast<std::uint32_t>(mask.width));
  put_count(static_cast<std::uint32_t>(mask.height));
  put(side);
  put(colour);
  bytes_.append(reinterpret_cast<const char*>(mask.data.data()), mask.data.size());
  bytes_.append((4 - mask.data.size() % 4) % 4, '\0');
}

void Recording::triangle(Vec2 a, Vec2 b, Vec2 c, Colour colour) {
  element_of(Kind::triangles);
  for (const Vec2 corner : {a, b, c}) {
    put(corner.x);
    put(corner.y);
    put(colour);
  }
}

void Recording::polyline(std::span<const Vec2> points, double width, Colour colour) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    element_of(Kind::lines);
    for (const Vec2 p : {points[i - 1], points[i]}) {
      put(p.x);
      put(p.y);
    }
    put(width);
    put(colour);
  }
}

void Recording::curve(const Curve& /*curve*/, double /*width*/, Colour /*colour*/) {}

void Recording::put_disc(Vec2 centre, double radius, double hole, int flags, Colour colour) {
  element_of(Kind::discs);
  put(centre.x);
  put(centre.y);
  put(radius);
  put(hole);
  put(static_cast<double>(flags));
  put(colour);
}

void Recording::disc(Vec2 centre, double radius, Colour colour) {
  put_disc(centre, radius, 0, kRim, colour);
}

void Recording::dot(Vec2 centre, double radius, Colour colour) {
  put_disc(centre, radius, 0, kGrows, colour);
}

void Recording::ring(Vec2 centre, double radius, double width, Colour colour) {
  put_disc(centre, radius + width / 2, radius - width / 2, 0, colour);
}

void Recording::square(Vec2 centre, double half_side, Colour colour) {
  put_disc(centre, half_side, 0, kSquare, colour);
}

}  // namespace inkgrid::studio
