#pragma once

#include <functional>
#include <utility>

#include <gale/base/mirrored.hpp>

namespace gale::detail {

/// Something that whoever asks for it first makes; others wait for that. By any thread.
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
