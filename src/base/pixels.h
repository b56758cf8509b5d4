// Values that are zero until they are written: where nothing is written of many of them, they take no memory.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace inkgrid {

// A fixed number of values.  Large ones live in pages of their own, which the system gives when they are first written and takes
// back at once; copies and fills leave zeros unwritten there.
template <class T>
class Pixels {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;

  Pixels() = default;
  explicit Pixels(std::size_t size) : values_(allocate(size), Free{size}) {}
  Pixels(std::size_t size, const T& value) : Pixels(size) {
    if (value != T()) std::fill(begin(), end(), value);
  }
  Pixels(const Pixels& other) : Pixels(other.size()) {
    if (is_paged(size()))
      copy_written(other);
    else
      std::copy(other.begin(), other.end(), begin());
  }
  Pixels(Pixels&& other) noexcept = default;
  Pixels& operator=(Pixels other) noexcept {
    values_ = std::move(other.values_);
    return *this;
  }
  ~Pixels() = default;

  std::size_t size() const { return values_ ? values_.get_deleter().size : 0; }
  bool empty() const { return size() == 0; }
  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  T* begin() { return data(); }
  T* end() { return data() + size(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }

  friend bool operator==(const Pixels& a, const Pixels& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }

 private:
  static constexpr std::size_t kPaged = std::size_t{6} << 20;  // bytes: for less, new pages cost more time than they save memory
  static constexpr std::size_t kBlock = 4096 / sizeof(T);      // a page

  struct Free {
    std::size_t size = 0;
    void operator()(T* values) const {
      if (is_paged(size))
        munmap(values, size * sizeof(T));
      else
        std::free(values);
    }
  };

  static bool is_paged(std::size_t size) { return size * sizeof(T) >= kPaged; }

  static T* allocate(std::size_t size) {
    if (size == 0) return nullptr;
    void* const values = is_paged(size)
                             ? mmap(nullptr, size * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
                             : std::calloc(size, sizeof(T));
    if (!values || values == MAP_FAILED) throw std::bad_alloc();
    return static_cast<T*>(values);
  }

  void copy_written(const Pixels& other) {
    for (std::size_t i = 0; i < size(); i += kBlock) {
      const T* const first = other.data() + i;
      const T* const last = other.data() + std::min(size(), i + kBlock);
      if (std::any_of(first, last, [](const T& value) { return value != T(); })) std::copy(first, last, data() + i);
    }
  }

  std::unique_ptr<T[], Free> values_;
};

}  // namespace inkgrid
