#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Kokkos_Core.hpp>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/error.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/stop.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/write.hpp>

// Arrays that callers hand over, by DLPack or as numpy's, in host memory or a device's; and those that they are given.

namespace gale::python {

namespace nb = nanobind;

/// Read where it is. Its rows follow each other.
using Array1 = nb::ndarray<nb::ro, nb::c_contig>;

template <class T>
bool is(const Array1& array) {
  return array.dtype() == nb::dtype<T>();
}

/// Throws gale::Error, calling the array `name`, unless it has the shape (n, width).
void require_rows(const Array1& array, std::size_t width, const char* name);

/// Whether the array is in a device's memory. Throws gale::Error, calling the array `name`, if this build of GALE can't
/// read it there. Waits for what others do on the device, so that what they write is there.
bool is_on_device(const Array1& array, const char* name);

/// What has `__cuda_array_interface__`, but not DLPack, as DLPack has it. `type` is a code of numpy's: 'f', 'i' or 'u'.
nb::ndarray<> device_array(std::uintptr_t data, const std::vector<std::size_t>& shape, char type, int bytes,
                           const nb::object& owner);

/// What `use` returns for a View of the array's rows, or of its values where there is no width: `Element` is e.g.
/// const float*[3]. In the memory where the array is.
template <class Element, class Use>
auto with_view(const Array1& array, const char* name, const Use& use) {
  using InHost = Kokkos::View<Element, Kokkos::LayoutRight, HostMemory>;
  using InWorker = Kokkos::View<Element, Kokkos::LayoutRight, WorkerMemory>;
  const auto* const data = static_cast<typename InHost::const_value_type*>(array.data());
  if (is_on_device(array, name)) return use(InWorker(data, array.shape(0)));
  return use(InHost(data, array.shape(0)));
}

/// What `use(one)` returns, where `one` is of the array's type: one of T.
template <class... T, class Use>
auto with_type(const Array1& array, const char* refusal, const Use& use) {
  using Result = std::common_type_t<decltype(use(T()))...>;
  std::optional<Result> result;
  const auto try_one = [&](auto one) {
    if (!is<decltype(one)>(array)) return false;
    result = use(one);
    return true;
  };
  if (!(try_one(T()) || ...)) throw Error(refusal);
  return *std::move(result);
}

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

/// A numpy array of a vector, whose memory it takes.
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

/// A copy of values on the host, which asks now and then whether to stop.
template <class T>
std::vector<T> vector_of(const T* values, std::size_t count) {
  std::vector<T> copy;
  reserve(copy, count);
  for (std::size_t done = 0; done < count;) {
    constexpr std::size_t at_once = 1 << 20;
    gale::detail::stop_if_asked();
    const std::size_t next = std::min(done + at_once, count);
    copy.insert(copy.end(), values + done, values + next);
    done = next;
  }
  return copy;
}

/// A copy of the field on the host, as the outputs take it. Throws gale::Error, which says `what` it is, unless it has
/// one dimension, and numbers of up to 8 bytes. To be called within a `Job`, since it may be on a device.
io::PointArray field_of(const Array1& values, const std::string& name, const std::string& what = "the field");

/// The order by the field, from where its values are, which must be as above; or from such a copy.
VertexOrder order_of(const Mesh& mesh, const Array1& values);
VertexOrder order_of(const Mesh& mesh, const io::PointArray& field);

}  // namespace gale::python
