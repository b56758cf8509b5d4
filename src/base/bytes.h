// Numbers at places of a file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>

namespace inkgrid {

// Reading past the end throws std::out_of_range.
class Bytes {
 public:
  explicit Bytes(std::span<const char> bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  bool starts_with(std::string_view magic, std::size_t at = 0) const {
    return at + magic.size() <= size() &&
           std::equal(magic.begin(), magic.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  std::uint32_t u8(std::size_t at) const {
    if (at >= size()) throw std::out_of_range("past the end of the file");
    return static_cast<unsigned char>(bytes_[at]);
  }
  std::uint32_t u16(std::size_t at, bool big) const { return big ? u8(at) << 8 | u8(at + 1) : u8(at + 1) << 8 | u8(at); }
  std::uint32_t u32(std::size_t at, bool big) const {
    return big ? u16(at, big) << 16 | u16(at + 2, big) : u16(at + 2, big) << 16 | u16(at, big);
  }

 private:
  std::span<const char> bytes_;
};

}  // namespace inkgrid
