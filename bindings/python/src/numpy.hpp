#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <gale/io/write.hpp>

namespace gale::python {

namespace nb = nanobind;

/// Any bytes as a text: files don't promise UTF-8.
nb::str text_of(std::string_view bytes);

/// A numpy array of what `owner` keeps alive: `values` in rows of `width`, or in one dimension if that is 1.
template <class T, class Owner>
nb::object numpy_of(const T* values, std::size_t count, std::size_t width, std::shared_ptr<Owner> owner) {
  auto* const kept = new std::shared_ptr<Owner>(std::move(owner));
  const nb::capsule capsule(kept, [](void* p) noexcept { delete static_cast<std::shared_ptr<Owner>*>(p); });
  const std::size_t shape[] = {count / width, width};
  return nb::cast(nb::ndarray<nb::numpy, T>(const_cast<T*>(values), width == 1 ? 1 : 2, shape, capsule));
}

/// The same of a vector, whose memory it takes.
template <class T>
nb::object numpy_of(std::vector<T> values, std::size_t width = 1) {
  const auto owner = std::make_shared<std::vector<T>>(std::move(values));
  return numpy_of(owner->data(), owner->size(), width, owner);
}

/// A numpy array of bool, of zeros and ones, whose memory it takes.
template <class T>
nb::object flags_of(std::vector<T> zeros_and_ones) {
  static_assert(sizeof(T) == sizeof(bool));
  const auto owner = std::make_shared<std::vector<T>>(std::move(zeros_and_ones));
  return numpy_of(reinterpret_cast<const bool*>(owner->data()), owner->size(), 1, owner);
}

nb::object numpy_of(const io::Dataset::Positions& points);

/// By their names; of two of one name the latter.
nb::dict numpy_of(std::vector<io::PointArray> arrays);

/// A result's arrays by their names, flags as bool. Throws gale::Error if the field has the name of another one.
nb::dict numpy_of_result(std::vector<io::PointArray> arrays);

/// (points, point arrays)
nb::tuple numpy_of(io::PointSet set);

/// (points, point arrays, where cells begin, their points, arrays of cells), for what has either lines or polygons
nb::tuple numpy_of(io::Surface surface);

}  // namespace gale::python
