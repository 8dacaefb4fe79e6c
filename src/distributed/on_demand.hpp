#pragma once

#include <functional>
#include <utility>

#include <gale/base/mirrored.hpp>

namespace gale::detail {

/// A value that the first caller of get() makes, on any thread. Other threads wait for it.
template <class T>
class OnDemand {
 public:
  /// Before anybody asks.
  void made_by(std::function<T()> make) { make_ = std::move(make); }

  const T& get() const {
    once_([this] {
      if (make_) value_ = make_();
      make_ = nullptr;
    });
    return value_;
  }

 private:
  mutable Once once_;
  mutable std::function<T()> make_;
  mutable T value_{};
};

}  // namespace gale::detail
