// WrittenAhead: a list that is written to its greatest length first and cut to what was kept then.
//
// Why       an entry is written whether it is kept or not and its place goes on by 0 or 1: no branch on what cannot be
//           guessed. The room stays from use to use and is not cleared, which std::vector's resize would do
#pragma once

#include <cstddef>
#include <vector>

namespace bosquet::growth {

template <class T>
class WrittenAhead {
 public:
  /// Room for so many; what it held is still there.
  T* make_room(std::size_t most) {
    if (room_.size() < most) room_.resize(most);
    return room_.data();
  }
  void keep(std::size_t count) { size_ = count; }

  std::size_t size() const { return size_; }
  T* data() { return room_.data(); }
  const T* data() const { return room_.data(); }
  T* begin() { return room_.data(); }
  T* end() { return room_.data() + size_; }
  const T* begin() const { return room_.data(); }
  const T* end() const { return room_.data() + size_; }

 private:
  std::vector<T> room_;
  std::size_t size_ = 0;
};

}  // namespace bosquet::growth
