// Shared list: a list as a value whose copies hold the same memory, as the parts of a document do.
//
// Holds     a list once made is never written: adding or replacing makes a new one, so whoever has the old one needs no
//           lock, and two documents that share a list need not be compared entry by entry
// Cost      a copy is a pointer; add() and replace() copy the list
#pragma once

#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace bosquet::scene {

template <class T>
class SharedList {
 public:
  using value_type = T;
  using const_iterator = typename std::vector<T>::const_iterator;

  SharedList() = default;
  SharedList(std::vector<T> items) {
    if (!items.empty()) items_ = std::make_shared<const std::vector<T>>(std::move(items));
  }
  SharedList(std::initializer_list<T> items) : SharedList(std::vector<T>(items)) {}

  std::size_t size() const { return items_ ? items_->size() : 0; }
  bool empty() const { return !items_; }
  const T& operator[](std::size_t i) const { return assert(i < size()), (*items_)[i]; }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size() - 1]; }
  const_iterator begin() const { return all().begin(); }
  const_iterator end() const { return all().end(); }
  const std::vector<T>& all() const {
    static const std::vector<T> none;
    return items_ ? *items_ : none;
  }
  operator const std::vector<T>&() const { return all(); }

  void push_back(T item) {
    std::vector<T> items;
    items.reserve(size() + 1);
    items.assign(begin(), end());
    items.push_back(std::move(item));
    *this = std::move(items);
  }
  void replace(std::size_t i, T item) {
    assert(i < size());
    std::vector<T> items = all();
    items[i] = std::move(item);
    *this = std::move(items);
  }
  void erase(std::size_t i) {
    assert(i < size());
    std::vector<T> items = all();
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
    *this = std::move(items);
  }

  /// Whether both hold the same memory: then they are equal.
  bool shares(const SharedList& other) const { return items_ == other.items_; }
  bool operator==(const SharedList& other) const { return shares(other) || all() == other.all(); }

 private:
  std::shared_ptr<const std::vector<T>> items_;  ///< null when empty
};

}  // namespace bosquet::scene
