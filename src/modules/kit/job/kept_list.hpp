// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace degs {

/// Values that are numbered from 0 on in the order in which they come. The oldest may be given up;
/// the others keep their numbers. Others may move in memory when one comes or goes.
template <class T>
class KeptList {
public:
    using value_type = T;
    using const_iterator = typename std::vector<T>::const_iterator;

    KeptList() = default;
    explicit KeptList(std::vector<T> values) : values_(std::move(values)) {}

    /// The number of the next value.
    std::size_t size() const { return first_ + values_.size(); }
    /// The lowest number whose value is kept; size() if there is none.
    std::size_t first() const { return first_; }
    T& operator[](std::size_t number) { return values_[number - first_]; }
    const T& operator[](std::size_t number) const { return values_[number - first_]; }
    const T& front() const { return values_.front(); }
    T& front() { return values_.front(); }
    T& back() { return values_.back(); }
    void push_back(T value) { values_.push_back(std::move(value)); }
    template <class... Arguments>
    T& emplace_back(Arguments&&... arguments) {
        return values_.emplace_back(std::forward<Arguments>(arguments)...);
    }
    /// Gives up the values below `number`, which is at most size().
    void drop_before(std::size_t number) {
        if (number > first_) {
            values_.erase(values_.begin(), values_.begin() + (number - first_));
            first_ = number;
        }
    }
    /// The iterators go over the values that are kept.
    typename std::vector<T>::iterator begin() { return values_.begin(); }
    typename std::vector<T>::iterator end() { return values_.end(); }
    const_iterator begin() const { return values_.begin(); }
    const_iterator end() const { return values_.end(); }

private:
    std::vector<T> values_;
    std::size_t first_ = 0;
};

} // namespace degs
