#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// Which of GALE's types holds what a caller's type does.
template <class T>
using CoordinateFor = std::conditional_t<std::is_same_v<T, float>, float, double>;
template <class T>
using IndexFor =
    std::conditional_t<(sizeof(T) < 4 || (sizeof(T) == 4 && std::is_signed_v<T>)), std::int32_t, std::int64_t>;

/// A caller's View as rows of `columns` entries where GALE reads them.
template <int columns, template <class> class TypeFor, class View>
using RowsOf =
    Kokkos::View<const TypeFor<typename View::non_const_value_type>* [columns], Kokkos::LayoutRight,
                 std::conditional_t<is_device_memory<typename View::memory_space>, WorkerMemory, HostMemory>>;

/// Copies a row of `columns` entries.
template <int columns, class To, class From>
struct CopyRow {
  To to;
  From from;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    for (int column = 0; column < columns; ++column)
      to(i, column) = static_cast<typename To::non_const_value_type>(from(i, column));
  }
};

/// The View's memory if it is laid out so, else a copy. Throws gale::Error, calling it `name`, if it has another number
/// of columns.
template <int columns, template <class> class TypeFor, class View>
RowsOf<columns, TypeFor, View> rows_of(const char* name, const View& view) {
  static_assert(View::rank == 2, "a View of rank 2 is wanted");
  using Rows = RowsOf<columns, TypeFor, View>;
  using Type = typename Rows::non_const_value_type;
  if (view.extent(1) != columns) {
    throw Error(std::string(name) + " have " + std::to_string(view.extent(1)) + " columns, not " +
                std::to_string(columns));
  }
  if constexpr (std::is_same_v<Type, typename View::non_const_value_type>) {
    if (view.stride(0) == columns && view.stride(1) == 1) return Rows(view.data(), view.extent(0));
  }
  using Space =
      std::conditional_t<is_device_memory<typename Rows::memory_space>, WorkerSpace, Kokkos::DefaultHostExecutionSpace>;
  const auto copy = allocate<typename Rows::non_const_type>("GALE::caller_rows", view.extent(0));
  parallel_for("GALE::caller_rows", Space(), view.extent(0), CopyRow<columns, decltype(copy), View>{copy, view});
  return copy;
}

/// A vector as an unmanaged View. Throws gale::Error if its length is no multiple of `columns`.
template <int columns, class T>
auto view_of(const char* name, const std::vector<T>& values) {
  if (values.size() % columns != 0) {
    throw Error(std::string(name) + " have " + std::to_string(values.size()) + " entries, no multiple of " +
                std::to_string(columns));
  }
  return Kokkos::View<const T* [columns], Kokkos::LayoutRight, HostMemory, Kokkos::MemoryUnmanaged>(
      values.data(), values.size() / columns);
}

}  // namespace gale::detail
