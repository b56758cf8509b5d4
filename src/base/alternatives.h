// Names as a sentence lists them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace inkgrid {

// "auto, clean or rough"
inline std::string alternatives(std::span<const char* const> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : " or ";
    text += names[i];
  }
  return text;
}

}  // namespace inkgrid
