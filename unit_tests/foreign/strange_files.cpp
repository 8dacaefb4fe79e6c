#include "strange_files.hpp"

#include <cstdint>
#include <functional>
#include <vector>

#include "hdf5_writing.hpp"

namespace {

constexpr hsize_t size = 4;
const std::vector<hsize_t> shape = {size, size, size};

/// An image of 4^3 points whose PointData is `fill`'s.
void write_image(const std::string& path, const std::function<void(const VtkHdf&)>& fill) {
  const VtkHdf to(path, "ImageData");
  describe_image(to, static_cast<int>(size));
  fill(to);
}

hid_t make_list() { return H5Pcreate(H5P_DATASET_CREATE); }

void put_and_close(const VtkHdf& to, const std::vector<hsize_t>& of_shape, const void* values, hid_t list) {
  put(to.arrays, "ramp", H5T_NATIVE_FLOAT, of_shape, values, list);
  H5Pclose(list);
}

hid_t make_chunks(const std::vector<hsize_t>& chunk) {
  const hid_t list = make_list();
  H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data());
  return list;
}

size_t keep_all(unsigned, size_t, const unsigned*, size_t bytes, size_t*, void**) { return bytes; }

/// Writes values as a plugin's filter would.
hid_t make_unknown_filter() {
  constexpr H5Z_filter_t number = 300;
  const H5Z_class2_t filter = {H5Z_CLASS_T_VERS, number, 1, 1, "unheard of", nullptr, nullptr, keep_all};
  H5Zregister(&filter);
  const hid_t list = make_chunks(shape);
  H5Pset_filter(list, number, 0, 0, nullptr);
  return list;
}

void link_by_user(const VtkHdf& to) {
  constexpr auto number = static_cast<H5L_type_t>(200);
  H5L_class_t kind = {};
  kind.version = H5L_LINK_CLASS_T_VERS;
  kind.id = number;
  kind.comment = "of a test";
  kind.trav_func = [](const char*, hid_t, const void*, size_t, hid_t, hid_t) { return hid_t(-1); };
  H5Lregister(&kind);
  H5Lcreate_ud(to.arrays, "ramp", number, "", 0, H5P_DEFAULT, H5P_DEFAULT);
}

void map_from_other_file(const VtkHdf& to) {
  const hid_t list = make_list(), space = make_space(shape);
  H5Pset_virtual(list, space, "secret.vtkhdf", "/VTKHDF/PointData/ramp", space);
  H5Sclose(space);
  put_and_close(to, shape, nullptr, list);
}

void keep_outside(const VtkHdf& to) {
  const hid_t list = make_list();
  H5Pset_external(list, "secret.raw", 0, size * size * size * sizeof(float));
  put_and_close(to, shape, nullptr, list);
}

/// A mesh of that many parts and points whose numbers alone are there, well packed.
void write_parts(const std::string& path, hsize_t parts, long long points_each, hsize_t points) {
  const VtkHdf to(path, "UnstructuredGrid");
  const auto packed = [](hsize_t length) {
    const hid_t list = make_chunks({length});
    H5Pset_deflate(list, 9);
    return list;
  };
  const std::vector<long long> none(parts), counts(parts, points_each);
  const hid_t list = packed(parts);
  put(to.root, "NumberOfPoints", H5T_NATIVE_LLONG, {parts}, counts.data(), list);
  put(to.root, "NumberOfCells", H5T_NATIVE_LLONG, {parts}, none.data(), list);
  put(to.root, "NumberOfConnectivityIds", H5T_NATIVE_LLONG, {parts}, none.data(), list);
  put(to.root, "Offsets", H5T_NATIVE_LLONG, {parts}, none.data(), list);
  H5Pclose(list);
  const hid_t chunks = make_chunks({1 << 16, 3}), unused = packed(1 << 16);
  put(to.root, "Points", H5T_NATIVE_FLOAT, {points, 3}, nullptr, chunks);
  put(to.root, "Connectivity", H5T_NATIVE_LLONG, {0}, nullptr);
  put(to.root, "Types", H5T_NATIVE_UCHAR, {0}, nullptr);
  put(to.arrays, "field", H5T_NATIVE_FLOAT, {points}, nullptr, unused);
  H5Pclose(chunks);
  H5Pclose(unused);
}

}  // namespace

