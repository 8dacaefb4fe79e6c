#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "hdf5_writing.hpp"
#include "strange_files.hpp"

namespace {

/// Puts datasets into a group, one of them now and then otherwise than it should be.
class RandomGroup {
 public:
  RandomGroup(hid_t group, std::mt19937& random) : group_(group), random_(random) {}

  void put_numbers(std::string name, hid_t type, std::vector<hsize_t> shape, std::vector<double> values) {
    constexpr double huge = 1e18;
    static const std::vector<std::string> names = {"Points",   "Types",    "Offsets",   "coordx",        "coordy",
                                                   "connect1", "eb_prop1", "num_nodes", "vals_nod_var1", "time_step"};
    hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    bool has_values = true;
    if (one_in(15)) switch (below(9)) {
        case 0:
          return;
        case 1:
          name = names[below(names.size())];
          break;
        case 2:
          type = some_type();
          break;
        case 3:
          change_shape(shape);
          break;
        case 4:
          has_values = false;
          break;
        case 5:
          if (!values.empty())
            values[below(values.size())] =
                std::vector<double>{-1, 0, 1e9, huge, std::numeric_limits<double>::quiet_NaN()}[below(5)];
          break;
        case 6:
          shape.insert(shape.begin(), 1 + below(3));
          break;
        case 7:
          std::shuffle(values.begin(), values.end(), random_);
          break;
        default:
          if (shape.size() > 1) shape.pop_back();
      }
    if (one_in(3)) pack(list, shape);
    hsize_t count = 1;
    for (const hsize_t length : shape) count *= std::min<hsize_t>(length, 10000);
    values.resize(std::min<hsize_t>(count, 10000));
    if (count >= 10000) has_values = false;
    const hid_t space = make_space(shape);
    const hid_t set = H5Dcreate(group_, name.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT);
    if (has_values && set >= 0) H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    if (name.compare(0, 7, "connect") == 0 && set >= 0) describe(set, "elem_type", one_in(6) ? "HEX8" : "TETRA");
    if (set >= 0) H5Dclose(set);
    H5Sclose(space);
    H5Pclose(list);
  }

  std::size_t below(std::size_t end) { return random_() % end; }
  bool one_in(std::size_t n) { return below(n) == 0; }

 private:
  hid_t some_type() {
    const hid_t types[] = {H5T_STD_I8LE,  H5T_STD_U16BE, H5T_STD_I32BE,  H5T_STD_U32LE,
                           H5T_STD_I64LE, H5T_STD_U64BE, H5T_IEEE_F32BE, H5T_IEEE_F64LE};
    return types[below(std::size(types))];
  }

  void change_shape(std::vector<hsize_t>& shape) {
    hsize_t& length = shape[below(shape.size())];
    const hsize_t lengths[] = {0,          1,       length + 1,       length - (length > 0 ? 1 : 0),
                               2 * length, 1000000, hsize_t(1) << 33, hsize_t(1) << 61};
    length = lengths[below(std::size(lengths))];
  }

  /// Writes chunks, through filters that are known or not.
  void pack(hid_t list, const std::vector<hsize_t>& shape) {
    std::vector<hsize_t> chunk;
    for (const hsize_t length : shape) chunk.push_back(1 + below(std::min<hsize_t>(length, 100) + 1));
    H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data());
    if (one_in(2)) H5Pset_shuffle(list);
    if (one_in(2)) H5Pset_deflate(list, 4);
    if (one_in(3)) H5Pset_fletcher32(list);
    if (one_in(12)) H5Pset_deflate(list, 4);
  }

  hid_t group_;
  std::mt19937& random_;
};

const std::vector<double> xs = {0, 1, 0, 0, 1, 2}, ys = {0, 0, 1, 0, 1, 0}, zs = {0, 0, 0, 1, 1, 1},
                          corners = {0, 1, 2, 3, 1, 2, 3, 4, 1, 4, 3, 5}, field = {0.5, 3, 1, 4, -1, 5};

