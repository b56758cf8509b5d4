// Section 4, equation (1): grid-preserving maps  x -> i^turn * x + shift  of the (u, v) plane, exact on integers.
#pragma once

#include <cstdint>

#include "inkgrid/vec2.h"

namespace inkgrid {

struct IVec2 {
  std::int64_t x = 0;
  std::int64_t y = 0;

  friend constexpr IVec2 operator+(IVec2 a, IVec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr IVec2 operator-(IVec2 a, IVec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr IVec2 operator*(std::int64_t k, IVec2 a) { return {k * a.x, k * a.y}; }
  friend constexpr bool operator==(IVec2 a, IVec2 b) { return a.x == b.x && a.y == b.y; }
};

// i^turn * a, for any integer turn; works for Vec2 and IVec2 and is exact.
template <class V>
constexpr V turned(V a, int turn) {
  switch (turn & 3) {
    case 1:
      return {-a.y, a.x};
    case 2:
      return {-a.x, -a.y};
    case 3:
      return {a.y, -a.x};
    default:
      return a;
  }
}

struct Transition {
  int turn = 0;  // quarter turns, 0..3
  IVec2 shift;   // grid units

  friend constexpr bool operator==(const Transition& a, const Transition& b) { return a.turn == b.turn && a.shift == b.shift; }
};

constexpr Transition inverse(const Transition& t) {
  return {(4 - t.turn) & 3, turned(IVec2{} - t.shift, -t.turn)};
}

}  // namespace inkgrid
