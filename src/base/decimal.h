// Numbers as text for people and files: without exponent, the same in every locale.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

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

// The shortest decimal that reads back as the same value, without an exponent where a person would write none.
inline std::string shortest(double value) {
  const bool plain = value == 0 || (std::abs(value) >= 1e-6 && std::abs(value) < 1e9);
  const auto format = plain ? std::chars_format::fixed : std::chars_format::general;
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format).ptr};
}

// The whole text as a number, in the C locale whatever the user's is.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace inkgrid
