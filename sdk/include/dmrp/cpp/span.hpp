// SPDX-License-Identifier: MIT
// cpp/span.hpp: a read-only view of an array that crosses the ABI: pointer, count and the owner's stride.
#pragma once

#include <cstddef>
#include <iterator>
#include <type_traits>

#include "../abi.h"

namespace dmrp {

// Valid as long as the array. Elements may be longer than T, so &span[0] does not point to an array of T.
template <class T>
class Span {
 public:
  class Iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    Iterator() = default;
    Iterator(const T* base, std::ptrdiff_t stride, std::ptrdiff_t index)
        : base_(base), stride_(stride), index_(index) {}

    reference operator*() const { return *DMRP_AT(T, base_, stride_, index_); }
    pointer operator->() const { return DMRP_AT(T, base_, stride_, index_); }
    reference operator[](difference_type n) const { return *DMRP_AT(T, base_, stride_, index_ + n); }
    Iterator& operator+=(difference_type n) { return index_ += n, *this; }
    Iterator& operator-=(difference_type n) { return index_ -= n, *this; }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this -= 1; }
    Iterator operator++(int) { return Iterator(base_, stride_, index_++); }
    Iterator operator--(int) { return Iterator(base_, stride_, index_--); }
    friend Iterator operator+(Iterator it, difference_type n) { return it += n; }
    friend Iterator operator+(difference_type n, Iterator it) { return it += n; }
    friend Iterator operator-(Iterator it, difference_type n) { return it -= n; }
    friend difference_type operator-(const Iterator& a, const Iterator& b) { return a.index_ - b.index_; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.index_ == b.index_; }
    friend bool operator!=(const Iterator& a, const Iterator& b) { return a.index_ != b.index_; }
    friend bool operator<(const Iterator& a, const Iterator& b) { return a.index_ < b.index_; }
    friend bool operator>(const Iterator& a, const Iterator& b) { return a.index_ > b.index_; }
    friend bool operator<=(const Iterator& a, const Iterator& b) { return a.index_ <= b.index_; }
    friend bool operator>=(const Iterator& a, const Iterator& b) { return a.index_ >= b.index_; }

   private:
    const T* base_ = nullptr;
    std::ptrdiff_t stride_ = sizeof(T);
    std::ptrdiff_t index_ = 0;
  };

  using value_type = T;
  using const_iterator = Iterator;

  Span() = default;
  Span(const T* base, std::size_t count, std::size_t stride = sizeof(T))
      : base_(base), count_(count), stride_(stride) {}
  // T may be the elements' C struct with functions added.
  template <class C, class = std::enable_if_t<std::is_base_of_v<C, T> && !std::is_same_v<C, T>>>
  Span(const C* base, std::size_t count, std::size_t stride) : Span(static_cast<const T*>(base), count, stride) {
    static_assert(sizeof(T) == sizeof(C) && std::is_standard_layout_v<T>, "T adds functions alone");
  }

  std::size_t size() const { return count_; }
  std::size_t stride() const { return stride_; }  // for DMRP_STRIDE_HAS
  bool empty() const { return count_ == 0; }
  const T& operator[](std::size_t index) const { return *DMRP_AT(T, base_, stride_, index); }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[count_ - 1]; }
  Iterator begin() const { return Iterator(base_, static_cast<std::ptrdiff_t>(stride_), 0); }
  Iterator end() const {
    return Iterator(base_, static_cast<std::ptrdiff_t>(stride_), static_cast<std::ptrdiff_t>(count_));
  }

 private:
  const T* base_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_ = sizeof(T);
};

}  // namespace dmrp
