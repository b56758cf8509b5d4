// Element i of a vector or array, for the int indices that meshes and graphs use.
#pragma once

#include <cstddef>

namespace inkgrid {

template <class Values>
constexpr auto& at(Values& values, int i) {
  return values[static_cast<std::size_t>(i)];
}

}  // namespace inkgrid
