#include "arrays.hpp"

namespace gale::python {

void require_rows(const Array1& array, std::size_t width, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == width) return;
  std::string shape;
  for (std::size_t d = 0; d < array.ndim(); ++d) shape += (d > 0 ? ", " : "") + std::to_string(array.shape(d));
  throw Error(std::string(name) + " has the shape (" + shape + "), not (n, " + std::to_string(width) + ")");
}

bool is_on_device(const Array1& array, const char* name) {
  const int type = array.device_type();
  if (type == nb::device::cpu::value || type == nb::device::cuda_host::value) return false;
  const bool is_cuda = type == nb::device::cuda::value || type == nb::device::cuda_managed::value;
  const std::string where = is_cuda ? "a CUDA device" : "a device of DLPack's type " + std::to_string(type);
  if (is_cuda && device_is_cuda) {
    Kokkos::fence();
    return true;
  }
  throw Error(std::string(name) + " is in the memory of " + where +
              (device_is_cuda ? ", which this gale can't read"
                              : ", and this gale was built without CUDA: copy it to the host first"));
}

nb::ndarray<> device_array(std::uintptr_t data, const std::vector<std::size_t>& shape, char type, int bytes,
                           const nb::object& owner) {
  using Code = nb::dlpack::dtype_code;
  const Code code = type == 'f' ? Code::Float : type == 'i' ? Code::Int : Code::UInt;
  const nb::dlpack::dtype dtype{static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(8 * bytes), 1};
  return nb::ndarray<>(reinterpret_cast<void*>(data), shape.size(), shape.data(), owner, nullptr, dtype,
                       nb::device::cuda::value);
}

}  // namespace gale::python