void write_random_mesh(const std::string& path, std::mt19937& random) {
  const VtkHdf to(path, "UnstructuredGrid");
  RandomGroup group(to.root, random), arrays(to.arrays, random);
  std::vector<double> xyz;
  for (std::size_t k = 0; k < xs.size(); ++k) xyz.insert(xyz.end(), {xs[k], ys[k], zs[k]});
  group.put_numbers("NumberOfPoints", H5T_STD_I64LE, {1}, {6});
  group.put_numbers("NumberOfCells", H5T_STD_I64LE, {1}, {3});
  group.put_numbers("NumberOfConnectivityIds", H5T_STD_I64LE, {1}, {12});
  group.put_numbers("Points", H5T_IEEE_F32LE, {6, 3}, xyz);
  group.put_numbers("Offsets", H5T_STD_I64LE, {4}, {0, 4, 8, 12});
  group.put_numbers("Connectivity", H5T_STD_I64LE, {12}, corners);
  group.put_numbers("Types", H5T_STD_U8LE, {3}, {10, 10, 10});
  arrays.put_numbers("field", H5T_IEEE_F32LE, {6}, field);
  arrays.put_numbers("pairs", H5T_IEEE_F64LE, {6, 2}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  if (group.one_in(2)) return;
  const hid_t steps = H5Gcreate(to.root, "Steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  RandomGroup times(steps, random);
  times.put_numbers("Values", H5T_IEEE_F64LE, {2}, {0, 1});
  for (const char* name : {"PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"})
    times.put_numbers(name, H5T_STD_I64LE, {2}, {double(random() % 8 == 0), 0});
  H5Gclose(steps);
}

/// An Exodus file as NetCDF-4 has it: dimensions are datasets of their lengths.
void write_random_exodus(const std::string& path, std::mt19937& random) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  RandomGroup group(file, random);
  const std::pair<const char*, hsize_t> dimensions[] = {
      {"num_dim", 3},        {"num_nodes", 6},       {"num_elem", 3},    {"num_el_blk", 1},
      {"num_el_in_blk1", 3}, {"num_nod_per_el1", 4}, {"num_nod_var", 1}, {"time_step", 0}};
  for (const auto& [name, length] : dimensions)
    group.put_numbers(name, H5T_IEEE_F32BE, {length}, std::vector<double>(length));
  group.put_numbers("coordx", H5T_IEEE_F64LE, {6}, xs);
  group.put_numbers("coordy", H5T_IEEE_F64LE, {6}, ys);
  group.put_numbers("coordz", H5T_IEEE_F64LE, {6}, zs);
  group.put_numbers("time_whole", H5T_IEEE_F64LE, {2}, {0, 1});
  group.put_numbers("eb_prop1", H5T_STD_I32LE, {1}, {7});
  std::vector<double> from_one;
  for (const double corner : corners) from_one.push_back(corner + 1);
  group.put_numbers("connect1", H5T_STD_I32LE, {3, 4}, from_one);
  std::vector<double> times = field;
  times.insert(times.end(), field.begin(), field.end());
  group.put_numbers("vals_nod_var1", H5T_IEEE_F64LE, {2, 6}, times);
  const hid_t letter = H5Tcopy(H5T_C_S1);
  const char name[33] = "field";
  if (!group.one_in(20)) put(file, "name_nod_var", letter, {1, 33}, name);
  H5Tclose(letter);
  H5Fclose(file);
}

}  // namespace

void write_random_files(const std::string& folder, int count) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  for (int k = 0; k < count; ++k) {
    std::mt19937 random(static_cast<unsigned>(k));
    write_random_mesh(folder + "/mesh_" + std::to_string(k) + ".vtkhdf", random);
    write_random_exodus(folder + "/mesh_" + std::to_string(k) + ".e", random);
  }
}
