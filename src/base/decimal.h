// Numbers as text for people and files: without exponent, the same in every locale.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace inkgrid {

// Rounded to `places` decimals, without trailing zeros and without a negative zero; for any finite value.
inline std::string decimal(double value, int places) {
  std::array<char, 400> buffer;  // the largest double has 309 digits
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, places).ptr;
  std::string text(buffer.data(), end);
  if (places > 0) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace inkgrid