void write_strange_files(const std::string& folder) {
  const auto path = [&](const char* name) { return folder + "/" + name + ".vtkhdf"; };
  const std::vector<float> zeros(size * size * size);
  write_image(path("secret"), [&](const VtkHdf& to) { put(to.arrays, "ramp", H5T_NATIVE_FLOAT, shape, zeros.data()); });
  write_image(path("outside"), keep_outside);
  write_image(path("virtual"), map_from_other_file);
  write_image(path("link_to_array"), [](const VtkHdf& to) {
    H5Lcreate_external("secret.vtkhdf", "/VTKHDF/PointData/ramp", to.arrays, "ramp", H5P_DEFAULT, H5P_DEFAULT);
  });
  write_image(path("link_to_group"), [](const VtkHdf& to) {
    H5Ldelete(to.root, "PointData", H5P_DEFAULT);
    H5Lcreate_external("secret.vtkhdf", "/VTKHDF/PointData", to.root, "PointData", H5P_DEFAULT, H5P_DEFAULT);
  });
  write_image(path("link_to_link"), [](const VtkHdf& to) {
    H5Lcreate_external("secret.vtkhdf", "/VTKHDF/PointData/ramp", to.file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/elsewhere", to.arrays, "ramp", H5P_DEFAULT, H5P_DEFAULT);
  });
  write_image(path("link_to_itself"),
              [](const VtkHdf& to) { H5Lcreate_soft("ramp", to.arrays, "ramp", H5P_DEFAULT, H5P_DEFAULT); });
  write_image(path("link_of_a_user"), link_by_user);
  write_image(path("plugin"), [&](const VtkHdf& to) { put_and_close(to, shape, zeros.data(), make_unknown_filter()); });
  write_image(path("never_written"), [](const VtkHdf& to) { put_and_close(to, shape, nullptr, make_list()); });
  write_image(path("half_written"), [&](const VtkHdf& to) {
    const hid_t list = make_chunks({1, size, size});
    H5Pset_deflate(list, 9);
    put_and_close(to, shape, nullptr, list);
    const hid_t set = H5Dopen(to.arrays, "ramp", H5P_DEFAULT);
    const hsize_t first[] = {0, 0, 0};
    for (hsize_t k : {0, 1, 3}) {
      const hsize_t at[] = {k, first[1], first[2]};
      H5Dwrite_chunk(set, H5P_DEFAULT, 1, at, size * size * sizeof(float), zeros.data());  // not deflated
    }
    H5Dclose(set);
  });
  const auto put_few_bytes = [&](const VtkHdf& to, hid_t list, std::uint32_t left_out) {
    put_and_close(to, shape, nullptr, list);
    const hid_t set = H5Dopen(to.arrays, "ramp", H5P_DEFAULT);
    const hsize_t at[] = {0, 0, 0};
    H5Dwrite_chunk(set, H5P_DEFAULT, left_out, at, 8, zeros.data());
    H5Dclose(set);
  };
  const auto make_packed = [] {
    const hid_t list = make_chunks(shape);
    H5Pset_deflate(list, 9);
    return list;
  };
  write_image(path("chunk_of_few_bytes"), [&](const VtkHdf& to) { put_few_bytes(to, make_chunks(shape), 0); });
  write_image(path("unpacked_chunk_of_few_bytes"), [&](const VtkHdf& to) { put_few_bytes(to, make_packed(), 1); });
  write_image(path("packed_chunk_of_other_bytes"), [&](const VtkHdf& to) { put_few_bytes(to, make_packed(), 0); });
  write_parts(path("parts"), 200000, 0, 0);
  write_parts(path("points"), 1, 60000000, 60000000);
}
