// Bytes as text of 64 letters (RFC 4648, section 4).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace inkgrid {

inline constexpr std::string_view kBase64Letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

inline std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kBase64Letters[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// Nothing where the text is not exactly what base64 writes: no line breaks, padded, with unused bits that are 0.
inline std::optional<std::string> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::array<int, 256> value;
  value.fill(-1);
  for (std::size_t k = 0; k < kBase64Letters.size(); ++k)
    value[static_cast<unsigned char>(kBase64Letters[k])] = static_cast<int>(k);
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  const std::size_t letters = text.size() - padding;
  std::string bytes;
  bytes.reserve(letters * 3 / 4);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < letters; ++i) {
    const int v = value[static_cast<unsigned char>(text[i])];
    if (v < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<std::uint32_t>(v)) & 0xffffff;
    if (i % 4 > 0) bytes += static_cast<char>(bits >> (6 - 2 * (i % 4)) & 255);
  }
  const std::uint32_t unused = padding == 2 ? 15 : padding == 1 ? 3 : 0;
  if (bits & unused) return std::nullopt;
  return bytes;
}

}  // namespace inkgrid
