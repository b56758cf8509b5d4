// A number for a list of points, which another list has by chance only.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "inkgrid/vec2.h"

namespace inkgrid {

// A bijection that spreads every bit over the word (the finaliser of splitmix64).
constexpr std::uint64_t mixed(std::uint64_t word) {
  word = (word ^ word >> 30) * 0xbf58476d1ce4e5b9;
  word = (word ^ word >> 27) * 0x94d049bb133111eb;
  return word ^ word >> 31;
}

inline std::uint64_t digest(std::span<const Vec2> points) {
  std::uint64_t hash = points.size();
  for (const Vec2 p : points)
    for (const double value : {p.x, p.y}) hash = mixed(hash ^ std::bit_cast<std::uint64_t>(value));
  return hash;
}

}  // namespace inkgrid
