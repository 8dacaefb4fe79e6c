// print_hdf5 FILE: a line for each of its datasets, as HDF5's own library reads them: the path, the type as VTK names
// it, the shape as 5x3, and the values, floats in hexadecimal.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "hdf5_writing.hpp"

namespace {

template <class Value>
void print(hid_t set, const std::string& path, const char* type, hid_t native, const char* format) {
  const hid_t space = H5Dget_space(set);
  std::vector<hsize_t> shape(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  std::vector<Value> values(H5Sget_simple_extent_npoints(space));
  if (H5Dread(set, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) std::exit(1);
  std::printf("%s %s ", path.c_str(), type);
  for (std::size_t d = 0; d < shape.size(); ++d)
    std::printf("%s%llu", d == 0 ? "" : "x", static_cast<unsigned long long>(shape[d]));
  for (const Value value : values) std::printf(format, value);
  std::printf("\n");
  H5Sclose(space);
}

void print_dataset(hid_t set, const std::string& path) {
  const hid_t type = H5Dget_type(set);
  const auto is = [&](hid_t native) { return H5Tequal(type, native) > 0; };
  if (is(H5T_NATIVE_INT8)) {
    print<std::int8_t>(set, path, "Int8", H5T_NATIVE_INT8, " %hhd");
  } else if (is(H5T_NATIVE_UINT8)) {
    print<std::uint8_t>(set, path, "UInt8", H5T_NATIVE_UINT8, " %hhu");
  } else if (is(H5T_NATIVE_INT32)) {
    print<std::int32_t>(set, path, "Int32", H5T_NATIVE_INT32, " %d");
  } else if (is(H5T_NATIVE_INT64)) {
    print<long long>(set, path, "Int64", H5T_NATIVE_LLONG, " %lld");
  } else if (is(H5T_NATIVE_FLOAT)) {
    print<float>(set, path, "Float32", H5T_NATIVE_FLOAT, " %a");
  } else if (is(H5T_NATIVE_DOUBLE)) {
    print<double>(set, path, "Float64", H5T_NATIVE_DOUBLE, " %a");
  } else {
    std::exit(1);
  }
  H5Tclose(type);
}

void print_group(hid_t group, const std::string& path) {
  H5G_info_t info;
  if (H5Gget_info(group, &info) < 0) std::exit(1);
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    char name[300];
    H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT);
    const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    const std::string inside = path + "/" + name;
    if (H5Iget_type(object) == H5I_GROUP) print_group(object, inside);
    if (H5Iget_type(object) == H5I_DATASET) print_dataset(object, inside);
    H5Oclose(object);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const hid_t file = H5Fopen(argv[1], H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return 1;
  const hid_t root = H5Gopen(file, "VTKHDF", H5P_DEFAULT);
  if (root < 0) return 1;
  print_group(root, "");
  H5Gclose(root);
  H5Fclose(file);
  return 0;
}
