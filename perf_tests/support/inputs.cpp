#include "support/inputs.hpp"

#include <cstdint>
#include <fstream>

#include <gale/base/error.hpp>
#include <gale/io/read.hpp>

namespace gale::perf {

namespace {

io::Dataset read_raw(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const auto read = [&](auto* to, std::size_t count) {
    file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count * sizeof(*to)));
  };
  std::int64_t sizes[2] = {0, 0};
  read(sizes, 2);
  if (!file || sizes[0] < 0 || sizes[1] < 0) throw Error("cannot read '" + path + "'");
  const io::Dataset::Points<float> points("points", sizes[0]);
  const decltype(io::Dataset::tetrahedra) tetrahedra("tetrahedra", sizes[1]);
  std::vector<float> field(sizes[0]);
  read(points.data(), points.size());
  read(tetrahedra.data(), tetrahedra.size());
  read(field.data(), field.size());
  if (!file) throw Error("'" + path + "' is too short");
  io::Dataset data;
  data.points = points;
  data.tetrahedra = tetrahedra;
  data.arrays.push_back({"field", 1, std::move(field)});
  return data;
}

}  // namespace

io::Dataset make_input(const std::string& name) {
  return name.find(':') != std::string::npos ? io::read(name) : read_raw(name);
}

}  // namespace gale::perf
