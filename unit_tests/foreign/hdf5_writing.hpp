#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <vtk_hdf5.h>

/// HDF5's C interface in a few calls. Whatever fails leaves something out of the file, which the tests see.

inline hid_t make_space(const std::vector<hsize_t>& shape) {
  return H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
}

inline void put(hid_t group, const char* name, hid_t type, const std::vector<hsize_t>& shape, const void* values,
                hid_t creation = H5P_DEFAULT) {
  const hid_t space = make_space(shape);
  const hid_t set = H5Dcreate(group, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  if (values != nullptr) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  H5Dclose(set);
  H5Sclose(space);
}

inline void describe(hid_t group, const char* name, hid_t type, const std::vector<hsize_t>& shape, const void* values) {
  const hid_t space = make_space(shape);
  const hid_t attribute = H5Acreate(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, values);
  H5Aclose(attribute);
  H5Sclose(space);
}

inline void describe(hid_t object, const char* name, const char* text) {
  const hid_t type = H5Tcopy(H5T_C_S1), scalar = H5Screate(H5S_SCALAR);
  H5Tset_size(type, std::strlen(text));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const hid_t attribute = H5Acreate(object, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, text);
  H5Aclose(attribute);
  H5Sclose(scalar);
  H5Tclose(type);
}

/// A file with the group VTKHDF of that type, and its PointData.
struct VtkHdf {
  hid_t file, root, arrays;

  VtkHdf(const std::string& path, const char* type)
      : file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)),
        root(H5Gcreate(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
        arrays(H5Gcreate(root, "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)) {
    const long long version[] = {1, 0};
    describe(root, "Version", H5T_NATIVE_LLONG, {2}, version);
    describe(root, "Type", type);
  }
  ~VtkHdf() {
    H5Gclose(arrays);
    H5Gclose(root);
    H5Fclose(file);
  }
};

/// Says where the SIZE^3 voxels of an image are.
inline void describe_image(const VtkHdf& to, int size) {
  const long long extent[] = {0, size - 1, 0, size - 1, 0, size - 1};
  const double origin[] = {1, 2, 3}, spacing[] = {1, 1, 2}, direction[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  describe(to.root, "WholeExtent", H5T_NATIVE_LLONG, {6}, extent);
  describe(to.root, "Origin", H5T_NATIVE_DOUBLE, {3}, origin);
  describe(to.root, "Spacing", H5T_NATIVE_DOUBLE, {3}, spacing);
  describe(to.root, "Direction", H5T_NATIVE_DOUBLE, {9}, direction);
}
