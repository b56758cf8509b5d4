// The place in a container of an index that meshes and graphs hold as an int.
#pragma once

#include <concepts>
#include <cstddef>

namespace inkgrid {

template <std::integral Integer>
constexpr std::size_t at(Integer index) {
  return static_cast<std::size_t>(index);
}

}  // namespace inkgrid
