// A point or vector of the plane, in pixels unless said otherwise.
// `*` and `/` between vectors are those of complex numbers, so that field code reads like its formula.
#pragma once

#include <cmath>

namespace inkgrid {

struct Vec2 {
  double x = 0;
  double y = 0;

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  friend constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
  friend constexpr Vec2 operator*(Vec2 a, double k) { return {k * a.x, k * a.y}; }
  friend constexpr Vec2 operator/(Vec2 a, double k) { return {a.x / k, a.y / k}; }
  friend constexpr Vec2 operator*(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
  friend constexpr bool operator==(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }
  Vec2& operator+=(Vec2 b) { return *this = *this + b; }
  Vec2& operator-=(Vec2 b) { return *this = *this - b; }
};

constexpr double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
constexpr double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
constexpr double norm2(Vec2 a) {
  return dot(a, a);
}
inline double norm(Vec2 a) {
  return std::hypot(a.x, a.y);
}
constexpr Vec2 conj(Vec2 a) {
  return {a.x, -a.y};
}
// Quarter turn from the x axis to the y axis (multiplication by i).
constexpr Vec2 quarter_turn(Vec2 a) {
  return {-a.y, a.x};
}
// The unit vector along a; the null vector stays itself.
inline Vec2 unit(Vec2 a) {
  const double n = norm(a);
  return n > 0 ? a / n : a;
}
constexpr Vec2 lerp(Vec2 a, Vec2 b, double t) {
  return a + t * (b - a);
}

}  // namespace inkgrid
